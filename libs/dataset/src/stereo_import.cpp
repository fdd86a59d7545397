#include "rgbd_graphslam/dataset/stereo_import.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "frame_pairs.h"
#include "ordered_jobs.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sensor_hints.h"
#include "sensor_entries.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

struct LoadedPair {
    std::string left_file, right_file;
    DecodedImage left, right;

    const std::string& damage() const { return left.damage.empty() ? right.damage : left.damage; }
};

void checkSize(const std::string& file, const DecodedImage& image,
               const mrpt::img::TCamera& camera) {
    const auto text = [](auto width, auto height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    const cv::Size size = image.pixels.size();
    if (size == cv::Size(static_cast<int>(camera.ncols), static_cast<int>(camera.nrows))) return;
    throw Error("'" + file + "' has " + text(size.width, size.height) +
                    " pixels, its calibration is for " + text(camera.ncols, camera.nrows),
                "give the calibration of these images with --camera");
}

std::string lensText(const mrpt::img::TCamera& camera) {
    using mrpt::img::DistortionModel;
    char text[160];
    const bool is_fisheye = camera.distortion == DistortionModel::kannala_brandt;
    const bool is_plain = camera.distortion == DistortionModel::none;
    std::snprintf(text, sizeof text, "%ux%u, fx %.6g, %s", camera.ncols, camera.nrows, camera.fx(),
                  is_fisheye ? "Kannala-Brandt fisheye"
                  : is_plain ? "no distortion"
                             : "plumb bob");
    return text;
}

/** Where the IMU and the left camera sit, in the terms of RGB-D recordings. */
CameraSetup setupOf(const StereoCalibration& calibration) {
    CameraSetup setup;
    setup.name = calibration.name;
    setup.T_base_sensor = calibration.T_base_left * T_optical_from_mrpt;
    setup.T_sensor_imu = setup.T_base_sensor.inverse() * calibration.T_base_imu;
    return setup;
}

std::vector<std::string> doubtsOf(const StereoCalibration& calibration) {
    std::vector<std::string> doubts;
    const std::string name = "the calibration '" + calibration.name + "'";
    for (const auto& [side, camera] :
         {std::pair("left", &calibration.left), std::pair("right", &calibration.right)}) {
        requirePrincipalPoint(toCamera(*camera), calibration.name);
        for (const std::string& doubt : doubtsOf(toCamera(*camera))) {
            doubts.push_back(name + ", " + side + " camera: " + doubt);
        }
    }
    const double x_m = calibration.T_left_right.t.x();
    if (x_m > 0 && x_m < 5) return doubts;
    char text[160];
    std::snprintf(text, sizeof text,
                  ": the right camera is %.3g m to the %s of the left one; are they exchanged, or "
                  "the baseline not in meters?",
                  std::abs(x_m), x_m > 0 ? "right" : "left");
    doubts.push_back(name + text);
    return doubts;
}

/** Writes one import's entries in order of time. */
class StereoImport {
  public:
    StereoImport(const StereoSequence& sequence, const ImportOptions& options)
        : sequence_(sequence),
          options_(options),
          calibration_(sequence.calibration),
          pairs_(pairUp(sequence.folder, {"left", sequence.left, report_.left},
                        {"right", sequence.right, report_.right}, options)) {
        completeSizes();
        ImportReport counts;
        sensors_ = SensorFeed(sensorEntries(sequence.motion, setupOf(calibration_), counts));
        report_.imu = counts.imu;
        report_.odometry = counts.odometry;
        report_.truth = counts.truth;
        noteCalibration();
        warn();
    }

    void write(RawlogWriter& writer) {
        writeComment(writer);
        Progress progress("importing", pairs_.size());
        OrderedJobs<LoadedPair> loading;
        std::size_t next_load = 0;
        const auto ahead = static_cast<std::size_t>(std::max(1, options_.threads));
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            for (; next_load < pairs_.size() && loading.size() < ahead; ++next_load) {
                loading.push([this, &pair = pairs_[next_load]] { return load(pair); });
            }
            sensors_.writeUntil(toMrptTime(pairs_[i].first.stamp_s), writer);
            writePair(pairs_[i].first.stamp_s, loading.pop(), writer);
            progress.update(i + 1);
        }
        sensors_.writeRest(writer);
    }

    const StereoReport& report() const { return report_; }

  private:
    std::string pathOf(const ListedImage& image) const {
        return fs::path(sequence_.folder) / image.file;
    }

    /** From the first pair that is whole. */
    void completeSizes() {
        if (calibration_.left.ncols > 0 && calibration_.right.ncols > 0) return;
        for (const ImagePair& pair : pairs_) {
            const LoadedPair loaded = decode(pair);
            if (!loaded.damage().empty()) continue;
            for (auto [camera, image] : {std::pair(&calibration_.left, &loaded.left),
                                         std::pair(&calibration_.right, &loaded.right)}) {
                camera->ncols = static_cast<std::uint32_t>(image->pixels.cols);
                camera->nrows = static_cast<std::uint32_t>(image->pixels.rows);
            }
            return;
        }
    }

    void noteCalibration() {
        char baseline[40];
        std::snprintf(baseline, sizeof baseline, "; baseline %.4g m",
                      calibration_.T_left_right.t.norm());
        report_.notes = sequence_.motion.notes;
        report_.notes.push_back("left camera: " + lensText(calibration_.left) +
                                "; right camera: " + lensText(calibration_.right) + baseline);
    }

    void warn() const {
        std::vector<std::string> doubts = doubtsOf(calibration_);
        if (options_.strict && !doubts.empty()) {
            throw Error(doubts.front(), "or leave out --strict to import it all the same");
        }
        for (std::string& hint : sensorHints(sequence_.motion)) doubts.push_back(std::move(hint));
        for (const std::string& doubt : doubts) sayWarning(doubt);
    }

    LoadedPair decode(const ImagePair& pair) const {
        const std::string left = pathOf(pair.first), right = pathOf(pair.second);
        return {left, right, readGrayOrColorImage(left), readGrayOrColorImage(right)};
    }

    LoadedPair load(const ImagePair& pair) const {
        LoadedPair loaded = decode(pair);
        if (!loaded.damage().empty()) return loaded;
        checkSize(loaded.left_file, loaded.left, calibration_.left);
        checkSize(loaded.right_file, loaded.right, calibration_.right);
        return loaded;
    }

    void writeComment(RawlogWriter& writer) const {
        mrpt::obs::CObservationComment comment;
        comment.timestamp = sensors_.firstTime(toMrptTime(pairs_.front().first.stamp_s));
        comment.text =
            "[source]\nsequence = " + fs::weakly_canonical(sequence_.folder).filename().string() +
            "\ncamera = " + fs::path(calibration_.name).filename().string() + "\n";
        writer.write(comment);
    }

    void writePair(double stamp_s, const LoadedPair& loaded, RawlogWriter& writer) {
        if (!loaded.damage().empty()) {
            countDamage(loaded.damage());
            return;
        }
        mrpt::obs::CObservationStereoImages pair;
        pair.sensorLabel = stereo_label;
        pair.timestamp = toMrptTime(stamp_s);
        pair.leftCamera = calibration_.left;
        pair.rightCamera = calibration_.right;
        pair.cameraPose = mrpt::poses::CPose3DQuat(toCPose3D(calibration_.T_base_left));
        pair.rightCameraPose = mrpt::poses::CPose3DQuat(toCPose3D(calibration_.T_left_right));
        pair.imageLeft = mrpt::img::CImage(loaded.left.pixels, mrpt::img::SHALLOW_COPY);
        pair.imageRight = mrpt::img::CImage(loaded.right.pixels, mrpt::img::SHALLOW_COPY);
        pair.hasImageRight = true;
        writer.writePair(pair, loaded.left_file, loaded.right_file);
        if (report_.pairs++ == 0) {
            report_.first_stamp_s = stamp_s;
        } else {
            report_.longest_gap_s = std::max(report_.longest_gap_s, stamp_s - report_.last_stamp_s);
        }
        report_.last_stamp_s = stamp_s;
    }

    void countDamage(const std::string& damage) {
        if (!options_.skip_damaged) {
            throw Error("image " + damage,
                        "fetch the sequence again, or leave such pairs out with --skip-damaged");
        }
        sayDetail("left out: " + damage);
        ++report_.damaged;
    }

    const StereoSequence& sequence_;
    const ImportOptions& options_;
    StereoReport report_;
    StereoCalibration calibration_;
    std::vector<ImagePair> pairs_;
    SensorFeed sensors_{{}};
};

}  // namespace

