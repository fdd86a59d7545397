#include "rgbd_graphslam/export/mcap_writer.h"

#include <zlib.h>

#include <algorithm>

namespace rgbd_graphslam {
namespace {

constexpr std::string_view magic("\x89MCAP0\r\n", 8);
constexpr std::size_t chunk_bytes = 1 << 20;

enum Opcode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    statistics = 0x0b,
    summary_offset = 0x0e,
    data_end = 0x0f
};

std::uint32_t crcOf(std::uint32_t crc, std::string_view bytes) {
    constexpr std::size_t most_at_a_time = 1 << 30;
    while (!bytes.empty()) {
        const auto count = std::min(bytes.size(), most_at_a_time);
        crc = static_cast<std::uint32_t>(
            crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(count)));
        bytes.remove_prefix(count);
    }
    return crc;
}

/** What stands before the content of every record. */
std::string recordHead(Opcode opcode, std::size_t length) {
    ByteWriter head;
    head.put<std::uint8_t>(opcode);
    head.put<std::uint64_t>(length);
    return head.take();
}

std::string record(Opcode opcode, const ByteWriter& content) {
    return recordHead(opcode, content.bytes().size()) + content.bytes();
}

}  // namespace

void McapWriter::Span::add(std::uint64_t stamp_ns) {
    first_ns = std::min(first_ns, stamp_ns);
    last_ns = std::max(last_ns, stamp_ns);
}

void McapWriter::Span::put(ByteWriter& out) const {
    out.put<std::uint64_t>(std::min(first_ns, last_ns));
    out.put<std::uint64_t>(last_ns);
}

McapWriter::McapWriter(const std::string& path, const std::string& profile)
    : out_(path, std::ios::binary) {
    ByteWriter content;
    content.putText(profile);
    content.putText("rgbd-graphslam");
    put(magic);
    put(record(header, content));
}

void McapWriter::put(std::string_view bytes) {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    crc_ = crcOf(crc_, bytes);
    position_ += bytes.size();
}

std::uint16_t McapWriter::schemaNumber(const std::string& type, const std::string& definition) {
    const auto known = std::find_if(schemas_.begin(), schemas_.end(),
                                    [&](const Schema& s) { return s.name == type; });
    const auto number = static_cast<std::uint16_t>(known - schemas_.begin() + 1);
    if (known == schemas_.end()) schemas_.push_back({type, definition});
    return number;
}

std::uint16_t McapWriter::addChannel(const std::string& topic, const std::string& type,
                                     const std::string& definition) {
    channels_.push_back({schemaNumber(type, definition), topic});
    return static_cast<std::uint16_t>(channels_.size());
}

std::string McapWriter::schemaRecords() const {
    std::string records;
    std::uint16_t number = 0;
    for (const Schema& s : schemas_) {
        ByteWriter content;
        content.put<std::uint16_t>(++number);
        content.putText(s.name);
        content.putText("ros2msg");
        content.putText(s.text);
        records += record(schema, content);
    }
    return records;
}

std::string McapWriter::channelRecords() const {
    std::string records;
    std::uint16_t number = 0;
    for (const Channel& c : channels_) {
        ByteWriter content;
        content.put<std::uint16_t>(++number);
        content.put<std::uint16_t>(c.schema);
        content.putText(c.topic);
        content.putText("cdr");
        content.put<std::uint32_t>(0);  // no metadata
        records += record(channel, content);
    }
    return records;
}

void McapWriter::write(std::uint16_t number, std::uint64_t stamp_ns, std::string_view data) {
    if (chunks_.empty() && chunk_.empty()) chunk_ = schemaRecords() + channelRecords();
    chunk_messages_[number].emplace_back(stamp_ns, chunk_.size());
    ByteWriter head;
    head.put<std::uint16_t>(number);
    head.put<std::uint32_t>(channels_[number - 1].messages++);
    head.put<std::uint64_t>(stamp_ns);  // logged
    head.put<std::uint64_t>(stamp_ns);  // published
    chunk_ += recordHead(message, head.bytes().size() + data.size());
    chunk_ += head.bytes();
    chunk_ += data;
    chunk_time_.add(stamp_ns);
    time_.add(stamp_ns);
    if (chunk_.size() >= chunk_bytes) finishChunk();
}

