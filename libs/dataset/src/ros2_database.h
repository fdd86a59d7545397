/** Messages of ROS 2 bags in SQLite's format. */
#pragma once
#include <sqlite3.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "message_source.h"

namespace rgbd_graphslam {

/** Reads one .db3 file of rosbag2 in the order of recording: table `topics` (id, name, type,
 *  serialization_format) and table `messages` (id, topic_id, timestamp in ns, data). */
class Ros2Database : public MessageSource {
  public:
    /** \throws Error when the file is missing or no such database */
    explicit Ros2Database(const std::string& path);

    std::string forEachMessage(const UseMessage& use) override;

  private:
    struct Topic {
        std::string name, type;
        bool is_cdr = false;
    };
    using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

    Statement prepare(const char* sql) const;
    bool step(const Statement& statement) const;
    [[noreturn]] void refuse() const;
    void readTopics();

    std::string path_;
    std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
    std::map<std::int64_t, Topic> topics_;
    std::int64_t last_id_ = 0;
};

}  // namespace rgbd_graphslam
