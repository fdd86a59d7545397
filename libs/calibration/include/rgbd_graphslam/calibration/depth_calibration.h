/** Depth against the plane of a board. */
#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A view of the board with depth. */
struct BoardDepth {
    double stamp_s = 0;        // of the color image
    double depth_stamp_s = 0;  // of the depth image
    SE3 T_cam_board;           // by the color image
    /** Corners of a convex region of the board, on the board, m. */
    std::vector<Eigen::Vector2d> region_m;
    cv::Mat depth;  // CV_16UC1
};

/** Depth errors at one distance. */
struct DepthErrorBin {
    double depth_m = 0, bias_m = 0, sigma_m = 0;
    std::size_t readings = 0;
};

/** What has to be done to depth so that it lies on the boards. */
struct DepthCalibration {
    /** Factor on the depth, and its standard deviation by the scatter of the views. */
    double scale = 1, scale_sigma = 0;
    /** Pose of the depth camera in the color camera's frame; as given where depth is registered. */
    SE3 T_color_depth;
    /** What must be added to depth stamps; nothing where the board hardly moved. */
    std::optional<double> delay_s;
    double delay_sigma_s = 0;
    double rms_m = 0;  // of the distance from the boards' planes
    std::vector<DepthErrorBin> errors;
    std::size_t views = 0, readings = 0;
};

/** How depth was taken. */
struct DepthCameraOptions {
    double unit_m = 0.001;
    Intrinsics camera;  // of the depth images
    SE3 T_color_depth;
    /** Depth is that of the color camera's pixels: its pose is not to be found. */
    bool registered = true;
};

/** Scale, delay and, unless registered, pose of the depth camera, by least squares over the
 *  distances of readings from the plane of the board (Unnikrishnan and Hebert, "Fast extrinsic
 *  calibration of a laser rangefinder to a camera", 2005), weighted by depth noise, without
 *  readings more than three standard deviations off.
 *  \param views in order of time \throws Error where too few readings lie on the board */
DepthCalibration calibrateDepth(const std::vector<BoardDepth>& views, const Intrinsics& color,
                                const DepthCameraOptions& options);

}  // namespace rgbd_graphslam
