#include "rgbd_graphslam/dataset/tum_export.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "number_text.h"
#include "ordered_jobs.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/core/temporary_folder.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
using namespace mrpt::obs;
namespace {

/** The fewest digits of units a metre that give the same float back as metres a unit. */
double unitsAMetre(float metres_a_unit) {
    const double exact = 1 / static_cast<double>(metres_a_unit);
    for (double grain = 1; grain > 1e-9; grain /= 10) {
        const double rounded = std::round(exact / grain) * grain;
        if (static_cast<float>(1 / rounded) == metres_a_unit) return rounded;
    }
    return exact;
}

void writePng(const fs::path& path, const cv::Mat& pixels) {
    if (!cv::imwrite(path.string(), pixels)) {
        throw Error("cannot write '" + path.string() + "'", "check free space");
    }
}

/** Colour goes out as the file it came in as, where there is one. */
std::string originalColorFile(const CObservation3DRangeScan& frame) {
    const auto& image = frame.intensityImage;
    return image.isExternallyStored() ? image.getExternalStorageFileAbsolutePath() : "";
}

void writeImages(const CObservation3DRangeScan::Ptr& frame, const fs::path& color_path,
                 const fs::path& depth_path) {
    const std::string original = originalColorFile(*frame);
    const RgbdImage image = toRgbdImage(frame);
    if (original.empty()) {
        writePng(color_path, image.color.empty() ? image.grey : image.color);
    } else {
        fs::copy_file(original, color_path);
    }
    writePng(depth_path, image.depth);
}

/** Text files of a sequence, kept in memory until the images are on disk. */
struct Lists {
    std::string color = "# color images\n# timestamp filename\n";
    std::string depth = "# depth maps\n# timestamp filename\n";
    std::string acceleration, angular_velocity, odometry;
};

void appendVector(std::string& list, const char* header, double stamp_s,
                  const std::array<double, 3>& values) {
    if (list.empty()) list = header;
    list += stampText(stamp_s);
    for (const double value : values) list += " " + shortest(value);
    list += "\n";
}

class Export {
  public:
    /** \param folder empty; filled by run() */
    Export(const std::string& rawlog_path, fs::path folder, const ExportOptions& options)
        : rawlog_path_(rawlog_path), folder_(std::move(folder)), options_(options) {
        const RawlogInfo info = inspectRawlog(rawlog_path);
        if (!info.damage.empty()) throw Error(info.damage);
        if (info.rgbd_frames == 0) {
            throw Error("'" + rawlog_path + "' holds no RGB-D frame", "give a rawlog with RGB-D");
        }
        first_stamp_s_ = info.first_stamp_s;
        frames_in_rawlog_ = info.rgbd_frames;
        makeWritableFolder((folder_ / "rgb").string());
        makeWritableFolder((folder_ / "depth").string());
    }

    ExportReport run() {
        RawlogReader reader(rawlog_path_);
        Progress progress("exporting", frames_in_rawlog_);
        while (const auto observation = reader.next()) {
            take(observation);
            progress.update(frames_seen_);
        }
        while (writing_.size() > 0) writing_.pop();
        if (report_.frames == 0) {
            throw Error("no frame of '" + rawlog_path_ + "' is within the bounds",
                        "--from and --to are seconds after the first frame");
        }
        writeTruth();
        writeLists();
        return report_;
    }

  private:
    bool inBounds(double stamp_s) const {
        const double after_s = stamp_s - first_stamp_s_;
        return after_s >= options_.from_s && after_s <= options_.to_s;
    }

    void take(const CObservation::Ptr& observation) {
        const auto as = [&](auto* type) {
            return std::dynamic_pointer_cast<std::remove_pointer_t<decltype(type)>>(observation);
        };
        if (const auto comment = as(static_cast<CObservationComment*>(nullptr))) {
            depth_stamps_ = depthStampsIn(comment->text);
        } else if (const auto frame = as(static_cast<CObservation3DRangeScan*>(nullptr))) {
            ++frames_seen_;
            takeFrame(frame);
        } else if (!inBounds(toSeconds(observation->timestamp))) {
            return;
        } else if (const auto imu = as(static_cast<CObservationIMU*>(nullptr))) {
            takeImu(*imu);
        } else if (const auto odometry = as(static_cast<CObservationOdometry*>(nullptr))) {
            takeOdometry(*odometry);
        }
    }

