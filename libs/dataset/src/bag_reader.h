/** Messages of ROS 1 bags, without ROS. */
#pragma once
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>

namespace rgbd_graphslam {

/** One recorded message, still as ROS serialised it. */
struct BagMessage {
    const std::string& topic;
    const std::string& type;  // e.g. "sensor_msgs/Image"
    const std::string& bytes;
};

/** Reads a file of bag format 2.0 (wiki.ros.org/Bags/Format/2.0) from front to back, in the
 *  order of recording. Memory stays at one chunk. Chunks may be plain, bz2 or lz4. */
class BagReader {
  public:
    /** \throws Error when the file is missing or no bag of format 2.0 */
    explicit BagReader(const std::string& path);

    /** \param use called with each message and the share of the file that is read
     *  \throws Error where the bag is cut off or damaged */
    void forEachMessage(const std::function<void(const BagMessage&, double)>& use);

  private:
    struct Connection {
        std::string topic, type;
    };

    [[noreturn]] void refuse(const std::string& why) const;
    void takeRecord(const std::map<std::string, std::string>& header, const std::string& data,
                    const std::function<void(const BagMessage&, double)>& use, double progress);
    void takeChunk(const std::string& records,
                   const std::function<void(const BagMessage&, double)>& use, double progress);

    std::string path_;
    std::ifstream in_;
    std::uint64_t size_ = 0;
    std::map<std::string, Connection> connections_;  // by the number's bytes
};

}  // namespace rgbd_graphslam
