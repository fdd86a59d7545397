#include "rgbd_graphslam/dataset/unpacked_bag.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "bag_calibration.h"
#include "bag_files.h"
#include "bag_sensors.h"
#include "bag_survey.h"
#include "image_topics.h"
#include "number_text.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "ros_images.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** Units per meter of floating-point depth as it is stored: the TUM benchmark's, and ROS's for what
 *  these cannot hold. */
constexpr double fine_units = 5000, coarse_units = 1000, most_reading = 65535;
/** A lens fit worse than this is told, px. */

/** Without the rounding of a unit that was stored in 32 bits. */
double unitsPerMetre(float unit_m) {
    return std::round(1000 / static_cast<double>(unit_m)) / 1000;
}

double depthUnitsOf(const BagSurvey& survey, const ImageTopic& depth) {
    if (depth.encoding == "32fc1") {
        return depth.largest_m * fine_units > most_reading ? coarse_units : fine_units;
    }
    const std::string stream = librealsenseStream(depth.name);
    const auto option =
        survey.numbers.find(stream.substr(0, stream.rfind('/')) + "/option/Depth Units/value");
    const auto older =
        survey.numbers.find(stream.substr(0, stream.rfind('/')) + "/option/Depth_Units/value");
    for (const auto& unit_m : {option, older}) {
        if (unit_m != survey.numbers.end() && unit_m->second > 0)
            return unitsPerMetre(unit_m->second);
    }
    return coarse_units;
}

std::string describe(const BagSurvey& survey, const ImageTopic& image) {
    const RecordedTopic* topic = survey.topic(image.name);
    const double span_s = topic->last_s - topic->first_s;
    std::string text = image.name + ", " + (image.is_compressed ? "compressed " : "") +
                       image.encoding + ", " + std::to_string(image.width) + "x" +
                       std::to_string(image.height) + ", " + std::to_string(topic->count) +
                       " images";
    if (span_s > 0 && topic->count > 1) {
        char rate[32];
        std::snprintf(rate, sizeof rate, " at %.1f Hz",
                      static_cast<double>(topic->count - 1) / span_s);
        text += rate;
    }
    return text;
}

/** A calibration as recorded, without a lens that cannot be modelled. */
Intrinsics calibrated(const ros::CameraInfo& info, const ImageTopic& image) {
    const bool rectified = isRectified(image.name);
    const Intrinsics pinhole = pinholeOf(info, rectified);
    Intrinsics camera = pinhole;
    const auto lens = lensOf(info, rectified);
    if (lens) camera.lens = *lens;
    if (lens && CameraModel(camera).isInvertible()) return camera;
    sayWarning("the lens of '" + image.name + "' (" + info.distortion_model +
               ") cannot be modelled; its distortion is left out. Rectify the images first");
    return pinhole;
}

/** Makes a sequence of what a survey found. */
class SequenceOfBag {
  public:
    SequenceOfBag(const BagSurvey& survey, std::string bag)
        : survey_(survey), bag_(std::move(bag)) {}

    RgbdSequence withCamera(const ImageChoice& images) {
        images_ = images;
        used_ = {images.color.name, images.depth.name};
        sequence_.notes.push_back("color: " + describe(survey_, images.color));
        sequence_.depth_units = depthUnitsOf(survey_, images.depth);
        setCamera();
        setDepthCamera();
        takeTruth(survey_, images.color.frame, sequence_);
        const ImuTopic* imu = takeImu(survey_, images.color.name, sequence_, used_);
        if (imu) setImuAxes(*imu);
        takeOthers(mountsBesideCamera());
        return std::move(sequence_);
    }

    RgbdSequence withoutCamera() {
        CameraSetup setup;
        setup.T_sensor_imu = SE3();
        const Mounts mounts(survey_.frames, robotBase(), SE3());
        if (const ImuTopic* imu = takeImu(survey_, "", sequence_, used_)) {
            const auto T_base_imu = mounts.of(imu->frame);
            if (T_base_imu) setup.T_sensor_imu = *T_base_imu;
            if (!T_base_imu) noteUnknownMount("the IMU");
        }
        sequence_.camera = setup;
        takeOthers(mounts);
        return std::move(sequence_);
    }

