#include "phone_folders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "image_folders.h"
#include "list_file.h"
#include "numbered_files.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/image_file.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr double millimeters = 1000;

CameraSetup phoneCamera(const std::string& name, const std::string& first_color_file) {
    const DecodedImage image = readColorImage(first_color_file);
    if (!image.damage.empty()) throw Error("image " + image.damage, "copy the recording again");
    CameraSetup setup;
    setup.name = name;
    setup.camera.width = image.pixels.cols;
    setup.camera.height = image.pixels.rows;
    setup.depth_units = millimeters;
    return setup;
}

void setIntrinsics(Intrinsics& camera, double fx, double fy, double cx, double cy,
                   const std::string& file) {
    const bool usable = fx > 0 && fy > 0 && std::isfinite(fx + fy) && std::isfinite(cx + cy);
    if (!usable) throw Error("'" + file + "' has no usable fx, fy, cx, cy", "see --camera");
    camera.fx = fx;
    camera.fy = fy;
    camera.cx = cx;
    camera.cy = cy;
}

/** Stamps of frames by their numbers. */
std::map<long long, double> strayStamps(const std::string& path) {
    const std::string form = "timestamp, frame, x, y, z, qx, qy, qz, qw";
    std::map<long long, double> stamps;
    forEachLine(path, [&](Line& line) {
        if (line.number == 1 && line.words.str().find("timestamp") != std::string::npos) return;
        const double stamp_s = line.realNumber(form);
        const double frame = line.realNumber(form);
        if (std::abs(frame) > 1e9) line.refuse("no frame has such a number", form);
        stamps[std::llround(frame)] = stamp_s;
    });
    if (stamps.empty()) throw Error("'" + path + "' lists no frame", "copy the recording again");
    return stamps;
}

std::vector<ListedImage> stampedBy(const std::map<long long, double>& stamps,
                                   const NumberedFiles& files) {
    std::vector<ListedImage> images;
    for (const auto& [number, name] : files.files) {
        const auto stamp = stamps.find(std::llround(number));
        if (stamp != stamps.end()) images.push_back({stamp->second, name});
    }
    return images;
}

CameraSetup strayCamera(const std::string& folder, const std::string& first_color_file) {
    const std::string path = fs::path(folder) / "camera_matrix.csv", form = "three numbers";
    std::vector<double> K;
    forEachLine(path, [&](Line& line) {
        for (int i = 0; i < 3; ++i) K.push_back(line.realNumber(form));
    });
    if (K.size() != 9) throw Error("'" + path + "' is not a 3x3 matrix", "copy the recording again");
    CameraSetup setup = phoneCamera("camera_matrix.csv", first_color_file);
    setIntrinsics(setup.camera, K[0], K[4], K[2], K[5], path);
    return setup;
}

std::string metadataIn(const std::string& folder) {
    for (const char* name : {"metadata.json", "metadata"}) {
        const fs::path path = fs::path(folder) / name;
        if (fs::is_regular_file(path)) return path;
    }
    return "";
}

/** Axes of an iPhone's motion sensors (portrait: x right, y up, z out of the screen) in MRPT's
 * sensor frame of its rear camera, whose images are upright when the phone lies with its right side
 * up: Apple's documentation of CMMotionManager and ARCamera.transform. */
SE3 phoneImuAxes() {
    return {(Eigen::Matrix3d() << 0, 0, -1, 0, 1, 0, 1, 0, 0).finished(), Eigen::Vector3d::Zero()};
}

/** \param readings at least one */
double medianNorm(const std::vector<StampedVector>& readings) {
    std::vector<double> norms;
    for (const auto& reading : readings) norms.push_back(reading.value.norm());
    const auto middle = norms.begin() + static_cast<std::ptrdiff_t>(norms.size() / 2);
    std::nth_element(norms.begin(), middle, norms.end());
    return *middle;
}

