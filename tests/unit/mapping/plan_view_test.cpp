#include "rgbd_graphslam/mapping/plan_view.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace rgbd_graphslam {
namespace {

/** A straight walk of 4 m in 4 s, without the poses between the first and the last second. */
MapInputs walkWithAHole() {
    MapInputs inputs;
    for (int i = 0; i <= 40; ++i) {
        if (i > 10 && i < 30) continue;
        inputs.trajectory.push_back({0.1 * i, SE3(Eigen::Matrix3d::Identity(), {0.1 * i, 0, 1})});
    }
    return inputs;
}

/** Whether the path's orange is in a column at a share of the picture's width. */
bool pathAt(const cv::Mat3b& picture, double share) {
    for (int v = 0; v < picture.rows; ++v) {
        const cv::Vec3b& bgr = picture(v, static_cast<int>(share * picture.cols));
        if (bgr[2] > 200 && bgr[0] < 60) return true;
    }
    return false;
}

TEST(PlanView, drawsNoPathAcrossLostFrames) {
    MapInputs inputs = walkWithAHole();
    const cv::Mat3b joined = planView(inputs, {}, 400);
    EXPECT_TRUE(pathAt(joined, 0.5));
    inputs.unplaced_s = {1.5, 2, 2.5};
    const cv::Mat3b parts = planView(inputs, {}, 400);
    EXPECT_TRUE(pathAt(parts, 0.2));
    EXPECT_FALSE(pathAt(parts, 0.5));
    EXPECT_TRUE(pathAt(parts, 0.8));
}

TEST(PlanView, showsWhatIsHighWhereUpIsAGuess) {
    MapInputs inputs = walkWithAHole();
    const cv::Vec3b green(20, 250, 30);
    PointMap points;
    for (int i = 0; i <= 40; ++i) points.push_back({{0.1f * i, 1, 5}, {30, 250, 20}});
    const auto shown = [&] {
        const cv::Mat3b picture = planView(inputs, points, 400);
        cv::Mat1b close;
        cv::inRange(picture, green - cv::Vec3b(20, 100, 30), green + cv::Vec3b(5, 5, 5), close);
        return cv::countNonZero(close);
    };
    EXPECT_EQ(shown(), 0);
    inputs.up_is_guessed = true;
    EXPECT_GT(shown(), 40);
}

}  // namespace
}  // namespace rgbd_graphslam
