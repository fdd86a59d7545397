/** What moves, from free space that it violates. */
#pragma once
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/depth_noise.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** A small depth image (PixelBlocks) and where it was taken. */
struct Sight {
    double stamp_s = 0;
    SE3 T_world_cam;
    std::vector<float> depth_m;  // row by row; 0 = none
    /** Number of the recording: what an earlier one looked through may have been put there since.
     */
    int session = 0;
};

/** Compares small depth images of one camera. A block is seen through by another sight that reads
 *  farther where the block's surface would be, by more than noise, poses and the surface's slant
 *  explain; such votes and those that find it in place decide whether it moves. Seeds are grown
 * over connected depth, but not into surfaces that were found in place before or after. The
 * residual of Palazzolo et al., "ReFusion: 3D reconstruction in dynamic environments for RGB-D
 * cameras exploiting residuals", IROS 2019, with images instead of a volume to compare with. */
class MovingBlocks {
  public:
    struct Rules {
        int least_through = 2;       // sights that must see through a block
        double through_share = 0.3;  // of all that see the place
        int least_in_place = 2;      // sights apart in time that make a surface a fixed one
        double apart_s = 1;          // what passes by is in place for less
        double margin_m = 0.05;      // of poses and calibration
        double margin_sigmas = 3;    // of both readings
    };

    MovingBlocks(const Camera& small, const Rules& rules, const DepthNoise& noise = {});

    /** \return a mask of the sight's blocks: 1 = moves */
    std::vector<std::uint8_t> find(const Sight& sight,
                                   const std::vector<const Sight*>& others) const;

    /** Those whose images overlap with a sight's, at most so many, evenly over time. */
    std::vector<const Sight*> overlapping(const Sight& sight, const std::vector<const Sight*>& all,
                                          std::size_t most) const;

    const Camera& camera() const { return small_; }
    /** By how much depths at z may differ on one connected surface, from block to block, m. */
    float step(float z) const;

  private:
    struct Votes {
        std::uint16_t through = 0, in_place = 0, in_place_apart = 0;
    };
    enum class Found { Nothing, InPlace, Through };

    void vote(const Sight& sight, const Sight& other, std::vector<Votes>& votes) const;
    Found compare(const std::vector<float>& depth, int u, int v, float z) const;
    std::vector<std::uint8_t> seeds(const std::vector<Votes>& votes) const;
    void grow(const std::vector<float>& depth, const std::vector<Votes>& votes,
              std::vector<std::uint8_t>& mask) const;
    bool isFixed(const Votes& votes) const;
    /** Share of a few blocks of the sight that the other has in its image. */
    double overlap(const Sight& sight, const Sight& other) const;

    Camera small_;
    Rules rules_;
    DepthNoise noise_;
    std::vector<Eigen::Vector3f> rays_;  // of each block, z = 1
};

}  // namespace rgbd_graphslam
