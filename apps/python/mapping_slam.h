/** SLAM and dense maps on images in memory. */
#pragma once
#include <mrpt/maps/COccupancyGridMap2D.h>

#include "rgbd_graphslam/mapping/dense_mapper.h"
#include "rgbd_graphslam/mapping/packed_images.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** VisualSlam that keeps the images of its keyframes, so that maps can be made at any time. Of one
 *  camera; not thread-safe. */
class MappingSlam {
  public:
    /** \throws Error for settings or a calibration that cannot be */
    MappingSlam(const SlamOptions& options, const Intrinsics& camera)
        : camera_(camera), slam_(options, camera_), images_(camera_) {}

    /** Pose of the next frame; closes loops where it becomes a keyframe.
     *  \throws Error for images of another size, or a stamp that is not later than the last one's
     */
    TrackedFrame track(const RgbdImage& image);
    /** Refines the whole map once more. */
    void finish() { slam_.finish(); }

    const VisualSlam& slam() const { return slam_; }
    const CameraModel& camera() const { return camera_; }

    /** From the world of the first keyframe to one with z up and the floor at z = 0.
     *  \throws Error before the first keyframe */
    SE3 T_up_world() const;
    /** Colored points in the upright world. \throws Error before the first keyframe */
    PointMap points(const MapOptions& options) const;
    /** Floor plan in the upright world. \throws Error before the first keyframe */
    mrpt::maps::COccupancyGridMap2D grid(const MapOptions& options) const;

  private:
    /** Those whose place is known and whose images are kept. */
    Trajectory mapped() const;
    DenseMapper denseMaps(const MapOptions& options) const;

    CameraModel camera_;
    VisualSlam slam_;
    PackedImages images_;
};

}  // namespace rgbd_graphslam
