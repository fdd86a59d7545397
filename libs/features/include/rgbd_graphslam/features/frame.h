/** What tracking keeps of an image. */
#pragma once
#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "rgbd_graphslam/features/dense_view.h"
#include "rgbd_graphslam/features/descriptor.h"
#include "rgbd_graphslam/features/patch.h"
#include "rgbd_graphslam/geometry/motion_samples.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A corner with its place, scale, orientation and depth. */
struct Keypoint {
    /** Pixel of the full-size image of the rectified camera, with sub-pixel part. */
    float u = 0, v = 0;
    /** Along the optical axis, m; 0 = none. */
    float depth_m = 0;
    /** Orientation of the patch. */
    float angle_rad = 0;
    /** Pyramid level, 0 = full size. */
    int octave = 0;
    /** Placed by the patch of the landmark that it shows, or itself the place of that patch. */
    bool aligned = false;
    /** Of the rig, that saw it. */
    int camera = 0;
};

/** Keypoints sorted into square cells for windowed search, those of each camera by themselves. */
class KeypointGrid {
  public:
    KeypointGrid() = default;
    /** \param width, height of the largest image, px */
    KeypointGrid(const std::vector<Keypoint>& keypoints, int width, int height, int cameras = 1);

    /** Calls visit(index) for the keypoints of all cells that touch the square of half side
     *  `radius` around (u, v); the caller checks the exact distance. */
    template <class Visit>
    void visit(float u, float v, float radius, Visit&& visit, int camera = 0) const {
        const int x0 = clampedColumn(u - radius), x1 = clampedColumn(u + radius);
        const int y0 = clampedRow(v - radius), y1 = clampedRow(v + radius);
        const int above =
            camera * rows_;  // the cells of a camera lie below those of the one before
        for (int y = above + y0; y <= above + y1; ++y) {
            const int end = first_[y * columns_ + x1 + 1];
            for (int i = first_[y * columns_ + x0]; i < end; ++i) visit(indices_[i]);
        }
    }

  private:
    int clampedColumn(float u) const;
    int clampedRow(float v) const;

    int columns_ = 1, rows_ = 1;       // for each camera
    std::vector<int> first_ = {0, 0};  // cell -> position in indices_, one more than cells
    std::vector<int> indices_;
};

/** What other sensors say about the way here, each in a frame of its own that drifts. */
struct DeadReckoning {
    std::optional<SE3> T_odometry_cam;
    std::optional<Eigen::Matrix3d> R_gyroscope_cam;
    /** Standard deviations (m, rad) of T_odometry_cam since the map was seen last, where more than
     *  the wheels tells it. */
    std::optional<Eigen::Vector2d> sigma;
};

/** What other sensors read since the frame before, and up to this frame. */
struct MotionReadings {
    std::vector<ImuSample> imu;
    SE3 T_imu_cam;
    std::vector<WheelSample> wheels;
    SE3 T_base_cam;
};

/** Features of the images that a rig took at one moment; position i of every list is keypoint i. */
struct Frame {
    double stamp_s = 0;
    std::vector<Keypoint> keypoints;
    std::vector<Descriptor> descriptors;
    /** Until the frame is tracked; a keyframe's until the next keyframe. */
    std::vector<Patch> patches;
    KeypointGrid grid;
    /** The first camera's image as a whole, if it took one, made when it is first asked for: most
     * frames are tracked without. Not valid in keyframes. */
    std::shared_future<DenseView> view;
    DeadReckoning reckoning;
    /** Until the frame is tracked. */
    MotionReadings readings;
};

/** Adds what another camera saw at the same moment. \param camera its number, > 0
 *  The grid of `frame` must be made anew. */
void append(Frame seen, int camera, Frame& frame);

}  // namespace rgbd_graphslam
