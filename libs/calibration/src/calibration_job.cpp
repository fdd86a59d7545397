#include "rgbd_graphslam/calibration/calibration_job.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "recorded_views.h"
#include "residual_picture.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t most_views = 80, fewest_views = 8;
/** Mean way of the corners between two views that both count, as a share of the image's width. */
constexpr double least_motion = 0.02;
/** Corners farther off than this many times the median of their view's residual rms: the view is
 *  blurred or wrong. */
constexpr double worst_view = 3;
/** A camera.ini agrees when rays are nowhere farther apart (px) and depth is within this share. */
constexpr double largest_difference_px = 1, largest_depth_error = 0.005;

double motionBetween(const BoardView& a, const BoardView& b) {
    if (a.pixel.size() != b.pixel.size()) return 1e9;
    double sum = 0;
    for (std::size_t i = 0; i < a.pixel.size(); ++i) sum += (a.pixel[i] - b.pixel[i]).norm();
    return sum / static_cast<double>(a.pixel.size());
}

/** Different ones, evenly over the recording. */
std::vector<std::size_t> chosenViews(const RecordedViews& recorded) {
    const double least_px = least_motion * recorded.setup.camera.width;
    std::vector<std::size_t> different;
    for (std::size_t i = 0; i < recorded.views.size(); ++i) {
        const bool is_new =
            different.empty() || motionBetween(recorded.views[different.back()].board,
                                               recorded.views[i].board) > least_px;
        if (is_new) different.push_back(i);
    }
    if (different.size() <= most_views) return different;
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < most_views; ++k) {
        chosen.push_back(different[k * different.size() / most_views]);
    }
    return chosen;
}

std::vector<BoardView> boardsOf(const RecordedViews& recorded,
                                const std::vector<std::size_t>& chosen) {
    std::vector<BoardView> boards;
    for (const std::size_t i : chosen) boards.push_back(recorded.views[i].board);
    return boards;
}

std::vector<double> rmsOfViews(const std::vector<BoardView>& views,
                               const CameraCalibration& calibration) {
    std::vector<double> rms;
    std::size_t next = 0;
    for (const BoardView& view : views) {
        double squares = 0;
        for (std::size_t i = 0; i < view.pixel.size(); ++i) {
            squares += calibration.residuals[next++].residual_px.squaredNorm();
        }
        rms.push_back(std::sqrt(squares / static_cast<double>(view.pixel.size())));
    }
    return rms;
}

/** Twice, the second time without views that fit badly. \param views what is left of them */
CameraCalibration calibrated(std::vector<BoardView>& views, const Intrinsics& size,
                             const std::string& lens) {
    const CameraCalibration first = calibrateCamera(views, size.width, size.height, lens);
    const std::vector<double> rms = rmsOfViews(views, first);
    std::vector<double> sorted = rms;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double worst = worst_view * sorted[sorted.size() / 2];
    std::vector<BoardView> good;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (rms[i] <= worst) good.push_back(views[i]);
    }
    if (good.size() == views.size()) return first;
    views = std::move(good);
    return calibrateCamera(views, size.width, size.height, lens);
}

