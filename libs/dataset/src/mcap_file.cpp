#include "mcap_file.h"

#include <zlib.h>

#include <filesystem>

#include "rgbd_graphslam/core/error.h"
#include "unpacked_bytes.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view magic = "\x89MCAP0\r\n";
constexpr std::size_t record_head_bytes = 1 + sizeof(std::uint64_t);

/** Kinds of records; indices, statistics, attachments and metadata are passed over. */
enum class Record : unsigned char {
    Footer = 0x02,
    Schema = 0x03,
    Channel = 0x04,
    Message = 0x05,
    Chunk = 0x06,
    DataEnd = 0x0f
};

bool isOfUse(unsigned char op) {
    const auto record = static_cast<Record>(op);
    return record == Record::Schema || record == Record::Channel || record == Record::Message ||
           record == Record::Chunk;
}

/** Bytes behind a 64-bit length. */
std::string_view longData(WireReader& in, std::string_view content) {
    const auto length = in.number<std::uint64_t>();
    const std::string_view rest = content.substr(content.size() - in.left());
    if (length > rest.size()) throw std::out_of_range("a record is longer than what holds it");
    in.skip(length);
    return rest.substr(0, length);
}

std::uint32_t checkSum(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

McapFile::McapFile(const std::string& path) : path_(path), in_(path, std::ios::binary) {
    if (!in_) throw Error("cannot read '" + path + "'", "check the name and permissions");
    size_ = fs::file_size(path);
    std::string first(magic.size(), '\0');
    if (!in_.read(first.data(), static_cast<std::streamsize>(first.size())) || first != magic) {
        throw Error("'" + path + "' is not an MCAP file", "check the name, or record it again");
    }
}

std::string McapFile::forEachMessage(const UseMessage& use) {
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(magic.size()));
    schemas_.clear();
    channels_.clear();
    try {
        if (readRecords(use)) return "";
    } catch (const std::out_of_range& e) {
        throw Error("'" + path_ + "' is damaged (" + e.what() + ")",
                    "copy it again, or mend it with 'mcap recover'");
    }
    return "the file has no end: the recorder did not close it, or it is cut off";
}

/** \return whether the file has an end */
bool McapFile::readRecords(const UseMessage& use) {
    std::string head(record_head_bytes, '\0'), content;
    while (in_.read(head.data(), static_cast<std::streamsize>(head.size()))) {
        const auto op = static_cast<unsigned char>(head[0]);
        if (op == static_cast<unsigned char>(Record::DataEnd) ||
            op == static_cast<unsigned char>(Record::Footer)) {
            return true;
        }
        const auto length = WireReader(std::string_view(head).substr(1)).number<std::uint64_t>();
        const auto at = static_cast<std::uint64_t>(in_.tellg());
        if (length > size_ - at) return false;
        share_ = static_cast<double>(at + length) / static_cast<double>(size_);
        if (!isOfUse(op)) {
            in_.seekg(static_cast<std::streamoff>(length), std::ios::cur);
            continue;
        }
        content.resize(length);
        if (!in_.read(content.data(), static_cast<std::streamsize>(length))) return false;
        takeRecord(op, content, use);
    }
    return false;
}

void McapFile::takeRecord(unsigned char op, std::string_view content, const UseMessage& use) {
    switch (static_cast<Record>(op)) {
        case Record::Schema:
            return takeSchema(content);
        case Record::Channel:
            return takeChannel(content);
        case Record::Message:
            return takeMessage(content, use);
        case Record::Chunk:
            return takeChunk(content, use);
        default:
            return;
    }
}

void McapFile::takeSchema(std::string_view content) {
    WireReader in(content);
    const auto id = in.number<std::uint16_t>();
    schemas_[id] = withoutMsg(in.text());
}

void McapFile::takeChannel(std::string_view content) {
    WireReader in(content);
    const auto id = in.number<std::uint16_t>();
    const auto schema = schemas_.find(in.number<std::uint16_t>());
    Channel& channel = channels_[id];
    channel.topic = in.text();
    channel.encoding = in.text();
    channel.type = schema == schemas_.end() ? "" : schema->second;
}

void McapFile::takeMessage(std::string_view content, const UseMessage& use) const {
    WireReader in(content);
    const auto channel = channels_.find(in.number<std::uint16_t>());
    if (channel == channels_.end()) throw std::out_of_range("a message without channel");
    in.number<std::uint32_t>();  // sequence number
    const double recorded_s = 1e-9 * static_cast<double>(in.number<std::uint64_t>());
    in.number<std::uint64_t>();  // when it was published
    const auto& [topic, type, encoding] = channel->second;
    if (encoding != "cdr" && encoding != "ros1") return;
    const WireFormat format = encoding == "cdr" ? WireFormat::Cdr : WireFormat::Ros1;
    use({topic, type, format, content.substr(content.size() - in.left()), recorded_s}, share_);
}

void McapFile::takeChunk(std::string_view content, const UseMessage& use) {
    WireReader in(content);
    in.skip(2 * sizeof(std::uint64_t));  // times of its first and last message
    const auto size = in.number<std::uint64_t>();
    const auto expected_sum = in.number<std::uint32_t>();
    const std::string compression = in.text();
    const std::string_view packed = longData(in, content);
    const std::string unpacked = compression.empty() ? "" : unpackedBytes(packed, size);
    const std::string_view records = compression.empty() ? packed : unpacked;
    if (expected_sum != 0 && checkSum(records) != expected_sum) {
        throw std::out_of_range("a check sum is wrong");
    }
    WireReader reader(records);
    while (!reader.atEnd()) {
        const auto op = reader.number<std::uint8_t>();
        const std::string_view record = longData(reader, records);
        if (static_cast<Record>(op) != Record::Chunk) takeRecord(op, record, use);
    }
}

}  // namespace rgbd_graphslam
