/** The files of a recording of ROS messages. */
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "message_source.h"
#include "rgbd_graphslam/core/temporary_folder.h"

namespace rgbd_graphslam {

/** Whether a name ends as a file of ROS messages does: .bag, .bag.active, .db3, .mcap, the last two
 *  also with .zstd behind. */
bool hasBagEnding(const std::string& name);

/** Whether a folder is a ROS 2 bag: its metadata.yaml lists files, or files begin with its name,
 *  which is how rosbag2 names them. */
bool isBagFolder(const std::string& folder);

/** A bag's name without folders and endings. */
std::string bagName(const std::string& bag);

/** A ROS 1 bag, or a ROS 2 bag's file or folder. Files that were compressed as a whole are unpacked
 *  for as long as this object lives, messages that were compressed one by one on reading. */
class BagFiles : public MessageSource {
  public:
    /** \param scratch folder to unpack in
     *  \throws Error when there is nothing to read or a file is not what its name says */
    BagFiles(const std::string& bag, const std::string& scratch);

    /** Also \throws Error naming topic and type of a message that is not whole */
    std::string forEachMessage(const UseMessage& use) override;

  private:
    void open(const std::string& file);

    TemporaryFolder scratch_;
    std::vector<std::unique_ptr<MessageSource>> files_;
    std::vector<std::string> names_;
    bool lacks_metadata_ = false;
};

}  // namespace rgbd_graphslam
