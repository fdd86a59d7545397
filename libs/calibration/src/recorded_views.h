/** The board in a recording. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rgbd_graphslam/calibration/board.h"
#include "rgbd_graphslam/calibration/depth_calibration.h"
#include "rgbd_graphslam/dataset/camera_file.h"

namespace rgbd_graphslam {

/** A frame that shows the board. */
struct RecordedView {
    double stamp_s = 0, depth_stamp_s = 0;
    BoardView board;
    cv::Mat depth;  // as the sensor gave it, CV_16UC1
};

/** All frames that show the board, and what the recording says of its camera. */
struct RecordedViews {
    std::vector<RecordedView> views;
    std::size_t frames = 0;
    CameraSetup setup;
    DepthCameraOptions depth;
};

/** \param sensor_label empty: the first RGB-D camera
 *  \throws Error where the rawlog is damaged or has no frame of the camera */
RecordedViews readViews(const std::string& rawlog, const std::string& sensor_label,
                        const BoardDetector& detector);

}  // namespace rgbd_graphslam
