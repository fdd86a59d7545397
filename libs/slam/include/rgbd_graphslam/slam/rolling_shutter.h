/** Whether the rows of an image were taken one after the other. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/slam/map_snapshot.h"

namespace rgbd_graphslam {

/** A landmark seen by a keyframe, and what a camera that reads all rows at once would see. */
struct RowObservation {
    int keyframe = 0, landmark = 0;
    /** Of the keypoint, from -0.5 at the image's top to 0.5 at its bottom. */
    double row = 0;
    /** Observed minus projected, px, and its standard deviation. */
    Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();
    double sigma_px = 1;
    /** How fast the projection moves over the image, px/s. */
    Eigen::Vector2d velocity_px_s = Eigen::Vector2d::Zero();
    /** Derivatives of the projection by the camera's pose (left perturbation) and by the landmark.
     */
    Eigen::Matrix<double, 2, 6> by_pose = Eigen::Matrix<double, 2, 6>::Zero();
    Eigen::Matrix<double, 2, 3> by_landmark = Eigen::Matrix<double, 2, 3>::Zero();
};

/** An estimate with its uncertainty. */
struct ReadoutTime {
    /** From the reading of the first row to that of the last, s; negative from bottom to top. */
    double seconds = 0;
    double sigma_s = 0;
    std::size_t observations = 0;
};

/** Least squares for the one unknown that shears images in proportion to their motion: a keypoint
 *  in row y is displaced by readout * y * velocity. The part of that shear which other poses and
 *  landmarks would explain as well is projected out (Frisch and Waugh 1933), so the estimate does
 * not depend on what the bundle adjustment made of it. The deviation is that between stretches of
 *  keyframes, since the errors of one keyframe are not independent.
 *  \param observations by rising keyframe
 *  \return nothing when there are too few of them or the images hardly move */
std::optional<ReadoutTime> estimateReadoutTime(const std::vector<RowObservation>& observations);

/** The same of a finished map. \param frames poses of all frames, in the map's world */
std::optional<ReadoutTime> estimateReadoutTime(const MapSnapshot& map, const Trajectory& frames);

/** Whether an estimate is beyond doubt, long enough to matter and a time that cameras take. */
bool isRollingShutter(const ReadoutTime& readout);

}  // namespace rgbd_graphslam
