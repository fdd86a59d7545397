/** What tracking keeps of an image. */
#pragma once
#include <cstdint>
#include <future>
#include <optional>
#include <vector>

#include "rgbd_graphslam/features/dense_view.h"
#include "rgbd_graphslam/features/descriptor.h"
#include "rgbd_graphslam/features/patch.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A corner with its place, scale, orientation and depth. */
struct Keypoint {
    /** Undistorted pixel of the full-size image, with sub-pixel part. */
    float u = 0, v = 0;
    /** Along the optical axis, m; 0 = none. */
    float depth_m = 0;
    /** Orientation of the patch. */
    float angle_rad = 0;
    /** Pyramid level, 0 = full size. */
    int octave = 0;
    /** Placed by the patch of the landmark that it shows, or itself the place of that patch. */
    bool aligned = false;
};

/** Keypoints sorted into square cells for windowed search. */
class KeypointGrid {
  public:
    KeypointGrid() = default;
    KeypointGrid(const std::vector<Keypoint>& keypoints, int width, int height);

    /** Calls visit(index) for the keypoints of all cells that touch the square of half side
     *  `radius` around (u, v); the caller checks the exact distance. */
    template <class Visit>
    void visit(float u, float v, float radius, Visit&& visit) const {
        const int x0 = clampedColumn(u - radius), x1 = clampedColumn(u + radius);
        const int y0 = clampedRow(v - radius), y1 = clampedRow(v + radius);
        for (int y = y0; y <= y1; ++y) {
            const int end = first_[y * columns_ + x1 + 1];
            for (int i = first_[y * columns_ + x0]; i < end; ++i) visit(indices_[i]);
        }
    }

  private:
    int clampedColumn(float u) const;
    int clampedRow(float v) const;

    int columns_ = 1, rows_ = 1;
    std::vector<int> first_ = {0, 0};  // cell -> position in indices_, one more than cells
    std::vector<int> indices_;
};

/** What other sensors say about the way here, each in a frame of its own that drifts. */
struct DeadReckoning {
    std::optional<SE3> T_odometry_cam;
    std::optional<Eigen::Matrix3d> R_gyroscope_cam;
};

/** Features of one image; position i of every list is keypoint i. */
struct Frame {
    double stamp_s = 0;
    std::vector<Keypoint> keypoints;
    std::vector<Descriptor> descriptors;
    /** Until the frame is tracked; a keyframe's until the next keyframe. */
    std::vector<Patch> patches;
    KeypointGrid grid;
    /** The image as a whole, made when it is first asked for: most frames are tracked without.
     *  Not valid in keyframes. */
    std::shared_future<DenseView> view;
    DeadReckoning reckoning;
};

}  // namespace rgbd_graphslam
