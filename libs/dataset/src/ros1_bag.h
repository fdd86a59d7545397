/** Messages of ROS 1 bags, without ROS. */
#pragma once
#include <cstdint>
#include <fstream>
#include <map>
#include <string>

#include "message_source.h"

namespace rgbd_graphslam {

/** Reads a file of bag format 2.0 (wiki.ros.org/Bags/Format/2.0) from front to back, in the
 *  order of recording. Memory stays at one chunk. Chunks may be plain, bz2 or lz4. */
class Ros1Bag : public MessageSource {
  public:
    /** \throws Error when the file is missing or no bag of format 2.0 */
    explicit Ros1Bag(const std::string& path);

    std::string forEachMessage(const UseMessage& use) override;

  private:
    struct Connection {
        std::string topic, type;
    };
    using Fields = std::map<std::string, std::string, std::less<>>;

    std::string part();
    void readRecords(const UseMessage& use);
    void takeRecord(const Fields& header, std::string_view data, const UseMessage& use);
    void takeChunk(std::string_view records, const UseMessage& use);
    void takeMessage(const Fields& header, std::string_view data, const UseMessage& use) const;

    std::string path_;
    std::ifstream in_;
    std::uint64_t size_ = 0;
    double share_ = 0;
    /** Whether the recorder was killed before it wrote where its index is. */
    bool unclosed_ = false;
    /** Whether the last record is longer than the file. */
    bool cut_ = false;
    std::map<std::string, Connection> connections_;  // by the number's bytes
};

}  // namespace rgbd_graphslam