/** The rectangle of the corners seen, on the board. */
std::vector<Eigen::Vector2d> regionOf(const BoardView& view) {
    Eigen::Vector2d low = view.board_m.front(), high = low;
    for (const Eigen::Vector2d& p : view.board_m) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

std::vector<BoardDepth> depthsOf(const RecordedViews& recorded, const Intrinsics& camera) {
    std::vector<BoardView> boards;
    for (const RecordedView& view : recorded.views) boards.push_back(view.board);
    const CameraCalibration posed = evaluateCamera(boards, camera);
    std::vector<BoardDepth> depths;
    for (std::size_t i = 0; i < boards.size(); ++i) {
        const RecordedView& view = recorded.views[i];
        depths.push_back({view.stamp_s, view.depth_stamp_s, posed.T_cam_board[i],
                          regionOf(view.board), view.depth});
    }
    return depths;
}

void addDepth(const RecordedViews& recorded, CalibrationReport& report) {
    report.depth_registered = recorded.depth.registered;
    try {
        report.depth = calibrateDepth(depthsOf(recorded, report.color.camera), report.color.camera,
                                      recorded.depth);
    } catch (const Error& e) {
        report.notes.push_back(std::string("depth is not calibrated: ") + e.what());
    }
}

CalibrationCheck checked(const std::string& file, const std::vector<BoardView>& views,
                         const CalibrationReport& report, const RecordedViews& recorded) {
    const CameraSetup given = readCameraFile(file);
    const Intrinsics& found = report.color.camera;
    if (given.camera.width != found.width || given.camera.height != found.height) {
        throw Error("'" + file + "' is for " + std::to_string(given.camera.width) + "x" +
                        std::to_string(given.camera.height) + " pixels, the recording has " +
                        std::to_string(found.width) + "x" + std::to_string(found.height),
                    "give the calibration of these images");
    }
    CalibrationCheck check;
    check.rms_px = evaluateCamera(views, given.camera).rms_px;
    check.difference = difference(found, given.camera);
    check.agrees = check.difference.largest_px <= largest_difference_px;
    if (report.depth) {
        const double unit_m = recorded.depth.unit_m * report.depth->scale;
        check.depth_error = given.depthUnitInMetres() / unit_m - 1;
        check.agrees = check.agrees && std::abs(*check.depth_error) <= largest_depth_error;
    }
    return check;
}

void noteCoverage(CalibrationReport& report) {
    constexpr int cells = 4;
    bool seen[cells][cells] = {};
    const Intrinsics& camera = report.color.camera;
    for (const CornerResidual& r : report.color.residuals) {
        const auto cell = [](double x, int size) {
            return std::clamp(static_cast<int>(cells * x / size), 0, cells - 1);
        };
        seen[cell(r.pixel.y(), camera.height)][cell(r.pixel.x(), camera.width)] = true;
    }
    const auto blank = std::count(&seen[0][0], &seen[0][0] + cells * cells, false);
    if (blank == 0) return;
    report.notes.push_back(
        formatted("the board was never in %d of 16 parts of the image, where "
                  "the lens is a guess: see residuals.png",
                  static_cast<int>(blank)));
}

void writeFiles(const CalibrationJob& job, const RecordedViews& recorded,
                const CalibrationReport& report) {
    makeWritableFolder(job.out_folder);
    CameraSetup setup = recorded.setup;
    setup.camera = report.color.camera;
    if (report.depth) setup.depth_scale = report.depth->scale;
    writeTextAtomically(job.out_folder + "/camera.ini", toIniText(setup));
    if (report.depth && !report.depth_registered) {
        CameraSetup depth = setup;
        depth.camera = recorded.depth.camera;
        depth.T_base_sensor = setup.T_base_sensor * T_optical_from_mrpt.inverse() *
                              report.depth->T_color_depth * T_optical_from_mrpt;
        writeTextAtomically(job.out_folder + "/camera_depth.ini", toIniText(depth));
    }
    writeTextAtomically(job.out_folder + "/report.txt", toText(report));
    std::vector<unsigned char> png;
    cv::imencode(".png", residualPicture(report.color), png);
    writeTextAtomically(job.out_folder + "/residuals.png", {png.begin(), png.end()});
}

}  // namespace

