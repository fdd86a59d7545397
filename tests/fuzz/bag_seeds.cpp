#include "bag_seeds.h"

#include <sqlite3.h>

#include <array>
#include <cstring>
#include <opencv2/imgcodecs.hpp>

#include "../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {

using namespace std::string_literals;

/** Writes values as WireReader reads them. */
class WireWriter {
  public:
    explicit WireWriter(bool cdr) : cdr_(cdr), bytes_(cdr ? "\x00\x01\x00\x00"s : "") {}

    template <class Number>
    WireWriter& number(Number value) {
        while (cdr_ && bytes_.size() % sizeof value != (sizeof value > 4 ? 4 : 0)) bytes_ += '\0';
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        return *this;
    }
    WireWriter& text(const std::string& value) { return data(cdr_ ? value + '\0' : value); }
    WireWriter& data(const std::string& value) {
        number(static_cast<std::uint32_t>(value.size()));
        bytes_ += value;
        return *this;
    }
    WireWriter& numbers(const std::vector<double>& values) {
        for (const double value : values) number(value);
        return *this;
    }
    WireWriter& header(std::uint32_t seconds, const std::string& frame) {
        if (!cdr_) number(std::uint32_t{0});
        return number(seconds).number(std::uint32_t{0}).text(frame);
    }
    const std::string& bytes() const { return bytes_; }

  private:
    bool cdr_;
    std::string bytes_;
};

struct Message {
    std::string topic, type, bytes;
};

std::string image(bool cdr, const std::string& encoding, std::uint32_t pixel_bytes) {
    return WireWriter(cdr)
        .header(1, "camera")
        .number(std::uint32_t{2})
        .number(std::uint32_t{4})
        .text(encoding)
        .number(std::uint8_t{0})
        .number(4 * pixel_bytes)
        .data(std::string(8 * pixel_bytes, '\x10'))
        .bytes();
}

std::string cameraInfo(bool cdr) {
    WireWriter out(cdr);
    out.header(1, "camera").number(std::uint32_t{2}).number(std::uint32_t{4});
    out.text("rational_polynomial").number(std::uint32_t{8});
    out.numbers({0.5, -2.7, 0, 0, 1.6, 0.4, -2.5, 1.5});
    out.numbers({4, 0, 2, 0, 4, 1, 0, 0, 1}).numbers({1, 0, 0, 0, 1, 0, 0, 0, 1});
    return out.numbers({4, 0, 2, 0, 0, 4, 1, 0, 0, 0, 1, 0}).bytes();
}

std::string imu(bool cdr) {
    WireWriter out(cdr);
    out.header(1, "imu").numbers(std::vector<double>(13, 0));
    return out.numbers(std::vector<double>(12, 0.5)).numbers(std::vector<double>(12, 9.5)).bytes();
}

std::string transforms(bool cdr, double x) {
    WireWriter out(cdr);
    out.number(std::uint32_t{1}).header(static_cast<std::uint32_t>(x), "world").text("camera");
    return out.numbers({x, 0, 0, 0, 0, 0, 1}).bytes();
}

std::string scan(bool cdr) {
    WireWriter out(cdr);
    out.header(1, "laser");
    for (const float value : {-1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 0.1F, 9.0F}) out.number(value);
    out.number(std::uint32_t{3});
    for (const float value : {1.0F, 2.0F, 3.0F}) out.number(value);
    return out.number(std::uint32_t{0}).bytes();
}

std::vector<Message> messages(bool cdr) {
    return {{"/c/image_raw", "sensor_msgs/Image", image(cdr, "rgb8", 3)},
            {"/d/image_raw", "sensor_msgs/Image", image(cdr, "32FC1", 4)},
            {"/c/camera_info", "sensor_msgs/CameraInfo", cameraInfo(cdr)},
            {"/imu", "sensor_msgs/Imu", imu(cdr)},
            {"/tf", "tf2_msgs/TFMessage", transforms(cdr, 1)},
            {"/tf", "tf2_msgs/TFMessage", transforms(cdr, 2)},
            {"/scan", "sensor_msgs/LaserScan", scan(cdr)}};
}

std::string ros1Record(const std::vector<std::pair<std::string, std::string>>& fields,
                       const std::string& data) {
    WireWriter header(false), record(false);
    for (const auto& [name, value] : fields) header.data(name + "=" + value);
    return record.data(header.bytes()).data(data).bytes();
}