void McapWriter::finishChunk() {
    if (chunk_.empty()) return;
    ChunkEntry entry;
    entry.time = chunk_time_;
    entry.offset = position_;
    entry.records = chunk_.size();
    ByteWriter head;
    chunk_time_.put(head);
    head.put<std::uint64_t>(chunk_.size());
    head.put<std::uint32_t>(crcOf(0, chunk_));
    head.putText("");  // not compressed
    head.put<std::uint64_t>(chunk_.size());
    put(recordHead(chunk, head.bytes().size() + chunk_.size()));
    put(head.bytes());
    put(chunk_);
    entry.length = position_ - entry.offset;
    writeMessageIndex(entry);
    chunks_.push_back(entry);
    chunk_.clear();
    chunk_messages_.clear();
    chunk_time_ = {};
}

void McapWriter::writeMessageIndex(ChunkEntry& entry) {
    const std::uint64_t start = position_;
    for (const auto& [number, messages] : chunk_messages_) {
        entry.index_offsets[number] = position_;
        ByteWriter content;
        content.put<std::uint16_t>(number);
        content.putCount(messages.size() * 2 * sizeof(std::uint64_t));
        for (const auto& [stamp_ns, offset] : messages) {
            content.put(stamp_ns);
            content.put(offset);
        }
        put(record(message_index, content));
    }
    entry.index_length = position_ - start;
}

std::string McapWriter::statisticsRecord() const {
    std::uint64_t messages = 0;
    for (const Channel& c : channels_) messages += c.messages;
    ByteWriter content;
    content.put<std::uint64_t>(messages);
    content.put<std::uint16_t>(static_cast<std::uint16_t>(schemas_.size()));
    content.putCount(channels_.size());
    content.put<std::uint32_t>(0);  // attachments
    content.put<std::uint32_t>(0);  // metadata
    content.putCount(chunks_.size());
    time_.put(content);
    content.putCount(channels_.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t)));
    std::uint16_t number = 0;
    for (const Channel& c : channels_) {
        content.put<std::uint16_t>(++number);
        content.put<std::uint64_t>(c.messages);
    }
    return record(statistics, content);
}

std::string McapWriter::chunkIndexRecords() const {
    std::string records;
    for (const ChunkEntry& entry : chunks_) {
        ByteWriter content;
        entry.time.put(content);
        content.put(entry.offset);
        content.put(entry.length);
        content.putCount(entry.index_offsets.size() *
                         (sizeof(std::uint16_t) + sizeof(std::uint64_t)));
        for (const auto& [number, offset] : entry.index_offsets) {
            content.put(number);
            content.put(offset);
        }
        content.put(entry.index_length);
        content.putText("");  // not compressed
        content.put(entry.records);
        content.put(entry.records);
        records += record(chunk_index, content);
    }
    return records;
}

void McapWriter::writeSummary() {
    crc_ = 0;
    const std::uint64_t summary_start = position_;
    std::string offsets;
    const auto group = [&](Opcode opcode, const std::string& records) {
        ByteWriter content;
        content.put<std::uint8_t>(opcode);
        content.put<std::uint64_t>(position_);
        content.put<std::uint64_t>(records.size());
        if (!records.empty()) offsets += record(summary_offset, content);
        put(records);
    };
    group(schema, schemaRecords());
    group(channel, channelRecords());
    group(statistics, statisticsRecord());
    group(chunk_index, chunkIndexRecords());
    ByteWriter content;
    content.put<std::uint64_t>(summary_start);
    content.put<std::uint64_t>(position_);
    put(offsets);
    put(recordHead(footer, content.bytes().size() + sizeof(crc_)));
    put(content.bytes());
    ByteWriter crc;
    crc.put(crc_);
    put(crc.bytes());
}

bool McapWriter::close() {
    finishChunk();
    ByteWriter content;
    content.put(crc_);
    put(record(data_end, content));
    writeSummary();
    put(magic);
    out_.close();
    return out_.good();
}

}  // namespace rgbd_graphslam
