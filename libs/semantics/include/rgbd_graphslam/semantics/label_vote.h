/** Which class a place most probably has. */
#pragma once
#include <array>
#include <cstdint>

namespace rgbd_graphslam {

/** Votes of images for the best three classes of a place. Images are taken to be right with a fixed
 *  probability and otherwise wrong in no particular way, so that the log-odds of a class are
 *  proportional to its votes: recursive Bayesian updates as in McCormac et al., "SemanticFusion",
 *  2017, at a fixed size. A fourth class takes the place of the weakest and inherits its votes
 *  (Metwally et al., "Efficient computation of frequent and top-k elements in data streams", 2005).
 */
class LabelVote {
  public:
    /** \param label above 0 \param share of the image's readings here that have it, 0 to 1 */
    void add(int label, float share);

    /** 0 before the first vote. */
    int best() const { return labels_[strongest()]; }

    /** Probability of the best class. \param frame_accuracy probability that an image is right
     *  \param classes that there are, at least 2 */
    double confidence(double frame_accuracy, int classes) const;

    /** Sum of all votes: about the number of images that labeled the place. */
    float votes() const { return votes_[0] + votes_[1] + votes_[2]; }

  private:
    std::size_t strongest() const;

    std::array<std::uint16_t, 3> labels_{};
    std::array<float, 3> votes_{};
};

}  // namespace rgbd_graphslam
