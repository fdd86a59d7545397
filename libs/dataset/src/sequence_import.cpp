#include "rgbd_graphslam/dataset/sequence_import.h"

#include <mrpt/obs/CObservationComment.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "depth_confidence.h"
#include "frame_pairs.h"
#include "frame_source.h"
#include "number_text.h"
#include "ordered_jobs.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/label_observation.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sensor_hints.h"
#include "sensor_entries.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

DepthStamps depthStampsOf(const std::vector<FramePair>& pairs) {
    DepthStamps stamps;
    for (const auto& pair : pairs) {
        const auto color_us = microseconds(pair.color.stamp_s);
        const auto depth_us = microseconds(pair.depth.stamp_s);
        if (color_us != depth_us) stamps[color_us] = depth_us;
    }
    return stamps;
}

/** Over a sequence, so many frames are looked at for how depth lies to color, and for the lens. */
constexpr std::size_t frames_checked = 20;

/** What is wrong with depth's unit, and which would be plausible; empty when nothing is.
 *  \param camera_file where the unit may be stated */
std::string doubtOfUnits(const DepthHistogram& depth, double units, bool assumed,
                         const std::string& camera_file) {
    const DepthSummary summary = summarize(depth, 1 / units);
    const auto better = plausibleDepthUnits(depth, units, assumed);
    if (!better && !isImplausible(summary)) return {};
    char text[320];
    std::snprintf(text, sizeof text,
                  "depth is implausible: with depth_units = %.6g%s the median is %.2g m and 95 %% "
                  "of the readings are within %.2g m",
                  units, assumed ? " (assumed, nothing states it)" : "", summary.median_m,
                  summary.far_m);
    const std::string found = text;
    if (!better) return found + "; check depth_units and depth_scale in " + camera_file;
    std::snprintf(text, sizeof text, "; depth_units = %.6g would give a median of %.2g m", *better,
                  summary.median_m * units / *better);
    return found + text + ": set it in " + camera_file + " or pass --depth-units";
}

std::string depthMaxText(const DepthSummary& summary, double depth_max_m) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "%.0f %% of the depth readings are beyond %.0f m; rgbd-slam uses them unless its "
                  "FeatureOptions.depth_max_m is set below %.3g",
                  100 * summary.share_beyond, usual_max_depth_m, depth_max_m);
    return text;
}

std::string registrationText(const Misregistration& found, double fx_px, bool is_registered) {
    return toText(found, fx_px) +
           (is_registered ? "; check the cameras' calibrations and poses"
                          : "; register it with --register camera_depth.ini, see --help");
}

std::string lagText(const DepthLag& lag, double offset_s) {
    char text[240];
    std::snprintf(text, sizeof text,
                  "depth seems to come %.0f ms %s than color (%d frame%s): its outlines fit the "
                  "color images of then; correct its stamps with --depth-offset %.3f",
                  1e3 * std::abs(lag.seconds), lag.seconds > 0 ? "later" : "earlier",
                  std::abs(lag.frames), std::abs(lag.frames) == 1 ? "" : "s",
                  offset_s - lag.seconds);
    return text;
}

/** Writes one import's entries in order of time. */
class Import {
  public:
    Import(const RgbdSequence& sequence, const CameraSetup& setup, const ImportOptions& options)
        : sequence_(sequence),
          options_(options),
          pairs_(pairUp(sequence, options, report_)),
          source_(sequence, setup, options, pairs_),
          setup_(source_.setup()),
          lag_(pairs_.size()),
          lens_(setup_.camera),
          sensors_(sensorEntries(sequence, setup, report_)) {
        judgeCalibration();
    }

