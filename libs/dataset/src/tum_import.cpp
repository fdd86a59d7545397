#include "rgbd_graphslam/dataset/tum_import.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "number_text.h"
#include "ordered_jobs.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/geometry/associate.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

struct FramePair {
    ListedImage color, depth;
};

long long microseconds(double stamp_s) {
    return std::llround(stamp_s * 1e6);
}

/** Images whose file exists, in order of time, each stamp once. */
std::vector<ListedImage> usableImages(const TumSequence& sequence,
                                      const std::vector<ListedImage>& images, bool strict,
                                      ImageTally& tally) {
    tally.listed = images.size();
    tally.backwards = stampOrder(images).backwards;
    std::set<long long> seen;
    std::vector<ListedImage> usable;
    for (const auto& image : images) {
        const fs::path file = fs::path(sequence.folder) / image.file;
        if (!fs::is_regular_file(file)) {
            if (strict) {
                throw Error("the listed image '" + file.string() + "' is missing",
                            "fetch the sequence again, or leave out --strict to go on without it");
            }
            ++tally.missing;
        } else if (!seen.insert(microseconds(image.stamp_s)).second) {
            ++tally.repeated;
        } else {
            usable.push_back(image);
        }
    }
    std::stable_sort(usable.begin(), usable.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
    return usable;
}

std::vector<double> stampsOf(const std::vector<ListedImage>& images) {
    std::vector<double> stamps;
    for (const auto& image : images) stamps.push_back(image.stamp_s);
    return stamps;
}

/** Tells images that had nobody near from those whose partners went to others.
 *  \param own, other ascending stamps */
void tallyLeftOver(const std::vector<double>& own, const std::vector<bool>& paired,
                   const std::vector<double>& other, double max_difference, ImageTally& tally) {
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (paired[i]) continue;
        const auto next = std::lower_bound(other.begin(), other.end(), own[i]);
        const bool near = (next != other.end() && *next - own[i] < max_difference) ||
                          (next != other.begin() && own[i] - *(next - 1) < max_difference);
        ++(near ? tally.partner_taken : tally.no_partner);
    }
}

std::vector<FramePair> pairUp(const TumSequence& sequence, const ImportOptions& options,
                              ImportReport& report) {
    const auto color = usableImages(sequence, sequence.color, options.strict, report.color);
    const auto depth = usableImages(sequence, sequence.depth, options.strict, report.depth);
    const auto color_stamps = stampsOf(color), depth_stamps = stampsOf(depth);
    std::vector<bool> color_paired(color.size()), depth_paired(depth.size());
    std::vector<FramePair> pairs;
    for (const auto& [i, j] : associate(color_stamps, depth_stamps, options.max_difference_s)) {
        pairs.push_back({color[i], depth[j]});
        color_paired[i] = depth_paired[j] = true;
    }
    tallyLeftOver(color_stamps, color_paired, depth_stamps, options.max_difference_s, report.color);
    tallyLeftOver(depth_stamps, depth_paired, color_stamps, options.max_difference_s, report.depth);
    if (pairs.empty()) {
        throw Error("no colour and depth image of '" + sequence.folder + "' are within " +
                        shortest(options.max_difference_s) + " s of each other" +
                        (color.empty() || depth.empty() ? ", the listed files are missing" : ""),
                    "check rgb.txt and depth.txt, or raise --max-difference");
    }
    return pairs;
}

/** Entries other than frames, one stamp after the other. */
using SensorEntries = std::vector<mrpt::obs::CObservation::Ptr>;

void addTruth(const TumSequence& sequence, const CameraSetup& setup, SensorEntries& entries) {
    const SE3 T_cam_base = T_optical_from_mrpt * setup.T_base_sensor.inverse();
    for (const auto& [stamp_s, T_world_cam] : sequence.truth) {
        auto pose = mrpt::obs::CObservationRobotPose::Create();
        pose->sensorLabel = ground_truth_label;
        pose->timestamp = toMrptTime(stamp_s);
        pose->pose.mean = toCPose3D(T_world_cam * T_cam_base);
        entries.push_back(pose);
    }
}

using ImuAxes = std::array<mrpt::obs::TIMUDataIndex, 3>;

void set(mrpt::obs::CObservationIMU& imu, const ImuAxes& axes, const Eigen::Vector3d& value) {
    for (int i = 0; i < 3; ++i) imu.set(axes[i], value[i]);
}

