/** Intrinsics from views of a board. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/calibration/board.h"
#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A corner whose projection misses what was seen. */
struct CornerResidual {
    Eigen::Vector2d pixel, residual_px;  // seen; seen minus projected
};

/** A camera and where the board was in each view. */
struct CameraCalibration {
    Intrinsics camera;
    std::vector<SE3> T_cam_board;  // one per view; the board's z points away from the camera
    std::vector<CornerResidual> residuals;
    double rms_px = 0;
    /** Standard deviations of fx, fy, cx, cy (px) from the residuals; zero of a given camera. */
    Eigen::Vector4d sigma = Eigen::Vector4d::Zero();
};

/** The camera that projects the corners of all views to where they were seen, by least squares:
 *  Zhang's "A flexible new technique for camera calibration" (PAMI 2000) as OpenCV has it.
 *  \param lens "none", "plumb_bob", "rational" or "kannala_brandt"
 *  \param width, height of the images, px
 *  \throws Error with fewer than three views, or views that do not determine the camera */
CameraCalibration calibrateCamera(const std::vector<BoardView>& views, int width, int height,
                                  const std::string& lens);

/** Poses and residuals of views with a given camera. \throws Error where a view has no pose */
CameraCalibration evaluateCamera(const std::vector<BoardView>& views, const Intrinsics& camera);

/** How far (px) two cameras place the same ray apart, once turned against each other so that they
 *  agree best: root mean square and largest over the image, and at the image's border alone. */
struct CameraDifference {
    double rms_px = 0, largest_px = 0;
};
CameraDifference difference(const Intrinsics& a, const Intrinsics& b);

}  // namespace rgbd_graphslam
