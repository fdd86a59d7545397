/** Sequences still packed, as the TUM benchmark hands them out. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** Whether a path names a file with the ending of an archive: .tgz, .tar, .gz, .bz2, .xz, .zip. */
bool isSequenceArchive(const std::string& path);

/** An archive (.tgz, .tar, .zip, whatever libarchive reads) unpacked into a temporary folder that
 *  goes when this object goes. */
class UnpackedArchive {
  public:
    /** \param scratch folder to unpack in; needs room for all files
     *  \throws Error when the archive is damaged, cut off, tries to write outside of its folder, or
     *          does not fit */
    UnpackedArchive(const std::string& archive, const std::string& scratch);
    ~UnpackedArchive();
    UnpackedArchive(const UnpackedArchive&) = delete;
    UnpackedArchive& operator=(const UnpackedArchive&) = delete;

    /** The unpacked folder that holds the sequence, see layoutOf().
     *  \throws Error when there is none */
    std::string sequenceFolder() const;

  private:
    std::string archive_, folder_;
};

}  // namespace rgbd_graphslam