  private:
    void setCamera() {
        CameraSetup setup;
        const auto by_name = cameraByFolderName(bagName(bag_));
        const auto info = cameraInfoOf(survey_, images_.color);
        if (by_name) {
            setup = *by_name;
            sequence_.notes.push_back("calibration: " + by_name->name + ", by the file's name");
        } else if (info) {
            setup.camera = calibrated(*info, images_.color);
            setup.name = "CameraInfo";
        } else {
            setup.camera.width = images_.color.width;
            setup.camera.height = images_.color.height;
            sayWarning("no CameraInfo for '" + images_.color.name +
                       "': using generic intrinsics (f = 525 px). Pass --camera FILE.ini");
        }
        base_ = baseOf(survey_.frames, images_.color.frame);
        if (!base_.empty()) {
            setup.T_base_sensor =
                *survey_.frames.fixedPose(base_, images_.color.frame) * T_optical_from_mrpt;
            sequence_.notes.push_back("camera pose on the robot: /tf_static, " + base_ + " to " +
                                      images_.color.frame);
        }
        setup.depth_units = *sequence_.depth_units;
        sequence_.camera = setup;
    }

    void setDepthCamera() {
        const ImageTopic& depth = images_.depth;
        std::string how = "registered to color";
        if (!isRegistered(survey_, images_.color, depth)) {
            const auto info = cameraInfoOf(survey_, depth);
            const auto T_color_depth = colorFromDepth(survey_, images_);
            if (info && T_color_depth) {
                placeDepthCamera(*info, *T_color_depth);
                how = "raw, warped to color by the recorded calibrations";
            } else {
                how = std::string("raw, and ") +
                      (info ? "the pose of its camera" : "its calibration") +
                      " is not recorded: taken as registered";
            }
        }
        char units[48];
        std::snprintf(units, sizeof units, "%g units per meter", *sequence_.depth_units);
        sequence_.notes.push_back("depth: " + describe(survey_, depth) + ", " + units + "; " + how);
    }

    void placeDepthCamera(const ros::CameraInfo& info, const SE3& T_color_depth) {
        CameraSetup setup;
        setup.name = "CameraInfo";
        setup.camera = calibrated(info, images_.depth);
        setup.depth_units = *sequence_.depth_units;
        setup.T_base_sensor = sequence_.camera->T_base_sensor * T_optical_from_mrpt.inverse() *
                              T_color_depth * T_optical_from_mrpt;
        sequence_.depth_camera = setup;
    }

    void setImuAxes(const ImuTopic& imu) {
        if (const auto T_color_imu = colorFromImu(survey_, images_.color, imu)) {
            sequence_.camera->T_sensor_imu = T_optical_from_mrpt.inverse() * *T_color_imu;
        } else {
            sequence_.notes.push_back("the axes of " + imu.name +
                                      " on the camera are not recorded: taken as a Kinect's "
                                      "(imu_pose in a --camera file sets them)");
        }
    }

    Mounts mountsBesideCamera() const {
        if (!base_.empty()) return {survey_.frames, base_, SE3()};
        return {survey_.frames, images_.color.frame, T_optical_from_mrpt.inverse()};
    }

    /** The frame of the robot's base, whatever is mounted on it. */
    std::string robotBase() const {
        for (const std::string& frame : survey_.frames.frames()) {
            const std::string base = baseOf(survey_.frames, frame);
            if (!base.empty()) return base;
        }
        return "";
    }

    void noteUnknownMount(const std::string& sensor) {
        sequence_.notes.push_back("where " + sensor +
                                  " sits on the robot is not recorded: taken as the robot's base");
    }

    void takeOthers(const Mounts& mounts) {
        takeOdometry(survey_, sequence_, used_);
        takeScans(survey_, mounts, sequence_, used_);
        takeFixes(survey_, mounts, sequence_, used_);
        std::vector<RecordedTopic> left_out;
        for (const RecordedTopic& topic : survey_.topics) {
            const bool is_used = std::count(used_.begin(), used_.end(), topic.name) > 0;
            if (!is_used && !isAboutSensors(topic)) left_out.push_back(topic);
        }
        if (!left_out.empty()) sequence_.notes.push_back("left out: " + topicList(left_out));
    }

    /** What tells of sensors is no sensor itself. */
    static bool isAboutSensors(const RecordedTopic& topic) {
        return topic.type == "sensor_msgs/CameraInfo" || topic.type == "tf/tfMessage" ||
               topic.type == "tf2_msgs/TFMessage" || topic.type == "geometry_msgs/Transform" ||
               topic.type.find("Extrinsics") != std::string::npos ||
               topic.name.rfind("/device_", 0) == 0;
    }

