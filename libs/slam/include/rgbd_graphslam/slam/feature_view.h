/** What became of features, for those who look on. */
#pragma once
#include <Eigen/Core>

namespace rgbd_graphslam {

/** Tracked: a keypoint that shows a landmark; new: one that shows none; lost: where a landmark of
 *  the frame before should be and was not found. */
struct FeatureView {
    enum class State { Tracked, New, Lost };
    Eigen::Vector2d pixel;  // rectified
    State state = State::New;
    int camera = 0;  // of the rig
};

}  // namespace rgbd_graphslam
