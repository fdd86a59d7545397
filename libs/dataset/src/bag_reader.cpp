#include "bag_reader.h"

#include <archive.h>
#include <archive_entry.h>

#include <filesystem>
#include <memory>

#include "rgbd_graphslam/core/error.h"
#include "wire_reader.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

const std::string format_line = "#ROSBAG V2.0\n";

/** Kinds of records, the values of their field `op`; indices and summaries are passed over. */
enum class Record : unsigned char { Message = 2, Chunk = 5, Connection = 7 };

using Fields = std::map<std::string, std::string>;

Fields fieldsOf(const std::string& header) {
    Fields fields;
    WireReader reader(header);
    while (!reader.atEnd()) {
        const std::string field = reader.text();
        const auto equals = field.find('=');
        if (equals == std::string::npos) throw std::out_of_range("a header without names");
        fields[field.substr(0, equals)] = field.substr(equals + 1);
    }
    return fields;
}

/** No recorder makes chunks so large; a damaged size shall not fill the memory. */
constexpr std::size_t largest_chunk = 1 << 30;

/** Unpacks a bz2 or lz4 stream. \param size of what comes out */
std::string decompressed(const std::string& bytes, std::size_t size) {
    if (size > largest_chunk) throw std::out_of_range("a chunk is too large");
    const std::unique_ptr<archive, int (*)(archive*)> in(archive_read_new(), archive_read_free);
    archive_read_support_filter_bzip2(in.get());
    archive_read_support_filter_lz4(in.get());
    archive_read_support_format_raw(in.get());
    archive_entry* entry = nullptr;
    std::string result(size, '\0');
    if (archive_read_open_memory(in.get(), bytes.data(), bytes.size()) != ARCHIVE_OK ||
        archive_read_next_header(in.get(), &entry) != ARCHIVE_OK ||
        archive_read_data(in.get(), result.data(), size) != static_cast<la_ssize_t>(size)) {
        throw std::out_of_range("a chunk cannot be unpacked");
    }
    return result;
}

}  // namespace

BagReader::BagReader(const std::string& path) : path_(path), in_(path, std::ios::binary) {
    if (!in_) throw Error("cannot read '" + path + "'", "check the name and permissions");
    size_ = fs::file_size(path);
    std::string first(format_line.size(), '\0');
    if (!in_.read(first.data(), static_cast<std::streamsize>(first.size())) ||
        first != format_line) {
        throw Error("'" + path + "' is no ROS 1 bag of format 2.0",
                    "older bags are converted by 'rosbag fix', ROS 2's are folders");
    }
}

void BagReader::refuse(const std::string& why) const {
    throw Error("the bag '" + path_ + "' is damaged or cut off (" + why + ")", "fetch it again");
}

void BagReader::forEachMessage(const std::function<void(const BagMessage&, double)>& use) {
    const auto part = [&]() {
        std::uint32_t length = 0;
        if (!in_.read(reinterpret_cast<char*>(&length), sizeof length)) refuse("a length lacks");
        const auto at = static_cast<std::uint64_t>(in_.tellg());
        if (length > size_ - at) refuse("a record is longer than the file");
        std::string bytes(length, '\0');
        in_.read(bytes.data(), length);
        return bytes;
    };
    try {
        while (in_.peek() != std::ifstream::traits_type::eof()) {
            const Fields header = fieldsOf(part());
            const std::string data = part();
            const double progress = static_cast<double>(in_.tellg()) / static_cast<double>(size_);
            takeRecord(header, data, use, progress);
        }
    } catch (const std::out_of_range& e) {
        refuse(e.what());
    }
}

void BagReader::takeRecord(const Fields& header, const std::string& data,
                           const std::function<void(const BagMessage&, double)>& use,
                           double progress) {
    const auto op = static_cast<Record>(header.at("op").at(0));
    if (op == Record::Connection) {
        connections_[header.at("conn")] = {header.at("topic"), fieldsOf(data).at("type")};
    } else if (op == Record::Message) {
        const Connection& connection = connections_.at(header.at("conn"));
        use({connection.topic, connection.type, data}, progress);
    } else if (op == Record::Chunk) {
        const bool plain = header.at("compression") == "none";
        const auto size = WireReader(header.at("size")).number<std::uint32_t>();
        takeChunk(plain ? data : decompressed(data, size), use, progress);
    }
}

void BagReader::takeChunk(const std::string& records,
                          const std::function<void(const BagMessage&, double)>& use,
                          double progress) {
    WireReader reader(records);
    while (!reader.atEnd()) {
        const Fields header = fieldsOf(reader.text());
        takeRecord(header, reader.text(), use, progress);
    }
}

}  // namespace rgbd_graphslam
