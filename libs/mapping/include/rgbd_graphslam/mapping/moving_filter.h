/** Takes what moves out of keyframes before they are mapped. */
#pragma once
#include <vector>

#include "rgbd_graphslam/geometry/moving_blocks.h"
#include "rgbd_graphslam/geometry/pixel_blocks.h"
#include "rgbd_graphslam/mapping/map_inputs.h"

namespace rgbd_graphslam {

/** Compares a keyframe with sights from all of the recording, not with keyframes alone: whoever
 *  walked through the view is in few of them and is seen through by many. */
class MovingFilter {
  public:
    /** \param camera of all sights and keyframes */
    explicit MovingFilter(const Camera& camera);

    /** One more sight to compare with; an image of another size is none. */
    void add(const RgbdImage& image, double stamp_s, const SE3& T_world_cam, int session);

    /** The image without the readings of what moves. Its other pixels are shared. */
    RgbdImage withoutMovers(const RgbdImage& image, double stamp_s, const SE3& T_world_cam,
                            int session) const;

    std::size_t sights() const { return sights_.size(); }

  private:
    bool fits(const RgbdImage& image) const;

    PixelBlocks blocks_;
    MovingBlocks moving_;
    std::vector<int> block_of_pixel_;  // -1 = none
    std::vector<Sight> sights_;
};

/** The frames that serve as sights: ten a second, fewer where the recording is long. Where frames
 *  have no poses, the keyframes alone. */
Trajectory sightsOf(const MapInputs& inputs);

}  // namespace rgbd_graphslam