    void write(RawlogWriter& writer) {
        writeComment(writer);
        Progress progress("importing", pairs_.size());
        OrderedJobs<LoadedFrame> loading;
        std::size_t next_load = 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            for (; next_load < pairs_.size() && loading.size() < ahead(); ++next_load) {
                loading.push([this, &pair = pairs_[next_load]] { return source_.load(pair); });
            }
            sensors_.writeUntil(toMrptTime(pairs_[i].color.stamp_s), writer);
            writeFrame(pairs_[i], loading.pop(), writer);
            progress.update(i + 1);
        }
        sensors_.writeRest(writer);
        report_.notes = sequence_.notes;
        if (converted_ > 0) {
            report_.notes.push_back(
                std::to_string(converted_) + " depth images in meters, converted to " +
                shortest(std::round(source_.depthUnits())) + " units per meter");
        }
        if (masked_ > 0) {
            report_.notes.push_back(std::to_string(masked_) + " of " +
                                    std::to_string(report_.frames) + " frames have a mask");
        }
        if (labeled_ > 0) {
            report_.notes.push_back(std::to_string(labeled_) + " of " +
                                    std::to_string(report_.frames) + " frames have labels, of " +
                                    std::to_string(source_.labelNames().size()) + " named classes");
        }
        report_.notes.insert(report_.notes.end(), source_.notes().begin(), source_.notes().end());
        judgeRegistration();
        judgeLens();
        judgeDepthUnit();
        if (options_.strict && !report_.warnings.empty()) {
            throw Error(report_.warnings.front(),
                        "or leave out --strict to import it all the same");
        }
        noteFarDepth();
    }

    const ImportReport& report() const { return report_; }

  private:
    std::size_t ahead() const { return static_cast<std::size_t>(std::max(1, options_.threads)); }

    void writeComment(RawlogWriter& writer) const {
        mrpt::obs::CObservationComment comment;
        comment.timestamp = sensors_.firstTime(toMrptTime(pairs_.front().color.stamp_s));
        comment.text =
            "[source]\nsequence = " + fs::weakly_canonical(sequence_.folder).filename().string() +
            "\ncamera = " + fs::path(setup_.name).filename().string() + "\n" +
            toIniText(depthStampsOf(pairs_));
        if (!source_.labelNames().empty()) comment.text += "\n" + toComment(source_.labelNames());
        writer.write(comment);
    }

    void writeFrame(const FramePair& pair, const LoadedFrame& loaded, RawlogWriter& writer) {
        if (!loaded.damage.empty()) {
            countDamage(loaded.damage);
            return;
        }
        const std::size_t stride = std::max<std::size_t>(1, pairs_.size() / frames_checked);
        if (report_.frames % stride == 0) {
            registration_.add(loaded.color, loaded.depth);
            lens_.add(loaded.color);
        }
        lag_.add(pair.color.stamp_s, loaded.color, loaded.depth);
        depth_histogram_.add(loaded.depth);
        converted_ += loaded.converted;
        const auto frame = makeRgbdObservation(setup_, pair.color.stamp_s);
        setColor(*frame, loaded.color);
        setDepth(*frame, loaded.depth);
        if (!loaded.mask.empty()) setMask(*frame, loaded.mask);
        masked_ += !loaded.mask.empty();
        writeLabels(pair, loaded, writer);
        writer.writeFrame(*frame, loaded.color_file);
        const double stamp_s = pair.color.stamp_s;
        if (report_.frames++ == 0) {
            report_.first_stamp_s = stamp_s;
        } else {
            report_.longest_gap_s = std::max(report_.longest_gap_s, stamp_s - report_.last_stamp_s);
        }
        report_.last_stamp_s = stamp_s;
    }

    void writeLabels(const FramePair& pair, const LoadedFrame& loaded, RawlogWriter& writer) {
        if (loaded.labels.empty()) return;
        for (const auto& image :
             makeLabelObservations(rgbd_label, pair.color.stamp_s, loaded.labels)) {
            writer.write(*image);
        }
        ++labeled_;
    }

    void countDamage(const std::string& damage) {
        if (!options_.skip_damaged) {
            throw Error("image " + damage,
                        "fetch the sequence again, or leave such frames out with --skip-damaged");
        }
        sayDetail("left out: " + damage);
        ++report_.damaged;
    }

    void judgeCalibration() {
        const std::string name = "the calibration '" + setup_.name + "'";
        for (const std::string& doubt : doubtsOf(setup_.camera)) {
            report_.warnings.push_back(name + ": " + doubt);
        }
    }

    /** A lag looks like a shift where the camera turns steadily, and the other way round. */
    void judgeRegistration() {
        report_.misregistration = registration_.finding();
        report_.depth_lag = lag_.finding();
        if (report_.misregistration && report_.depth_lag) {
            if (report_.misregistration->agreement > report_.depth_lag->agreement) {
                report_.depth_lag.reset();
            } else {
                report_.misregistration.reset();
            }
        }
        if (report_.misregistration) {
            report_.warnings.push_back(registrationText(*report_.misregistration, setup_.camera.fx,
                                                        options_.depth_camera.has_value()));
        } else if (report_.depth_lag) {
            report_.warnings.push_back(lagText(*report_.depth_lag, options_.depth_offset_s));
        }
    }

    void judgeLens() {
        report_.lens_distortion = lens_.finding();
        if (!report_.lens_distortion) return;
        report_.warnings.push_back(toText(*report_.lens_distortion) +
                                   "; give the lens of this camera as 'dist' in camera.ini, from a "
                                   "calibration with focal length and lens together");
    }

    void judgeDepthUnit() {
        report_.depth_summary = summarize(depth_histogram_, setup_.depthUnitInMetres());
        const double units = 1 / setup_.depthUnitInMetres();
        const std::string doubt =
            doubtOfUnits(depth_histogram_, units, setup_.depth_units_assumed, unitsFile());
        if (!doubt.empty()) report_.warnings.push_back(doubt);
        if (setup_.depth_units_assumed && doubt.empty()) {
            report_.notes.push_back("depth_units: nothing states it, " + shortest(units) +
                                    " assumed");
        }
    }

    /** Where the depth images' unit may stand: depth that another camera took has that one's. */
    std::string unitsFile() const {
        return options_.depth_camera ? fs::path(options_.depth_camera->name).filename().string()
                                     : "camera.ini";
    }

    /** Far depth is no fault of the recording, and rgbd-slam adapts to it. */
    void noteFarDepth() {
        const auto depth_max_m = betterMaxDepth(report_.depth_summary);
        if (!depth_max_m || isImplausible(report_.depth_summary)) return;
        report_.notes.push_back(depthMaxText(report_.depth_summary, *depth_max_m));
    }

    const RgbdSequence& sequence_;
    const ImportOptions& options_;
    std::size_t converted_ = 0, masked_ = 0, labeled_ = 0;
    ImportReport report_;
    std::vector<FramePair> pairs_;
    FrameSource source_;
    const CameraSetup& setup_;
    RegistrationCheck registration_;
    LagCheck lag_;
    LensCheck lens_;
    DepthHistogram depth_histogram_;
    SensorFeed sensors_;
};

}  // namespace

