#include "rgbd_graphslam/slam/triangulation.h"

#include <gtest/gtest.h>

#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

const SE3 T_a_world;
const SE3 T_b_world(rotationExp({0, 0.05, 0}), {-0.2, 0, 0});

TEST(Triangulate, findsThePointThatBothSee) {
    const Camera camera;
    const Eigen::Vector3d point(0.3, -0.2, 2.5);
    const auto found =
        triangulate(camera, camera, T_a_world, T_b_world, camera.project(T_a_world * point),
                    camera.project(T_b_world * point));
    ASSERT_TRUE(found);
    EXPECT_LT((*found - point).norm(), 1e-9);
}

TEST(Triangulate, refusesParallelRaysAndPointsBehind) {
    const Camera camera;
    EXPECT_FALSE(triangulate(camera, camera, T_a_world, T_b_world, {320, 240}, {346.2, 240}))
        << "a point at infinity";
    EXPECT_FALSE(triangulate(camera, camera, T_a_world, T_b_world, {320, 240}, {500, 240}))
        << "rays that part in front of the cameras";
}

TEST(TriangulateBetween, placesKeypointsWithoutDepth) {
    SyntheticWorld world(24000);
    const Camera camera;
    SlamOptions options;
    SlamMap map(options.features.scale_factor, options.features.levels);
    std::vector<Frame> with_depth;
    for (const SE3& T_cam_world : {T_a_world, T_b_world}) {
        Frame frame = world.view(T_cam_world.inverse(), 0, camera, 0.1);
        with_depth.push_back(frame);
        for (Keypoint& k : frame.keypoints) k.depth_m = 0;
        map.addKeyframe(std::move(frame), T_cam_world);
    }
    const auto points = triangulateBetween(RigCameras(camera), map, options, 0, 1);
    ASSERT_GT(points.size(), 100u);
    int near_truth = 0;
    for (const TriangulatedPoint& p : points) {
        const Keypoint& k = with_depth[0].keypoints[p.keypoint_a];
        const double truth_z = k.depth_m, z = (T_a_world * p.position).z();
        near_truth += std::abs(z - truth_z) < 0.1 * truth_z;
    }
    EXPECT_GT(near_truth, 0.95 * points.size());
}

}  // namespace
}  // namespace rgbd_graphslam
