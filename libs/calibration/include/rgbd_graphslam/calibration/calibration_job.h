/** What rgbd-calibrate does: from a recording of a board to camera.ini and a report. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/calibration/board.h"
#include "rgbd_graphslam/calibration/camera_calibration.h"
#include "rgbd_graphslam/calibration/depth_calibration.h"

namespace rgbd_graphslam {

/** A calibration to be made. */
struct CalibrationJob {
    std::string rawlog;
    /** Empty: the first RGB-D camera. */
    std::string sensor_label;
    BoardOptions board;
    /** See calibrateCamera(). */
    std::string lens = "plumb_bob";
    /** Folder for camera.ini, residuals.png and report.txt; empty: none. */
    std::string out_folder;
    /** A camera.ini to be compared with the recording; empty: none. */
    std::string check;
};

/** How a given camera.ini fits the recording. */
struct CalibrationCheck {
    double rms_px = 0;  // with the given intrinsics
    CameraDifference difference;
    std::optional<double> depth_error;  // share by which its depth is too long
    bool agrees = false;
};

/** What was found. */
struct CalibrationReport {
    std::size_t frames = 0, views = 0, views_used = 0;
    std::string lens;
    CameraCalibration color;
    std::optional<DepthCalibration> depth;
    bool depth_registered = true;
    /** Why there is no depth calibration, or what is doubtful. */
    std::vector<std::string> notes;
    std::optional<CalibrationCheck> check;
};

/** \throws Error where the rawlog has no RGB-D frame, the board is hardly seen, or its views do not
 *          determine the camera */
CalibrationReport runCalibration(const CalibrationJob& job);

/** For people, some lines. */
std::string toText(const CalibrationReport& report);

}  // namespace rgbd_graphslam