    void takeFrame(const CObservation3DRangeScan::Ptr& frame) {
        const double stamp_s = toSeconds(frame->timestamp);
        if (!inBounds(stamp_s) || frames_in_bounds_++ % std::max(1, options_.every) != 0) return;
        if (report_.frames++ == 0) takeCalibration(*frame);
        const double depth_stamp_s = depthStampOf(stamp_s);
        const std::string original = originalColorFile(*frame);
        const std::string color =
            "rgb/" + stampText(stamp_s) +
            (original.empty() ? ".png" : fs::path(original).extension().string());
        const std::string depth = "depth/" + stampText(depth_stamp_s) + ".png";
        lists_.color += stampText(stamp_s) + " " + color + "\n";
        lists_.depth += stampText(depth_stamp_s) + " " + depth + "\n";
        writing_.push([frame, color_path = folder_ / color, depth_path = folder_ / depth] {
            writeImages(frame, color_path, depth_path);
        });
        while (writing_.size() >= static_cast<std::size_t>(options_.threads)) writing_.pop();
    }

    double depthStampOf(double color_stamp_s) const {
        const auto found = depth_stamps_.find(microseconds(color_stamp_s));
        return found == depth_stamps_.end() ? color_stamp_s : found->second * 1e-6;
    }

    void takeCalibration(const CObservation3DRangeScan& frame) {
        setup_.camera = cameraOf(frame);
        setup_.T_base_sensor = toSE3(frame.sensorPose);
        setup_.depth_units = unitsAMetre(frame.rangeUnits);
    }

    void takeImu(const CObservationIMU& imu) {
        const double stamp_s = toSeconds(imu.timestamp);
        if (report_.imu++ == 0) T_base_imu_ = toSE3(imu.sensorPose);
        if (imu.has(IMU_X_ACC)) {
            appendVector(lists_.acceleration, "# accelerometer data\n# timestamp ax ay az\n",
                         stamp_s, {imu.get(IMU_X_ACC), imu.get(IMU_Y_ACC), imu.get(IMU_Z_ACC)});
        }
        if (imu.has(IMU_WX)) {
            appendVector(lists_.angular_velocity, "# gyroscope data\n# timestamp wx wy wz\n",
                         stamp_s, {imu.get(IMU_WX), imu.get(IMU_WY), imu.get(IMU_WZ)});
        }
    }

    void takeOdometry(const CObservationOdometry& odometry) {
        const auto& pose = odometry.odometry;
        ++report_.odometry;
        appendVector(lists_.odometry, "# odometry\n# timestamp x y theta\n",
                     toSeconds(odometry.timestamp), {pose.x(), pose.y(), pose.phi()});
    }

    void writeTruth() {
        Trajectory truth;
        for (const auto& pose : truthOf(rawlog_path_)) {
            if (inBounds(pose.stamp_s)) truth.push_back(pose);
        }
        report_.truth = truth.size();
        if (!truth.empty()) write("groundtruth.txt", toTumText(truth));
    }

    void writeLists() {
        if (report_.imu > 0) setup_.T_sensor_imu = setup_.T_base_sensor.inverse() * T_base_imu_;
        write("camera.ini", toIniText(setup_));
        if (!lists_.acceleration.empty()) write("accelerometer.txt", lists_.acceleration);
        if (!lists_.angular_velocity.empty()) write("gyroscope.txt", lists_.angular_velocity);
        if (!lists_.odometry.empty()) write("odometry.txt", lists_.odometry);
        write("depth.txt", lists_.depth);
        write("rgb.txt", lists_.color);
    }

    void write(const char* name, const std::string& text) const {
        writeTextAtomically((folder_ / name).string(), text);
    }

    std::string rawlog_path_;
    fs::path folder_;
    ExportOptions options_;
    double first_stamp_s_ = 0;
    std::size_t frames_in_rawlog_ = 0, frames_seen_ = 0, frames_in_bounds_ = 0;
    DepthStamps depth_stamps_;
    CameraSetup setup_;
    SE3 T_base_imu_;
    Lists lists_;
    ExportReport report_;
    OrderedJobs<void> writing_;
};

}  // namespace

ExportReport exportTumSequence(const std::string& rawlog_path, const std::string& folder,
                               const ExportOptions& options) {
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw Error("cannot make the folder '" + folder + "': that is a file",
                    "choose a new folder for the sequence");
    }
    if (fs::is_directory(folder) && !fs::is_empty(folder)) {
        throw Error("the folder '" + folder + "' is not empty",
                    "choose a new folder for the sequence");
    }
    const fs::path target = fs::absolute(folder).lexically_normal();
    const TemporaryFolder made(target.has_filename() ? target : target.parent_path());
    const ExportReport report = Export(rawlog_path, made.path(), options).run();
    made.moveToFinalName();
    return report;
}

}  // namespace rgbd_graphslam