std::string toText(const StereoReport& report) {
    const double span_s = report.last_stamp_s - report.first_stamp_s;
    char line[256];
    std::string text;
    for (const std::string& note : report.notes) text += note + "\n";
    std::snprintf(line, sizeof line,
                  "%zu stereo pairs over %.2f s, %.1f per second, longest gap %.2f s", report.pairs,
                  span_s, span_s > 0 ? static_cast<double>(report.pairs - 1) / span_s : 0.0,
                  report.longest_gap_s);
    text += line;
    if (report.damaged > 0) text += "; " + std::to_string(report.damaged) + " left out as damaged";
    text += "\n" + tallyText("left", "right image", report.left) +
            tallyText("right", "left image", report.right);
    std::snprintf(line, sizeof line,
                  "%zu IMU readings, %zu odometry readings, %zu ground truth poses\n"
                  "imported in %.1f s, %.0f pairs/s\n",
                  report.imu, report.odometry, report.truth, report.seconds,
                  static_cast<double>(report.pairs) / std::max(1e-3, report.seconds));
    return text + line;
}

StereoReport importStereo(const StereoSequence& sequence, const std::string& rawlog_path,
                          const ImportOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    StereoImport import(sequence, options);
    writeRawlog(rawlog_path, options.storage, [&](RawlogWriter& writer) { import.write(writer); });
    StereoReport report = import.report();
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace rgbd_graphslam