CalibrationReport runCalibration(const CalibrationJob& job) {
    const BoardDetector detector(job.board);
    const RecordedViews recorded = readViews(job.rawlog, job.sensor_label, detector);
    const std::vector<std::size_t> chosen = chosenViews(recorded);
    if (chosen.size() < fewest_views) {
        throw Error("the board is seen in " + std::to_string(recorded.views.size()) + " of " +
                        std::to_string(recorded.frames) + " frames, in " +
                        std::to_string(chosen.size()) + " different views",
                    "check the kind and the size of the board; show it near and far, tilted, and "
                    "in every corner of the image");
    }
    std::vector<BoardView> boards = boardsOf(recorded, chosen);
    CalibrationReport report;
    report.frames = recorded.frames;
    report.views = recorded.views.size();
    report.lens = job.lens;
    report.color = calibrated(boards, recorded.setup.camera, job.lens);
    report.views_used = boards.size();
    noteCoverage(report);
    addDepth(recorded, report);
    if (!job.check.empty()) report.check = checked(job.check, boards, report, recorded);
    if (!job.out_folder.empty()) writeFiles(job, recorded, report);
    return report;
}

namespace {

std::string cameraLines(const CalibrationReport& report) {
    const Intrinsics& camera = report.color.camera;
    std::string text = formatted(
        "lens %s: rms %.3f px over %zu corners\n"
        "fx %.3f  fy %.3f  cx %.3f  cy %.3f px\n",
        report.lens.c_str(), report.color.rms_px, report.color.residuals.size(), camera.fx,
        camera.fy, camera.cx, camera.cy);
    if (!report.color.sigma.isZero()) {
        const auto& s = report.color.sigma;
        text += formatted("  standard deviations %.3f %.3f %.3f %.3f px\n", s[0], s[1], s[2], s[3]);
    }
    text += "dist";
    for (const double k : lensCoefficients(camera.lens)) text += formatted(" %.6g", k);
    return text + "\n";
}

std::string depthLines(const DepthCalibration& depth, bool registered) {
    std::string text = formatted(
        "depth: scale %.5f, standard deviation %.5f; %.1f mm rms from the board over %zu readings "
        "of %zu views\n",
        depth.scale, depth.scale_sigma, 1e3 * depth.rms_m, depth.readings, depth.views);
    if (!registered) {
        const Eigen::Vector3d& t = depth.T_color_depth.t;
        text += formatted("depth camera at x %.2f y %.2f z %.2f mm, turned %.3f deg\n", 1e3 * t.x(),
                          1e3 * t.y(), 1e3 * t.z(), depth.T_color_depth.angle() * 180 / M_PI);
    }
    if (depth.delay_s) {
        text += formatted("depth stamps are %.1f ms %s, standard deviation %.1f ms\n",
                          1e3 * std::abs(*depth.delay_s), *depth.delay_s > 0 ? "early" : "late",
                          1e3 * depth.delay_sigma_s);
    }
    for (const DepthErrorBin& bin : depth.errors) {
        text += formatted("  at %.2f m: bias %+.1f mm, standard deviation %.1f mm\n", bin.depth_m,
                          1e3 * bin.bias_m, 1e3 * bin.sigma_m);
    }
    return text;
}

std::string checkLines(const CalibrationCheck& check, double rms_px) {
    std::string text = formatted(
        "given camera: rms %.3f px against %.3f; rays %.2f px apart (rms), at most %.2f px\n",
        check.rms_px, rms_px, check.difference.rms_px, check.difference.largest_px);
    if (check.depth_error) {
        text += formatted("given depth is %.2f %% too %s\n", 100 * std::abs(*check.depth_error),
                          *check.depth_error > 0 ? "long" : "short");
    }
    return text + (check.agrees ? "the given camera agrees with the recording\n"
                                : "the given camera does NOT agree with the recording\n");
}

}  // namespace

std::string toText(const CalibrationReport& report) {
    std::string text = formatted("board seen in %zu of %zu frames, %zu views used\n", report.views,
                                 report.frames, report.views_used);
    text += cameraLines(report);
    if (report.depth) text += depthLines(*report.depth, report.depth_registered);
    for (const std::string& note : report.notes) text += "note: " + note + "\n";
    if (report.check) text += checkLines(*report.check, report.color.rms_px);
    return text;
}

}  // namespace rgbd_graphslam
