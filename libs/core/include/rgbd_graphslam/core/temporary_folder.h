/** Folders that are whole or absent. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** A folder under a temporary name that goes when this object goes, unless it was moved to its
 *  final name; a killed process's is removed by the next makeWritableFolder() for the folder
 *  around it. */
class TemporaryFolder {
  public:
    /** Makes it beside `final_path`. \throws Error naming it when that cannot be */
    explicit TemporaryFolder(const std::string& final_path);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::string& path() const { return path_; }

    /** Replaces what is there. \throws Error naming the final path when that cannot be */
    void moveToFinalName() const;

  private:
    std::string final_, path_;
};

}  // namespace rgbd_graphslam
