/** MCAP files, the container of ROS 2 bags (https://mcap.dev/spec). */
#pragma once
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"

namespace rgbd_graphslam {

/** Writes messages in uncompressed chunks with index and check sums. All channels are added before
 *  the first message. One chunk is held in memory. */
class McapWriter {
  public:
    /** \param profile of the messages: "ros2" */
    McapWriter(const std::string& path, const std::string& profile);

    /** \param type e.g. "nav_msgs/msg/Path"; \param definition its schema as "ros2msg" text
     *  \return the channel's number for write(). Messages are CDR */
    std::uint16_t addChannel(const std::string& topic, const std::string& type,
                             const std::string& definition);

    void write(std::uint16_t channel, std::uint64_t stamp_ns, std::string_view message);

    /** Ends the file. \return whether all of it was written */
    bool close();

  private:
    struct Schema {
        std::string name, text;
    };
    struct Channel {
        std::uint16_t schema = 0;
        std::string topic;
        std::uint32_t messages = 0;
    };
    struct Span {
        std::uint64_t first_ns = UINT64_MAX, last_ns = 0;
        void add(std::uint64_t stamp_ns);
        void put(ByteWriter& out) const;
    };
    struct ChunkEntry {
        Span time;
        std::uint64_t offset = 0, length = 0, records = 0, index_length = 0;
        std::map<std::uint16_t, std::uint64_t> index_offsets;
    };

    std::uint16_t schemaNumber(const std::string& type, const std::string& definition);
    std::string schemaRecords() const;
    std::string channelRecords() const;
    std::string statisticsRecord() const;
    std::string chunkIndexRecords() const;
    void finishChunk();
    void writeMessageIndex(ChunkEntry& entry);
    void writeSummary();
    void put(std::string_view bytes);

    std::ofstream out_;
    std::uint64_t position_ = 0;
    std::uint32_t crc_ = 0;
    std::vector<Schema> schemas_;
    std::vector<Channel> channels_;
    std::string chunk_;
    Span chunk_time_, time_;
    /** Stamp and offset in the chunk of its messages, by channel. */
    std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_messages_;
    std::vector<ChunkEntry> chunks_;
};

}  // namespace rgbd_graphslam