/** iOS gives the acceleration of gravity, in g: the opposite of what an accelerometer feels. */
void readStrayImu(const std::string& path, RgbdSequence& sequence) {
    constexpr double standard_gravity = 9.80665, most_g = 2;
    const std::string form = "timestamp, a_x, a_y, a_z, alpha_x, alpha_y, alpha_z";
    if (!fs::exists(path)) return;
    forEachLine(path, [&](Line& line) {
        if (line.number == 1 && line.words.str().find("timestamp") != std::string::npos) return;
        StampedVector linear, angular;
        linear.stamp_s = angular.stamp_s = line.realNumber(form);
        for (StampedVector* reading : {&linear, &angular}) {
            for (int i = 0; i < 3; ++i) reading->value[i] = line.realNumber(form);
        }
        sequence.acceleration.push_back(linear);
        sequence.angular_velocity.push_back(angular);
    });
    if (sequence.acceleration.empty()) return;
    const bool in_g = medianNorm(sequence.acceleration) < most_g;
    const double factor = in_g ? -standard_gravity : -1;
    for (auto& reading : sequence.acceleration) reading.value *= factor;
    sequence.notes.push_back(std::string("imu.csv: acceleration taken as iOS's, in ") +
                             (in_g ? "g" : "m/s2") + " and with gravity's sign");
}

void refuseVideo(const std::string& folder) {
    if (!colorFolderIn(folder).empty()) return;
    throw Error("the color images of '" + folder + "' are still a video, rgb.mp4",
                "extract them: cd '" + folder +
                    "' && mkdir rgb && ffmpeg -i rgb.mp4 -vsync 0 -start_number 0 rgb/%06d.png");
}

}  // namespace

bool isStrayScanner(const std::string& folder) {
    const fs::path path(folder);
    return fs::exists(path / "odometry.csv") && fs::exists(path / "camera_matrix.csv") &&
           fs::is_directory(path / "depth");
}

RgbdSequence readStrayScanner(const std::string& folder) {
    refuseVideo(folder);
    const auto stamps = strayStamps(fs::path(folder) / "odometry.csv");
    RgbdSequence sequence;
    sequence.color = stampedBy(stamps, filesByNumber(folder, colorFolderIn(folder), color_endings));
    sequence.depth = stampedBy(stamps, filesByNumber(folder, "depth", depth_endings));
    if (sequence.color.empty() || sequence.depth.empty()) {
        throw Error("no color and depth image of '" + folder + "' has a number in odometry.csv",
                    "number the images as odometry.csv does, from 000000 on");
    }
    if (fs::is_directory(fs::path(folder) / "confidence")) {
        sequence.confidence_folder = "confidence";
        sequence.notes.push_back("depth of confidence 0 (of 0 to 2) is left out");
    }
    sequence.camera =
        strayCamera(folder, (fs::path(folder) / sequence.color.front().file).string());
    sequence.notes.push_back(
        "the phone's own poses (odometry.csv) are an estimate: not taken as ground truth");
    sequence.camera->T_sensor_imu = phoneImuAxes();
    readStrayImu(fs::path(folder) / "imu.csv", sequence);
    return sequence;
}

bool isRecord3d(const std::string& folder) {
    return !metadataIn(folder).empty() && !colorFolderIn(folder).empty() &&
           !depthFolderIn(folder).empty();
}

RgbdSequence readRecord3d(const std::string& folder) {
    const std::string path = metadataIn(folder);
    std::vector<double> K;
    double fps = 0, width = 0;
    try {
        std::ifstream in(path);
        const auto json = nlohmann::json::parse(in);
        K = json.at("K").get<std::vector<double>>();
        fps = json.value("fps", 30.0);
        width = json.value("w", 0.0);
    } catch (const nlohmann::json::exception&) {
    }
    if (K.size() != 9 || !(fps > 0)) {
        throw Error("'" + path + "' has no K of 9 numbers and fps", "export from Record3D again");
    }
    RgbdSequence sequence = readImageFolders(folder, fps);
    CameraSetup setup =
        phoneCamera("metadata", (fs::path(folder) / sequence.color.front().file).string());
    const double scale = width > 0 ? setup.camera.width / width : 1;
    setIntrinsics(setup.camera, scale * K[0], scale * K[4], scale * (K[6] + 0.5) - 0.5,
                  scale * (K[7] + 0.5) - 0.5, path);
    sequence.camera = setup;
    sequence.notes.push_back("the phone's own poses are an estimate: not taken as ground truth");
    return sequence;
}

}  // namespace rgbd_graphslam
