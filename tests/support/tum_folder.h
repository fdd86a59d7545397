/** A small sequence in the TUM layout, made on the spot, and a folder to make it in. */
#pragma once
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace rgbd_graphslam {

/** Removed with all it holds at the end of the test. */
class TestFolder {
  public:
    TestFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "rgbd-XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TestFolder() { std::filesystem::remove_all(path_); }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
    }

  private:
    std::filesystem::path path_;
};

inline std::string readText(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/** The first `share` of a file's bytes stay. */
inline void cutFile(const std::string& path, double share) {
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size * share));
}

/** Frames of 32x24 pixels: color stamps at 30 Hz, each depth stamp 5.5 ms later. */
namespace small_sequence {

constexpr int width = 32, height = 24;
constexpr double start_s = 1305031453.359684;

inline double colorStamp(int frame) {
    return start_s + frame * 0.033333;
}
inline double depthStamp(int frame) {
    return colorStamp(frame) + 0.0055;
}

inline cv::Mat color(int frame) {
    cv::Mat image(height, width, CV_8UC3);
    cv::RNG generator(100 + frame);
    generator.fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
}

/** Covers the whole range of 16 bits, 0 and 65535 included. */
inline cv::Mat depth(int frame) {
    cv::Mat image(height, width, CV_16UC1);
    cv::RNG generator(900 + frame);
    generator.fill(image, cv::RNG::UNIFORM, 0, 65536);
    image.at<std::uint16_t>(0, 0) = 0;
    image.at<std::uint16_t>(0, 1) = 65535;
    return image;
}

inline std::string stampText(double stamp_s) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.6f", stamp_s);
    return text;
}

inline std::string colorFile(int frame) {
    return "rgb/" + stampText(colorStamp(frame)) + ".png";
}
inline std::string depthFile(int frame) {
    return "depth/" + stampText(depthStamp(frame)) + ".png";
}

inline std::string cameraIni() {
    return "[CAMERA_PARAMS]\nresolution = [32 24]\nfx = 30\nfy = 31\ncx = 15.5\ncy = 11.5\n"
           "distortion_model = plumb_bob\ndist = [0.1 -0.2 0.001 -0.002 0.05]\n"
           "depth_units = 5000\nsensor_pose = [0.1 0 0.6 0 10 0]\n";
}

/** Writes images, rgb.txt, depth.txt and camera.ini. */
inline void make(const TestFolder& folder, const std::string& name, int frames) {
    std::string color_list = "# color images\n", depth_list = "# depth maps\n";
    folder.write(name + "/camera.ini", cameraIni());
    std::filesystem::create_directories(folder / (name + "/rgb"));
    std::filesystem::create_directories(folder / (name + "/depth"));
    for (int i = 0; i < frames; ++i) {
        cv::imwrite(folder / (name + "/" + colorFile(i)), color(i));
        cv::imwrite(folder / (name + "/" + depthFile(i)), depth(i));
        color_list += stampText(colorStamp(i)) + " " + colorFile(i) + "\n";
        depth_list += stampText(depthStamp(i)) + " " + depthFile(i) + "\n";
    }
    folder.write(name + "/rgb.txt", color_list);
    folder.write(name + "/depth.txt", depth_list);
}

}  // namespace small_sequence
}  // namespace rgbd_graphslam