mrpt::obs::CObservationIMU::Ptr imuReading(const CameraSetup& setup, double stamp_s) {
    auto imu = mrpt::obs::CObservationIMU::Create();
    imu->sensorLabel = imu_label;
    imu->timestamp = toMrptTime(stamp_s);
    imu->sensorPose = toCPose3D(setup.T_base_sensor * setup.T_sensor_imu);
    return imu;
}

/** Readings of accelerometer and gyroscope at the same stamp share an observation. */
void addImu(const TumSequence& sequence, const CameraSetup& setup, SensorEntries& entries) {
    using namespace mrpt::obs;
    const ImuAxes linear = {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC}, angular = {IMU_WX, IMU_WY, IMU_WZ};
    std::map<long long, CObservationIMU::Ptr> without_angular;
    for (const auto& sample : sequence.acceleration) {
        const auto imu = imuReading(setup, sample.stamp_s);
        set(*imu, linear, sample.value);
        without_angular[microseconds(sample.stamp_s)] = imu;
        entries.push_back(imu);
    }
    for (const auto& sample : sequence.angular_velocity) {
        auto partner = without_angular.extract(microseconds(sample.stamp_s));
        const auto imu = partner ? partner.mapped() : imuReading(setup, sample.stamp_s);
        set(*imu, angular, sample.value);
        if (!partner) entries.push_back(imu);
    }
}

void addOdometry(const TumSequence& sequence, SensorEntries& entries) {
    for (const auto& sample : sequence.odometry) {
        auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = odometry_label;
        odometry->timestamp = toMrptTime(sample.stamp_s);
        odometry->odometry = {sample.value.x(), sample.value.y(), sample.value.z()};
        entries.push_back(odometry);
    }
}

SensorEntries sensorEntries(const TumSequence& sequence, const CameraSetup& setup,
                            ImportReport& report) {
    SensorEntries entries;
    addTruth(sequence, setup, entries);
    report.truth = entries.size();
    addImu(sequence, setup, entries);
    report.imu = entries.size() - report.truth;
    addOdometry(sequence, entries);
    report.odometry = entries.size() - report.truth - report.imu;
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a->timestamp < b->timestamp; });
    return entries;
}

DepthStamps depthStampsOf(const std::vector<FramePair>& pairs) {
    DepthStamps stamps;
    for (const auto& pair : pairs) {
        const auto color_us = microseconds(pair.color.stamp_s);
        const auto depth_us = microseconds(pair.depth.stamp_s);
        if (color_us != depth_us) stamps[color_us] = depth_us;
    }
    return stamps;
}

/** A frame on its way from disk to rawlog. */
struct LoadedFrame {
    std::string color_file;
    cv::Mat color, depth;
    std::string damage;
};

void checkSize(const std::string& file, const cv::Mat& pixels, const Camera& camera) {
    if (pixels.cols == camera.width && pixels.rows == camera.height) return;
    const auto size = [](int columns, int rows) {
        return std::to_string(columns) + "x" + std::to_string(rows);
    };
    throw Error("'" + file + "' has " + size(pixels.cols, pixels.rows) + " pixels, the camera " +
                    size(camera.width, camera.height),
                "colour and depth must have one size, which --camera FILE.ini gives as resolution");
}

LoadedFrame load(const std::string& folder, const FramePair& pair, const Camera& camera) {
    const std::string color_file = fs::path(folder) / pair.color.file;
    const std::string depth_file = fs::path(folder) / pair.depth.file;
    const DecodedImage color = readColorImage(color_file), depth = readDepthImage(depth_file);
    const std::string damage = color.damage.empty() ? depth.damage : color.damage;
    if (!damage.empty()) return {color_file, {}, {}, damage};
    checkSize(color_file, color.pixels, camera);
    checkSize(depth_file, depth.pixels, camera);
    return {color_file, color.pixels, depth.pixels, {}};
}

/** Writes one import's entries in order of time. */
class Import {
  public:
    Import(const TumSequence& sequence, const CameraSetup& setup, const ImportOptions& options)
        : sequence_(sequence),
          setup_(setup),
          options_(options),
          pairs_(pairUp(sequence, options, report_)),
          sensors_(sensorEntries(sequence, setup, report_)) {}

