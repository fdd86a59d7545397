/** Cameras on one body. */
#include "rgbd_graphslam/geometry/rig.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

SE3 at(double x_m) {
    return {Eigen::Matrix3d::Identity(), {x_m, 0, 0}};
}

TEST(Rig, camerasAreFoundByTheirSensorsLabel) {
    const Rig rig{{{"FRONT", {}, at(0)}, {"REAR", {}, at(-0.2)}}};
    EXPECT_EQ(rig.find("REAR"), 1);
    EXPECT_FALSE(rig.find("LEFT"));
}

TEST(Rig, camerasInOnePlaceAreAMistake) {
    Rig rig{{{"FRONT", {}, at(0.1)}, {"REAR", {}, at(-0.2)}, {"LEFT", {}, at(0.1)}}};
    const auto same = rig.coincident();
    ASSERT_TRUE(same);
    EXPECT_EQ(same->first + same->second, "FRONTLEFT");
    rig.cameras[2].T_body_cam.R = rotationExp({0, 0.1, 0});
    EXPECT_FALSE(rig.coincident());
}

}  // namespace
}  // namespace rgbd_graphslam
