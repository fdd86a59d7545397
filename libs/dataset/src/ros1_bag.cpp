#include "ros1_bag.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"
#include "unpacked_bytes.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

const std::string format_line = "#ROSBAG V2.0\n";

/** Kinds of records, the values of their field `op`; indices and summaries are passed over. */
enum class Record : unsigned char { Message = 2, BagHeader = 3, Chunk = 5, Connection = 7 };

std::map<std::string, std::string, std::less<>> fieldsOf(std::string_view header) {
    std::map<std::string, std::string, std::less<>> fields;
    WireReader reader(header);
    while (!reader.atEnd()) {
        const std::string_view field = reader.data();
        const auto equals = field.find('=');
        if (equals == std::string_view::npos) throw std::out_of_range("a header without names");
        fields.insert_or_assign(std::string(field.substr(0, equals)),
                                std::string(field.substr(equals + 1)));
    }
    return fields;
}

}  // namespace

Ros1Bag::Ros1Bag(const std::string& path) : path_(path), in_(path, std::ios::binary) {
    if (!in_) throw Error("cannot read '" + path + "'", "check the name and permissions");
    size_ = fs::file_size(path);
    std::string first(format_line.size(), '\0');
    if (!in_.read(first.data(), static_cast<std::streamsize>(first.size())) ||
        first != format_line) {
        throw Error("'" + path + "' is not a ROS 1 bag of format 2.0",
                    "convert older bags with 'rosbag fix'");
    }
}

std::string Ros1Bag::forEachMessage(const UseMessage& use) {
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(format_line.size()));
    connections_.clear();
    unclosed_ = false;
    std::string problem;
    try {
        readRecords(use);
    } catch (const std::out_of_range& e) {
        problem = e.what();
    }
    if (unclosed_) return "the recorder did not close the bag; what came last is missing";
    if (problem.empty()) return "";
    throw Error("the bag '" + path_ + "' is damaged or cut off (" + problem + ")",
                "copy it again, or mend it with 'rosbag reindex'");
}

/** A length and as many bytes. */
std::string Ros1Bag::part() {
    std::uint32_t length = 0;
    if (!in_.read(reinterpret_cast<char*>(&length), sizeof length)) {
        throw std::out_of_range("a length is missing");
    }
    const auto at = static_cast<std::uint64_t>(in_.tellg());
    cut_ = length > size_ - at;
    if (cut_ && !unclosed_) throw std::out_of_range("a record is longer than the file");
    if (cut_) length = static_cast<std::uint32_t>(size_ - at);
    std::string bytes(length, '\0');
    in_.read(bytes.data(), length);
    return bytes;
}

void Ros1Bag::readRecords(const UseMessage& use) {
    while (in_.peek() != std::ifstream::traits_type::eof()) {
        const Fields header = fieldsOf(part());
        const std::string data = part();
        share_ = static_cast<double>(in_.tellg()) / static_cast<double>(size_);
        const bool is_chunk = static_cast<Record>(header.at("op").at(0)) == Record::Chunk;
        if (cut_ && !is_chunk) throw std::out_of_range("a record is cut off");
        takeRecord(header, data, use);
    }
}

void Ros1Bag::takeRecord(const Fields& header, std::string_view data, const UseMessage& use) {
    const auto op = static_cast<Record>(header.at("op").at(0));
    if (op == Record::BagHeader) {
        unclosed_ = WireReader(header.at("index_pos")).number<std::uint64_t>() == 0;
    } else if (op == Record::Connection) {
        connections_[header.at("conn")] = {header.at("topic"), fieldsOf(data).at("type")};
    } else if (op == Record::Message) {
        takeMessage(header, data, use);
    } else if (op == Record::Chunk && header.at("compression") == "none") {
        takeChunk(data, use);
    } else if (op == Record::Chunk) {
        const auto size = WireReader(header.at("size")).number<std::uint32_t>();
        takeChunk(unpackedBytes(data, size), use);
    }
}

void Ros1Bag::takeChunk(std::string_view records, const UseMessage& use) {
    WireReader reader(records);
    while (!reader.atEnd()) {
        const Fields header = fieldsOf(reader.data());
        const auto op = static_cast<Record>(header.at("op").at(0));
        if (op == Record::Chunk) throw std::out_of_range("a chunk in a chunk");
        takeRecord(header, reader.data(), use);
    }
}

void Ros1Bag::takeMessage(const Fields& header, std::string_view data,
                          const UseMessage& use) const {
    const Connection& connection = connections_.at(header.at("conn"));
    WireReader time(header.at("time"));
    const auto seconds = time.number<std::uint32_t>();
    const double recorded_s = seconds + 1e-9 * time.number<std::uint32_t>();
    use({connection.topic, connection.type, WireFormat::Ros1, data, recorded_s}, share_);
}

}  // namespace rgbd_graphslam