template <class Number>
std::string raw(Number value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string ros1Bag(std::uint64_t index_at, bool in_chunk) {
    std::string records;
    std::uint32_t connection = 0;
    for (const Message& message : messages(false)) {
        const std::string number = raw(connection++);
        WireWriter type(false);
        type.data("type=" + message.type);
        records +=
            ros1Record({{"op", "\x07"}, {"conn", number}, {"topic", message.topic}}, type.bytes());
        records += ros1Record({{"op", "\x02"}, {"conn", number}, {"time", std::string(8, '\x01')}},
                              message.bytes);
    }
    const auto size = raw(static_cast<std::uint32_t>(records.size()));
    if (in_chunk) {
        records = ros1Record({{"op", "\x05"}, {"compression", "none"}, {"size", size}}, records);
    }
    return "#ROSBAG V2.0\n" + ros1Record({{"op", "\x03"}, {"index_pos", raw(index_at)}}, "    ") +
           records;
}

std::string mcapRecord(char op, const std::string& content) {
    return op + raw(static_cast<std::uint64_t>(content.size())) + content;
}

std::string mcap(bool in_chunk) {
    std::string records;
    std::uint16_t id = 1;
    for (const Message& message : messages(true)) {
        WireWriter schema(false), channel(false), content(false);
        std::string type = message.type;
        type.replace(type.find('/'), 1, "/msg/");
        schema.number(id).text(type).text("ros2msg").data("");
        channel.number(id).number(id).text(message.topic).text("cdr").data("");
        content.number(id)
            .number(std::uint32_t{0})
            .number(std::uint64_t{1})
            .number(std::uint64_t{1});
        records += mcapRecord(3, schema.bytes()) + mcapRecord(4, channel.bytes()) +
                   mcapRecord(5, content.bytes() + message.bytes);
        ++id;
    }
    if (in_chunk) {
        const auto size = static_cast<std::uint64_t>(records.size());
        records = mcapRecord(
            6, std::string(16, '\0') + raw(size) + std::string(8, '\0') + raw(size) + records);
    }
    return "\x89MCAP0\r\n" + records + mcapRecord(15, std::string(4, '\0'));
}

void writeDatabase(const std::string& path) {
    sqlite3* database = nullptr;
    sqlite3_open(path.c_str(), &database);
    sqlite3_exec(
        database,
        "PRAGMA page_size = 512;"
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT,"
        " serialization_format TEXT);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER,"
        " data BLOB);",
        nullptr, nullptr, nullptr);
    int id = 1;
    for (const Message& message : messages(true)) {
        sqlite3_stmt* row = nullptr;
        const std::string topic = "INSERT INTO topics VALUES(" + std::to_string(id) + ",'" +
                                  message.topic + "','" + message.type + "','cdr')";
        sqlite3_exec(database, topic.c_str(), nullptr, nullptr, nullptr);
        sqlite3_prepare_v2(database, "INSERT INTO messages VALUES(NULL, ?, 1, ?)", -1, &row,
                           nullptr);
        sqlite3_bind_int(row, 1, id++);
        sqlite3_bind_blob(row, 2, message.bytes.data(), static_cast<int>(message.bytes.size()),
                          SQLITE_TRANSIENT);
        sqlite3_step(row);
        sqlite3_finalize(row);
    }
    sqlite3_close(database);
}

}  // namespace

std::vector<std::string> ros1BagSeeds() {
    return {ros1Bag(1, true), ros1Bag(0, false)};
}

std::vector<std::string> mcapSeeds() {
    return {mcap(true), mcap(false)};
}

std::vector<std::string> ros2DatabaseSeeds() {
    const TestFolder folder;
    writeDatabase(folder / "seed.db3");
    return {readText(folder / "seed.db3")};
}

std::vector<std::string> rosMessageSeeds() {
    std::vector<std::string> seeds;
    for (const bool cdr : {false, true}) {
        for (const Message& message : messages(cdr))
            seeds.push_back((cdr ? "\1" : "\2") + message.bytes);
    }
    return seeds;
}

std::vector<std::string> compressedDepthSeeds() {
    std::vector<unsigned char> png;
    cv::imencode(".png", cv::Mat(2, 4, CV_16UC1, cv::Scalar(500)), png);
    const std::string settings = raw(0) + raw(10100.0F) + raw(-1009.0F);
    const std::string file(png.begin(), png.end());
    const std::string rvl = raw(4) + raw(2) + "\x00\x00\x00\x80\x12\x34\x56\x78\x11\x11\x11\x11"s;
    return {"\1" + settings + file, "\2" + settings + file, "\3" + settings + rvl};
}

}  // namespace rgbd_graphslam
