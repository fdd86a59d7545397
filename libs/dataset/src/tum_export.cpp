#include "rgbd_graphslam/dataset/tum_export.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include "camera_survey.h"
#include "motion_lists.h"
#include "number_text.h"
#include "ordered_jobs.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/core/temporary_folder.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/image_output.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
using namespace mrpt::obs;
namespace {

/** The fewest digits of units per meter that give the same float back as meters per unit. */
double unitsAMetre(float metres_a_unit) {
    const double exact = 1 / static_cast<double>(metres_a_unit);
    for (double grain = 1; grain > 1e-9; grain /= 10) {
        const double rounded = std::round(exact / grain) * grain;
        if (static_cast<float>(1 / rounded) == metres_a_unit) return rounded;
    }
    return exact;
}

void writePng(const fs::path& path, const cv::Mat& pixels) {
    if (!writeImageFile(path.string(), pixels)) {
        throw Error("cannot write '" + path.string() + "'", "check free space");
    }
}

/** Color goes out as the file it came in as, where there is one. */
std::string originalColorFile(const CObservation3DRangeScan& frame) {
    const auto& image = frame.intensityImage;
    return image.isExternallyStored() ? image.getExternalStorageFileAbsolutePath() : "";
}

void writeImages(const CObservation3DRangeScan::Ptr& frame, const cv::Size& size,
                 const fs::path& color_path, const fs::path& depth_path) {
    const std::string original = originalColorFile(*frame);
    const RgbdImage image = colorAndDepth(frame);
    if (image.depth.size() != size) {
        throw Error("frame at stamp " + stampText(image.stamp_s) + " has " +
                        std::to_string(image.depth.cols) + "x" + std::to_string(image.depth.rows) +
                        " pixels, the first one " + std::to_string(size.width) + "x" +
                        std::to_string(size.height),
                    "a sequence has images of one size; export parts with --from and --to");
    }
    if (original.empty()) {
        writePng(color_path, image.color.empty() ? image.gray : image.color);
    } else {
        fs::copy_file(original, color_path);
    }
    writePng(depth_path, image.depth);
    if (image.mask.empty()) return;
    const fs::path mask_folder = color_path.parent_path().parent_path() / "mask";
    fs::create_directories(mask_folder);
    writePng(mask_folder / color_path.filename().replace_extension(".png"), image.mask);
}

/** What one camera of a rawlog is exported with. */
struct CameraExport {
    SurveyedCamera camera;
    /** Where --from and --to count from. */
    double first_stamp_s = 0;
    /** Frames are stamped by their number: none has a timestamp. */
    bool by_number = false;
};

/** The calibration, made to fit the images where it is for a whole multiple of their size. */
Intrinsics fittedTo(const cv::Size& image, const Intrinsics& camera,
                    std::vector<std::string>& notes) {
    if (camera.width == image.width && camera.height == image.height) return camera;
    const auto text = [](int width, int height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    const std::string sizes = "the calibration is for " + text(camera.width, camera.height) +
                              " pixels, the images have " + text(image.width, image.height);
    Intrinsics fitted = camera;
    fitted.width = image.width;
    fitted.height = image.height;
    if (camera.width == 0 || camera.height == 0) return fitted;
    const int factor = camera.width / std::max(1, image.width);
    if (factor < 2 || camera.width != factor * image.width ||
        camera.height != factor * image.height) {
        throw Error(sizes, "record the rawlog with the calibration of its images");
    }
    notes.push_back(sizes + "; it was scaled to them");
    fitted.fx /= factor;
    fitted.fy /= factor;
    fitted.cx = (camera.cx + 0.5) / factor - 0.5;
    fitted.cy = (camera.cy + 0.5) / factor - 0.5;
    return fitted;
}

class Export {
  public:
    /** \param folder empty; filled by run() */
    Export(const std::string& rawlog_path, fs::path folder, const ExportOptions& options,
           CameraExport what)
        : rawlog_path_(rawlog_path),
          folder_(std::move(folder)),
          options_(options),
          what_(std::move(what)) {
        makeWritableFolder((folder_ / "rgb").string());
        makeWritableFolder((folder_ / "depth").string());
    }

    ExportReport run() {
        RawlogReader reader(rawlog_path_);
        Progress progress("exporting", what_.camera.frames);
        while (const auto observation = reader.next()) {
            take(observation);
            progress.update(frames_seen_);
        }
        while (writing_.size() > 0) writing_.pop();
        if (report_.frames == 0) {
            throw Error("no frame of '" + rawlog_path_ + "' is within the bounds",
                        "--from and --to are seconds after the first frame");
        }
        writeLists();
        noteWhatWasLeftOut();
        return report_;
    }

  private:
    bool inBounds(double stamp_s) const {
        const double after_s = stamp_s - what_.first_stamp_s;
        return after_s >= options_.from_s && after_s <= options_.to_s;
    }

    void take(const CObservation::Ptr& observation) {
        if (const auto comment = std::dynamic_pointer_cast<CObservationComment>(observation)) {
            depth_stamps_ = depthStampsIn(comment->text);
        } else if (const auto frame =
                       std::dynamic_pointer_cast<CObservation3DRangeScan>(observation)) {
            if (frame->sensorLabel == what_.camera.label) takeFrame(frame, frames_seen_++);
        } else if (what_.by_number || inBounds(toSeconds(observation->timestamp))) {
            motion_.take(*observation);
        }
    }

    void takeFrame(const CObservation3DRangeScan::Ptr& frame, std::size_t number) {
        const bool has_stamp = frame->timestamp != INVALID_TIMESTAMP;
        if (!what_.by_number && !has_stamp) {
            ++without_stamp_;
            return;
        }
        const double stamp_s = what_.by_number ? static_cast<double>(number) / options_.rate_hz
                                               : toSeconds(frame->timestamp);
        if (!inBounds(stamp_s) || frames_in_bounds_++ % std::max(1, options_.every) != 0) return;
        if (!color_stamps_.insert(microseconds(stamp_s)).second) {
            ++repeated_;
            return;
        }
        if (report_.frames++ == 0) takeCalibration(frame);
        writeFrame(frame, stamp_s);
    }

    void writeFrame(const CObservation3DRangeScan::Ptr& frame, double stamp_s) {
        const double depth_stamp_s = depthStampOf(stamp_s);
        largest_difference_s_ = std::max(largest_difference_s_, std::abs(depth_stamp_s - stamp_s));
        const std::string original = originalColorFile(*frame);
        const std::string color =
            "rgb/" + stampText(stamp_s) +
            (original.empty() ? ".png" : fs::path(original).extension().string());
        const std::string depth = "depth/" + stampText(depth_stamp_s) + ".png";
        color_list_ += stampText(stamp_s) + " " + color + "\n";
        depth_list_ += stampText(depth_stamp_s) + " " + depth + "\n";
        const cv::Size size(setup_.camera.width, setup_.camera.height);
        writing_.push([frame, size, color_path = folder_ / color, depth_path = folder_ / depth] {
            writeImages(frame, size, color_path, depth_path);
        });
        while (writing_.size() >= static_cast<std::size_t>(options_.threads)) writing_.pop();
    }

    /** A depth stamp that another frame has taken would be a file that overwrites its. */
    double depthStampOf(double color_stamp_s) {
        const auto found = depth_stamps_.find(microseconds(color_stamp_s));
        const bool is_own =
            found != depth_stamps_.end() && depth_files_.insert(found->second).second;
        if (!is_own) depth_files_.insert(microseconds(color_stamp_s));
        return is_own ? static_cast<double>(found->second) * 1e-6 : color_stamp_s;
    }

    void takeCalibration(const CObservation3DRangeScan::Ptr& frame) {
        const cv::Size size = toRgbdImage(frame).depth.size();
        setup_.camera = fittedTo(size, toCamera(frame->cameraParamsIntensity), report_.notes);
        setup_.T_base_sensor = toSE3(frame->sensorPose);
        setup_.depth_units = unitsAMetre(frame->rangeUnits);
        T_base_cam_ = cameraOnRobot(*frame);
        if (!frame->doDepthAndIntensityCamerasCoincide()) {
            setup_.T_base_sensor = T_base_cam_ * T_optical_from_mrpt;
            report_.notes.push_back(
                "the rawlog gives the depth camera a calibration of its own: depth is exported "
                "registered to color");
        }
    }

    void writeLists() {
        if (motion_.imu > 0) {
            setup_.T_sensor_imu = setup_.T_base_sensor.inverse() * motion_.T_base_imu;
        }
        Trajectory truth = motion_.truth_of_base;
        for (auto& pose : truth) pose.T_world_cam = pose.T_world_cam * T_base_cam_;
        report_.imu = motion_.imu;
        report_.odometry = motion_.odometry;
        report_.truth = truth.size();
        write("camera.ini", toIniText(setup_));
        if (!truth.empty()) write("groundtruth.txt", toTumText(truth));
        if (!motion_.acceleration.empty()) write("accelerometer.txt", motion_.acceleration);
        if (!motion_.angular_velocity.empty()) write("gyroscope.txt", motion_.angular_velocity);
        if (!motion_.odometry_list.empty()) write("odometry.txt", motion_.odometry_list);
        write("depth.txt", depth_list_);
        write("rgb.txt", color_list_);
    }

    void noteWhatWasLeftOut() {
        const auto note = [&](std::size_t count, const std::string& why) {
            if (count > 0)
                report_.notes.push_back(std::to_string(count) + " frames left out: " + why);
        };
        if (what_.by_number) {
            report_.notes.push_back("no frame has a timestamp: named by their number, at " +
                                    shortest(options_.rate_hz) + " frames/s (--rate)");
        }
        note(without_stamp_, "without a timestamp");
        note(repeated_, "with the timestamp of an earlier one");
        if (largest_difference_s_ >= ImportOptions().max_difference_s) {
            char text[160];
            std::snprintf(
                text, sizeof text,
                "color and depth are up to %.3f s apart: import with --max-difference %.3f",
                largest_difference_s_, largest_difference_s_ + 0.001);
            report_.notes.push_back(text);
        }
        for (const std::string& line : motion_.notes()) report_.notes.push_back(line);
    }

    void write(const char* name, const std::string& text) const {
        writeTextAtomically((folder_ / name).string(), text);
    }

    std::string rawlog_path_;
    fs::path folder_;
    ExportOptions options_;
    CameraExport what_;
    std::size_t frames_seen_ = 0, frames_in_bounds_ = 0, without_stamp_ = 0, repeated_ = 0;
    std::set<long long> color_stamps_, depth_files_;
    double largest_difference_s_ = 0;
    DepthStamps depth_stamps_;
    CameraSetup setup_;
    SE3 T_base_cam_;
    std::string color_list_ = "# color images\n# timestamp filename\n";
    std::string depth_list_ = "# depth maps\n# timestamp filename\n";
    MotionLists motion_;
    ExportReport report_;
    OrderedJobs<void> writing_;
};

/** The cameras to export; all of them without a wish.
 *  \throws Error when there is none of the label */
std::vector<SurveyedCamera> chosenCameras(const std::vector<SurveyedCamera>& cameras,
                                          const ExportOptions& options) {
    if (options.sensor_label.empty()) return cameras;
    std::string labels;
    for (const auto& camera : cameras) {
        if (camera.label == options.sensor_label) return {camera};
        labels += (labels.empty() ? "'" : ", '") + camera.label + "'";
    }
    throw Error("no RGB-D camera is labelled '" + options.sensor_label + "'",
                "the rawlog has " + labels);
}

/** A folder's name that any file system takes and no two cameras share. */
std::string folderNameOf(const std::string& label, std::set<std::string>& taken) {
    std::string name = label.empty() ? "camera" : label;
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != '_'; }, '_');
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "_" + std::to_string(i);
    return unique;
}

}  // namespace