std::string toText(const ImportReport& report) {
    const double span = report.last_stamp_s - report.first_stamp_s;
    char line[256];
    std::snprintf(line, sizeof(line), "%zu frames over %.2f s, %.1f per second, longest gap %.2f s",
                  report.frames, span, span > 0 ? (report.frames - 1) / span : 0.0,
                  report.longest_gap_s);
    std::string text;
    for (const std::string& note : report.notes) text += note + "\n";
    text += line;
    if (report.damaged > 0) text += "; " + std::to_string(report.damaged) + " left out as damaged";
    text += "\ndepth: " + toText(report.depth_summary);
    text += "\n" + tallyText("color", "depth", report.color) +
            tallyText("depth", "color", report.depth);
    std::snprintf(line, sizeof(line),
                  "%zu IMU readings, %zu odometry readings, %zu of other sensors, "
                  "%zu ground truth poses\nimported in %.1f s, %.0f frames/s\n",
                  report.imu, report.odometry, report.others, report.truth, report.seconds,
                  report.frames / std::max(1e-3, report.seconds));
    return text + line;
}

ImportReport importSequence(const RgbdSequence& sequence, const CameraSetup& setup,
                            const std::string& rawlog_path, const ImportOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    Import import(sequence, setup, options);
    writeRawlog(rawlog_path, options.storage, [&](RawlogWriter& writer) { import.write(writer); });
    ImportReport report = import.report();
    for (const std::string& hint : sensorHints(sequence)) report.warnings.push_back(hint);
    for (const std::string& warning : report.warnings) sayWarning(warning);
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace rgbd_graphslam
