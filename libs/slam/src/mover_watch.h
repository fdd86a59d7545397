/** Keeps moving objects out of tracking and of the map. */
#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/geometry/moving_blocks.h"
#include "rgbd_graphslam/geometry/pixel_blocks.h"
#include "rgbd_graphslam/slam/slam_map.h"

namespace rgbd_graphslam {

/** Remembers small depth images of tracked frames, two per second, and compares every other frame
 *  with those of the same place; the frame between takes over the mask. Keypoints on moving objects
 * are removed from a frame before anything else uses it: they match nothing, create no landmark and
 * provide no depth. Looks at the first camera's image only. */
class MoverWatch {
  public:
    explicit MoverWatch(const RigCameras& cameras);

    /** To be called for every tracked frame.
     *  \param T_cam_world of the frame, which must have its view
     *  \param submap that the pose is in
     *  \return one flag per keypoint: whether it moves; empty when none does */
    std::vector<char> moving(const Frame& frame, const SE3& T_cam_world, int submap,
                             const SlamMap& map);

    /** Remembers the frame, if the last one is old enough.
     *  \param reference keyframe that the pose is tied to */
    void note(const Frame& frame, const SE3& T_cam_world, int reference, const SlamMap& map);

    void save(ByteWriter& out) const;
    /** \param keyframes in the map \throws DamagedBytes */
    void load(ByteReader& in, std::size_t keyframes);

  private:
    /** Moves with its keyframe, as everything in the map does. */
    struct Remembered {
        Sight sight;  // depth in whole millimeters; the pose is set when it is compared
        int reference = 0;
        SE3 T_cam_reference;
    };

    std::vector<const Sight*> sightsIn(int submap, const SlamMap& map);
    void look(const Frame& frame, const SE3& T_cam_world, int submap, const SlamMap& map);
    bool isMasked(const Keypoint& keypoint) const;

    const RigCameras& cameras_;
    PixelBlocks pixels_;
    MovingBlocks blocks_;
    std::deque<Remembered> remembered_;
    // Of the last frame that was compared; no mask when nothing moved.
    std::vector<std::uint8_t> mask_;
    std::vector<float> depth_m_;
    bool compared_last_ = false;
};

/** Removes keypoints from a frame and from the list of its landmarks.
 *  \param removed one flag per keypoint */
void removeKeypoints(const std::vector<char>& removed, const RigCameras& cameras, Frame& frame,
                     std::vector<int>& landmarks);

}  // namespace rgbd_graphslam
