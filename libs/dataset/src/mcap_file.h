/** Messages of MCAP files. */
#pragma once
#include <cstdint>
#include <fstream>
#include <map>
#include <string>

#include "message_source.h"

namespace rgbd_graphslam {

/** Reads an MCAP file (mcap.dev/spec) from front to back, in the order of recording; its index is
 *  not needed. Memory stays at one chunk. Chunks may be plain, LZ4 or Zstandard; their check sums
 *  are verified. Messages in encodings other than `cdr` and `ros1` are passed over. */
class McapFile : public MessageSource {
  public:
    /** \throws Error when the file is missing or no MCAP file */
    explicit McapFile(const std::string& path);

    std::string forEachMessage(const UseMessage& use) override;

  private:
    struct Channel {
        std::string topic, type, encoding;
    };

    bool readRecords(const UseMessage& use);
    void takeRecord(unsigned char op, std::string_view content, const UseMessage& use);
    void takeSchema(std::string_view content);
    void takeChannel(std::string_view content);
    void takeMessage(std::string_view content, const UseMessage& use) const;
    void takeChunk(std::string_view content, const UseMessage& use);

    std::string path_;
    std::ifstream in_;
    std::uint64_t size_ = 0;
    double share_ = 0;
    std::map<std::uint16_t, std::string> schemas_;
    std::map<std::uint16_t, Channel> channels_;
};

}  // namespace rgbd_graphslam
