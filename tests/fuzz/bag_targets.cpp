/** Readers of ROS bags. */
#include <functional>

#include "../../libs/dataset/src/ros_images.h"
#include "../../libs/dataset/src/ros_observations.h"
#include "../support/tum_folder.h"
#include "fuzz_targets.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/unpacked_bag.h"

namespace rgbd_graphslam {
namespace {

void readBag(const std::string& name, const std::string& bytes) {
    static const TestFolder folder;
    folder.write(name, bytes);
    for (const bool no_camera : {false, true}) {
        try {
            UnpackedBag(folder / name, folder / "", {"", "", no_camera});
        } catch (const Error&) {
        }
    }
}

void mayEnd(const std::function<void()>& read) {
    try {
        read();
    } catch (const std::out_of_range&) {
    } catch (const Error&) {
    }
}

void readEveryMessage(std::string_view bytes, WireFormat format) {
    const WireReader in(bytes, format);
    mayEnd([&] { ros::colorFileOf(ros::readImage(in)); });
    mayEnd([&] { ros::depthFileOf(ros::readImage(in), 1000); });
    mayEnd([&] { ros::sizeOf(ros::readCompressedImage(in)); });
    mayEnd([&] { ros::readCameraInfo(in); });
    mayEnd([&] { ros::readImu(in); });
    mayEnd([&] { ros::readTransforms(in); });
    mayEnd([&] { ros::readOdometry(in); });
    mayEnd([&] { toObservation(ros::readLaserScan(in), "scan", SE3()); });
    mayEnd([&] { toObservation(ros::readNavSatFix(in), "gps", SE3()); });
    mayEnd([&] { ros::readExtrinsics(in); });
}

}  // namespace

void fuzzRos1Bag(const std::string& bytes) {
    readBag("a.bag", bytes);
}

void fuzzMcap(const std::string& bytes) {
    readBag("a.mcap", bytes);
}

void fuzzRos2Database(const std::string& bytes) {
    readBag("a.db3", bytes);
}

void fuzzRosMessages(const std::string& bytes) {
    if (bytes.empty()) return;
    const std::string_view message = std::string_view(bytes).substr(1);
    mayEnd(
        [&] { readEveryMessage(message, bytes[0] % 2 == 1 ? WireFormat::Cdr : WireFormat::Ros1); });
}

void fuzzCompressedDepth(const std::string& bytes) {
    if (bytes.empty()) return;
    const char* formats[] = {"16UC1; compressedDepth png", "32FC1; compressedDepth png",
                             "16UC1; compressedDepth rvl"};
    ros::CompressedImage image;
    image.format = formats[static_cast<unsigned char>(bytes[0] - 1) % 3];
    image.data = std::string_view(bytes).substr(1);
    mayEnd([&] {
        ros::largestDepth(image);
        ros::depthFileOf(image, 1000);
    });
}

}  // namespace rgbd_graphslam
