/** Search for the keypoints of a frame that show given points. */
#pragma once
#include <vector>

#include "rgbd_graphslam/features/frame.h"

namespace rgbd_graphslam {

/** Where and among which pyramid levels a point is looked for. */
struct SearchWindow {
    float u = 0, v = 0;  // px
    float radius = 0;    // px
    int octave_min = 0, octave_max = 0;
    int camera = 0;
};

/** Around a pixel, on the levels next to the one expected. */
inline SearchWindow windowAt(int camera, const Eigen::Vector2d& pixel, float radius, int octave) {
    return {static_cast<float>(pixel.x()),
            static_cast<float>(pixel.y()),
            radius,
            octave - 1,
            octave + 1,
            camera};
}

/** Keypoints of a frame claimed by points; the nearer descriptor wins a contested keypoint. */
class MatchTable {
  public:
    /** \param frame must outlive the table */
    explicit MatchTable(const Frame& frame);

    /** Takes a keypoint out of the search. */
    void reserve(int keypoint) { distance_[keypoint] = -1; }

    /** Looks for `point` and claims the best keypoint in the window for it, unless a second one
     *  comes nearly as near (`ratio` of best to second distance on neighboring levels).
     *  \param max_hamming farthest distance accepted
     *  \return whether it has a keypoint now */
    bool search(int point, const Descriptor& descriptor, const SearchWindow& window,
                int max_hamming, float ratio);

    /** Claims so far: (keypoint, point) by rising keypoint. */
    std::vector<std::pair<int, int>> matches() const;

  private:
    const Frame& frame_;
    std::vector<int> point_;     // one per keypoint, -1 = unclaimed
    std::vector<int> distance_;  // of the claim; -1 = reserved
};

/** Pairs (index in a, index in b) of descriptors that are each other's nearest, nearer than `ratio`
 *  times the second nearest. Exhaustive: for frames with no known relative pose. */
std::vector<std::pair<int, int>> matchMutually(const std::vector<Descriptor>& a,
                                               const std::vector<Descriptor>& b, int max_hamming,
                                               float ratio);

}  // namespace rgbd_graphslam