    void write(RawlogWriter& writer) {
        writeComment(writer);
        Progress progress("importing", pairs_.size());
        OrderedJobs<LoadedFrame> loading;
        std::size_t next_load = 0, next_sensor = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            for (; next_load < pairs_.size() && loading.size() < ahead(); ++next_load) {
                loading.push([this, &pair = pairs_[next_load]] {
                    return load(sequence_.folder, pair, setup_.camera);
                });
            }
            writeSensorsUntil(toMrptTime(pairs_[i].color.stamp_s), next_sensor, writer);
            writeFrame(pairs_[i], loading.pop(), writer);
            progress.update(i + 1);
        }
        writeSensorsUntil(mrpt::Clock::time_point::max(), next_sensor, writer);
    }

    const ImportReport& report() const { return report_; }

  private:
    std::size_t ahead() const { return static_cast<std::size_t>(std::max(1, options_.threads)); }

    void writeComment(RawlogWriter& writer) const {
        mrpt::obs::CObservationComment comment;
        comment.timestamp = firstTime();
        comment.text =
            "[source]\nsequence = " + fs::weakly_canonical(sequence_.folder).filename().string() +
            "\ncamera = " + fs::path(setup_.name).filename().string() + "\n" +
            toIniText(depthStampsOf(pairs_));
        writer.write(comment);
    }

    mrpt::Clock::time_point firstTime() const {
        const auto first_frame = toMrptTime(pairs_.front().color.stamp_s);
        return sensors_.empty() ? first_frame : std::min(first_frame, sensors_.front()->timestamp);
    }

    void writeSensorsUntil(mrpt::Clock::time_point time, std::size_t& next, RawlogWriter& writer) {
        for (; next < sensors_.size() && sensors_[next]->timestamp <= time; ++next) {
            writer.write(*sensors_[next]);
        }
    }

    void writeFrame(const FramePair& pair, const LoadedFrame& loaded, RawlogWriter& writer) {
        if (!loaded.damage.empty()) {
            countDamage(loaded.damage);
            return;
        }
        const auto frame = makeRgbdObservation(setup_, pair.color.stamp_s);
        setColor(*frame, loaded.color);
        setDepth(*frame, loaded.depth);
        writer.writeFrame(*frame, loaded.color_file);
        if (report_.frames++ == 0) report_.first_stamp_s = pair.color.stamp_s;
        report_.last_stamp_s = pair.color.stamp_s;
    }

    void countDamage(const std::string& damage) {
        if (!options_.skip_damaged) {
            throw Error("image " + damage,
                        "fetch the sequence again, or leave such frames out with --skip-damaged");
        }
        sayDetail("left out: " + damage);
        ++report_.damaged;
    }

    const TumSequence& sequence_;
    const CameraSetup& setup_;
    const ImportOptions& options_;
    ImportReport report_;
    std::vector<FramePair> pairs_;
    SensorEntries sensors_;
};

std::string tallyText(const std::string& name, const std::string& other, const ImageTally& tally) {
    std::string text = name + ": " + std::to_string(tally.listed) + " listed, " +
                       std::to_string(tally.leftOver()) + " left over";
    std::string reasons;
    const auto reason = [&](std::size_t count, const std::string& why) {
        if (count > 0) reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + why;
    };
    reason(tally.no_partner, "without " + other + " near enough");
    reason(tally.partner_taken, "whose " + other + " went to a nearer one");
    reason(tally.missing, "files missing");
    reason(tally.repeated, "stamps repeated");
    if (!reasons.empty()) text += " (" + reasons + ")";
    return text + "; " + std::to_string(tally.backwards) + " stamps go back, " +
           std::to_string(tally.repeated) + " repeat\n";
}

}  // namespace

std::string toText(const ImportReport& report) {
    const double span = report.last_stamp_s - report.first_stamp_s;
    char line[256];
    std::snprintf(line, sizeof(line), "%zu frames over %.2f s, %.1f a second", report.frames, span,
                  span > 0 ? (report.frames - 1) / span : 0.0);
    std::string text = line;
    if (report.damaged > 0) text += "; " + std::to_string(report.damaged) + " left out as damaged";
    text += "\n" + tallyText("colour", "depth", report.color) +
            tallyText("depth", "colour", report.depth);
    std::snprintf(line, sizeof(line),
                  "%zu IMU readings, %zu odometry readings, %zu ground truth poses\n"
                  "imported in %.1f s, %.0f frames a second\n",
                  report.imu, report.odometry, report.truth, report.seconds,
                  report.frames / std::max(1e-3, report.seconds));
    return text + line;
}

ImportReport importTumSequence(const TumSequence& sequence, const CameraSetup& setup,
                               const std::string& rawlog_path, const ImportOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    Import import(sequence, setup, options);
    writeRawlog(rawlog_path, options.storage, [&](RawlogWriter& writer) { import.write(writer); });
    ImportReport report = import.report();
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace rgbd_graphslam