    const BagSurvey& survey_;
    std::string bag_, base_;
    ImageChoice images_;
    std::vector<std::string> used_;
    RgbdSequence sequence_;
};

/** Writes the chosen images into a folder and lists them in the sequence. */
class ImageWriting {
  public:
    ImageWriting(const ImageChoice& images, const std::string& folder, RgbdSequence& sequence)
        : images_(images), folder_(folder), sequence_(sequence) {
        for (const char* kind : {"rgb", "depth"}) fs::create_directories(folder_ / kind);
    }

    void run(MessageSource& recording) {
        Progress progress("unpacking", 100, "%");
        recording.forEachMessage([&](const RecordedMessage& message, double share) {
            if (message.topic == images_.color.name) writeColor(message);
            if (message.topic == images_.depth.name) writeDepth(message);
            progress.update(static_cast<std::size_t>(100 * share));
        });
    }

  private:
    static bool isCompressed(const RecordedMessage& message) {
        return message.type == "sensor_msgs/CompressedImage";
    }

    void writeColor(const RecordedMessage& message) {
        if (isCompressed(message)) {
            const auto image = ros::readCompressedImage(message.reader());
            write("rgb", image.header, message, ros::colorFileOf(image), sequence_.color);
        } else {
            const auto image = ros::readImage(message.reader());
            write("rgb", image.header, message, ros::colorFileOf(image), sequence_.color);
        }
    }

    void writeDepth(const RecordedMessage& message) {
        const double units = *sequence_.depth_units;
        if (isCompressed(message)) {
            const auto image = ros::readCompressedImage(message.reader());
            write("depth", image.header, message, ros::depthFileOf(image, units), sequence_.depth);
        } else {
            const auto image = ros::readImage(message.reader());
            write("depth", image.header, message, ros::depthFileOf(image, units), sequence_.depth);
        }
    }

    void write(const std::string& kind, const ros::Header& header, const RecordedMessage& message,
               const ros::ImageFile& image, std::vector<ListedImage>& list) const {
        const double stamp_s = header.stamp_s > 0 ? header.stamp_s : message.recorded_s;
        const std::string name = kind + "/" + stampText(stamp_s) + image.extension;
        std::ofstream out(folder_ / name, std::ios::binary);
        out.write(image.bytes.data(), static_cast<std::streamsize>(image.bytes.size()));
        if (!out.flush()) {
            throw Error("cannot write '" + (folder_ / name).string() + "'", "check free space");
        }
        list.push_back({stamp_s, name});
    }

    const ImageChoice& images_;
    fs::path folder_;
    RgbdSequence& sequence_;
};

void tellMissing(const std::string& bag, const BagSurvey& survey) {
    if (survey.missing.empty()) return;
    std::size_t count = 0;
    for (const RecordedTopic& topic : survey.topics) count += topic.count;
    sayWarning("'" + bag + "' is not whole (" + survey.missing + "); reading the " +
               std::to_string(count) + " messages that are there");
}

void refuseIfEmpty(const RgbdSequence& sequence, const BagSurvey& survey, const std::string& bag) {
    const bool empty = sequence.acceleration.empty() && sequence.angular_velocity.empty() &&
                       sequence.odometry.empty() && sequence.others.empty();
    if (!empty) return;
    throw Error("'" + bag + "' holds no IMU, odometry, laser scans or GPS; its topics: " +
                    topicList(survey.topics),
                "give a recording of a robot");
}

}  // namespace

bool isBag(const std::string& path) {
    if (fs::is_directory(path)) return isBagFolder(path);
    return hasBagEnding(path) && fs::is_regular_file(path);
}

UnpackedBag::UnpackedBag(const std::string& bag, const std::string& scratch,
                         const BagOptions& options)
    : scratch_((fs::path(scratch) / "unpacked").string()) {
    BagFiles recording(bag, scratch_.path());
    const BagSurvey survey = surveyOf(recording);
    tellMissing(bag, survey);
    SequenceOfBag making(survey, bag);
    if (options.no_camera) {
        sequence_ = making.withoutCamera();
        refuseIfEmpty(sequence_, survey, bag);
    } else {
        const ImageChoice images =
            chooseImages(survey, bag, options.color_topic, options.depth_topic);
        sequence_ = making.withCamera(images);
        sequence_.folder = (fs::path(scratch_.path()) / bagName(bag)).string();
        ImageWriting(images, sequence_.folder, sequence_).run(recording);
    }
}

}  // namespace rgbd_graphslam
