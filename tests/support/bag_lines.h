/** Bags for tests, as lines that make_bag.py and ros2/make_bag.mjs write. */
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/core.hpp>
#include <string>

#include "tum_folder.h"

namespace rgbd_graphslam {

inline bool canWriteRos1Bags() {
    static const bool can =
        std::system(
            "/usr/bin/python3 -c 'import rosbag, sensor_msgs.msg, tf2_msgs.msg, "
            "nav_msgs.msg' 2>/dev/null") == 0;
    return can;
}

inline bool canWriteRos2Bags() {
    static const bool can =
        std::filesystem::exists(RGBD_BINARY_DIR "/ros2_bags/node_modules/@mcap/core") &&
        std::system(
            "node --version >/dev/null 2>&1 && zstd --version >/dev/null 2>&1 && "
            "lz4 --version >/dev/null 2>&1") == 0;
    return can;
}

inline constexpr const char* ros1_needs =
    "needs python3-rosbag, python3-sensor-msgs, python3-nav-msgs and python3-tf2-msgs";
inline constexpr const char* ros2_needs =
    "needs node, zstd, lz4 and the npm packages of tests/support/ros2";

/** Gathers messages and records them. */
class BagLines {
  public:
    /** \param line as make_bag.py takes it */
    void add(const std::string& line) { lines_ += line + "\n"; }
    void clear() { lines_.clear(); }
    std::string& text() { return lines_; }

    void addImage(const std::string& topic, const std::string& frame, double stamp_s,
                  const std::string& encoding, const cv::Mat& pixels) {
        add("image " + topic + " " + frame + " " + small_sequence::stampText(stamp_s) + " " +
            encoding + " " + std::to_string(pixels.cols) + " " + std::to_string(pixels.rows) + " " +
            fileOf(std::string(reinterpret_cast<const char*>(pixels.data),
                               pixels.total() * pixels.elemSize())));
    }

    /** \param format with ~ for blanks */
    void addCompressed(const std::string& topic, const std::string& frame, double stamp_s,
                       const std::string& format, const std::string& bytes) {
        add("compressed " + topic + " " + frame + " " + small_sequence::stampText(stamp_s) + " " +
            format + " " + fileOf(bytes));
    }

    /** \param compression none, bz2 or lz4 */
    void recordRos1(const std::string& bag, const std::string& compression = "none") const {
        run("/usr/bin/python3 '" RGBD_SOURCE_DIR "/tests/support/make_bag.py' '" + bag + "' " +
            compression);
    }

    /** \param bag .mcap (compression none, zstd or lz4) or .db3 (none or messages) */
    void recordRos2(const std::string& bag, const std::string& compression = "none") const {
        run("node '" RGBD_SOURCE_DIR "/tests/support/ros2/make_bag.mjs' '" RGBD_BINARY_DIR
            "/ros2_bags' '" +
            bag + "' " + compression);
    }

  private:
    std::string fileOf(const std::string& bytes) {
        const std::string name = "pixels" + std::to_string(files_++);
        folder_.write(name, bytes);
        return folder_ / name;
    }

    void run(const std::string& command) const {
        folder_.write("lines", lines_);
        ASSERT_EQ(std::system((command + " <'" + folder_ / "lines" + "'").c_str()), 0) << command;
    }

    TestFolder folder_;
    std::string lines_;
    int files_ = 0;
};

/** Makes a closed ROS 1 bag what a killed recorder leaves: no index, and nothing that says where it
 *  is. \param keep share of what was recorded */
inline void unclose(const std::string& bag, double keep) {
    std::string bytes = readText(bag);
    const auto at = bytes.find("index_pos=") + std::string("index_pos=").size();
    std::uint64_t index = 0;
    std::memcpy(&index, bytes.data() + at, sizeof index);
    std::memset(bytes.data() + at, 0, sizeof index);
    bytes.resize(static_cast<std::size_t>(keep * static_cast<double>(index)));
    std::ofstream(bag, std::ios::binary) << bytes;
}

}  // namespace rgbd_graphslam
