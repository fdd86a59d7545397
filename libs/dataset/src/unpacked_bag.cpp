#include "rgbd_graphslam/dataset/unpacked_bag.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "bag_reader.h"
#include "number_text.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "ros_messages.h"
#include "tf_path.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** As the TUM benchmark's PNGs. */
constexpr double depth_units_a_metre = 5000;
/** The files are read once and thrown away. */
const std::vector<int> fast_png = {cv::IMWRITE_PNG_COMPRESSION, 1};

bool isDepth(const ros::Image& image) {
    return image.encoding == "32FC1" || image.encoding == "16UC1" || image.encoding == "mono16";
}

/** The message's bytes as an image; rows may be padded. */
cv::Mat pixelsOf(const ros::Image& image, int type) {
    const std::size_t row_bytes = std::size_t{image.width} * CV_ELEM_SIZE(type);
    if (image.is_bigendian || image.width == 0 || image.height == 0 || image.step < row_bytes ||
        image.data.size() < std::size_t{image.step} * image.height) {
        throw Error("image at " + stampText(image.header.stamp_s) + " is not whole",
                    "fetch the bag again");
    }
    return {static_cast<int>(image.height), static_cast<int>(image.width), type,
            const_cast<char*>(image.data.data()), image.step};
}

cv::Mat colorOf(const ros::Image& image) {
    cv::Mat color;
    if (image.encoding == "bgr8") return pixelsOf(image, CV_8UC3);
    if (image.encoding == "mono8") return pixelsOf(image, CV_8UC1);
    if (image.encoding != "rgb8") {
        throw Error("colour images with encoding '" + image.encoding + "' are not understood",
                    "rgb8, bgr8 and mono8 are");
    }
    cv::cvtColor(pixelsOf(image, CV_8UC3), color, cv::COLOR_RGB2BGR);
    return color;
}

/** In units of 1/5000 m; what is not finite or out of range becomes no reading. */
cv::Mat depthOf(const ros::Image& image) {
    const bool metres = image.encoding == "32FC1";
    cv::Mat1f readings;
    pixelsOf(image, metres ? CV_32FC1 : CV_16UC1).convertTo(readings, CV_32F);
    const double units = metres ? depth_units_a_metre : depth_units_a_metre / 1000;
    cv::Mat1w depth(readings.size());
    for (int v = 0; v < depth.rows; ++v) {
        for (int u = 0; u < depth.cols; ++u) {
            const double value = std::round(readings(v, u) * units);
            const bool valid = value > 0 && value <= std::numeric_limits<std::uint16_t>::max();
            depth(v, u) = valid ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
        }
    }
    return depth;
}

CameraSetup setupOf(const ros::CameraInfo& info) {
    CameraSetup setup;
    setup.camera = Camera{static_cast<int>(info.width),
                          static_cast<int>(info.height),
                          info.K[0],
                          info.K[4],
                          info.K[2],
                          info.K[5],
                          {}};
    for (std::size_t i = 0; i < std::min<std::size_t>(5, info.D.size()); ++i) {
        setup.camera.distortion[i] = info.D[i];
    }
    setup.depth_units = depth_units_a_metre;
    return setup;
}

/** Images of one kind from one topic. */
struct ImageTopic {
    std::string subfolder, topic, frame, list;

    /** The first topic of its kind counts; others are cameras of their own. */
    bool takes(const std::string& from) {
        if (topic.empty()) topic = from;
        return topic == from;
    }
};

/** One bag on its way into a folder. */
class Unpacking {
  public:
    Unpacking(const std::string& bag, fs::path folder) : bag_(bag), folder_(std::move(folder)) {}

    void run() {
        makeWritableFolder(folder_ / "rgb");
        makeWritableFolder(folder_ / "depth");
        Progress progress("unpacking", 100, "%");
        BagReader(bag_).forEachMessage([&](const BagMessage& message, double share) {
            take(message);
            progress.update(static_cast<std::size_t>(100 * share));
        });
        writeLists();
    }

  private:
    void take(const BagMessage& message) {
        if (message.type == "sensor_msgs/Image") {
            takeImage(ros::readImage(message.bytes), message.topic);
        } else if (message.type == "sensor_msgs/Imu") {
            takeImu(ros::readImu(message.bytes));
        } else if (message.type == "sensor_msgs/CameraInfo") {
            const auto info = ros::readCameraInfo(message.bytes);
            cameras_.emplace(info.header.frame, info);
        } else if (message.type == "tf/tfMessage" || message.type == "tf2_msgs/TFMessage") {
            for (const auto& transform : ros::readTransforms(message.bytes)) tf_.add(transform);
        }
    }

    void takeImage(const ros::Image& image, const std::string& topic) {
        ImageTopic& kind = isDepth(image) ? depth_ : color_;
        if (!kind.takes(topic)) return;
        kind.frame = image.header.frame;
        const std::string stamp = stampText(image.header.stamp_s);
        const std::string name = kind.subfolder + "/" + stamp + ".png";
        const cv::Mat pixels = isDepth(image) ? depthOf(image) : colorOf(image);
        if (!cv::imwrite((folder_ / name).string(), pixels, fast_png)) {
            throw Error("cannot write '" + (folder_ / name).string() + "'", "check free space");
        }
        kind.list += stamp + " " + name + "\n";
    }

    static void append(std::string& list, double stamp_s, const Eigen::Vector3d& value) {
        list += stampText(stamp_s) + " " + shortest(value.x()) + " " + shortest(value.y()) + " " +
                shortest(value.z()) + "\n";
    }

    void takeImu(const ros::Imu& imu) {
        if (imu.linear_acceleration_covariance != -1) {
            append(acceleration_, imu.header.stamp_s, imu.linear_acceleration);
        }
        if (imu.angular_velocity_covariance != -1) {
            append(angular_velocity_, imu.header.stamp_s, imu.angular_velocity);
        }
    }

    void writeLists() const {
        if (color_.list.empty() || depth_.list.empty()) {
            throw Error("'" + bag_ + "' holds no " + (color_.list.empty() ? "colour" : "depth") +
                            " images (sensor_msgs/Image)",
                        "give a bag of an RGB-D camera");
        }
        const auto info = cameras_.find(color_.frame);
        if (!cameraByFolderName(folder_.filename()) && info != cameras_.end()) {
            write("camera.ini", toIniText(setupOf(info->second)));
        }
        write("rgb.txt", color_.list);
        write("depth.txt", depth_.list);
        write("accelerometer.txt", acceleration_);
        write("gyroscope.txt", angular_velocity_);
        write("groundtruth.txt", toTumText(tf_.pathOf(color_.frame)));
    }

    void write(const std::string& name, const std::string& text) const {
        if (!text.empty()) writeTextAtomically(folder_ / name, text);
    }

    std::string bag_;
    fs::path folder_;
    ImageTopic color_{"rgb", "", "", ""}, depth_{"depth", "", "", ""};
    std::string acceleration_, angular_velocity_;
    std::map<std::string, ros::CameraInfo> cameras_;
    TfPath tf_;
};

}  // namespace

bool isBag(const std::string& path) {
    return fs::path(path).extension() == ".bag" && fs::is_regular_file(path);
}

UnpackedBag::UnpackedBag(const std::string& bag, const std::string& scratch)
    : scratch_((fs::path(scratch) / "unpacked").string()),
      folder_((fs::path(scratch_.path()) / fs::path(bag).stem()).string()) {
    Unpacking(bag, folder_).run();
}

}  // namespace rgbd_graphslam