std::vector<ExportReport> exportTumSequence(const std::string& rawlog_path,
                                            const std::string& folder,
                                            const ExportOptions& options) {
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw Error("cannot make the folder '" + folder + "': that is a file",
                    "choose a new folder for the sequence");
    }
    if (fs::is_directory(folder) && !fs::is_empty(folder)) {
        throw Error("the folder '" + folder + "' is not empty",
                    "choose a new folder for the sequence");
    }
    const CameraSurvey survey = surveyCameras(rawlog_path);
    const auto cameras = chosenCameras(survey.cameras, options);
    const fs::path target = fs::absolute(folder).lexically_normal();
    const TemporaryFolder made(target.has_filename() ? target : target.parent_path());
    std::vector<ExportReport> reports;
    std::set<std::string> names;
    for (const auto& camera : cameras) {
        const std::string name = cameras.size() > 1 ? folderNameOf(camera.label, names) : "";
        const bool by_number = camera.stamped == 0;
        const CameraExport what = {camera, by_number ? 0 : survey.first_stamp_s.value_or(0),
                                   by_number};
        reports.push_back(Export(rawlog_path, fs::path(made.path()) / name, options, what).run());
        reports.back().camera = camera.label;
        reports.back().subfolder = name;
    }
    made.moveToFinalName();
    return reports;
}

}  // namespace rgbd_graphslam
