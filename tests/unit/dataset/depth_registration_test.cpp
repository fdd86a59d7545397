#include "rgbd_graphslam/dataset/depth_registration.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr double unit_m = 0.001;

/** Depth (m) of a wall at z = 2 and a board at z = 1 before it, in the color camera's frame, seen
 *  along a ray from a place in that frame; 0 for nothing. */
double cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    for (const double z : {1.0, 2.0}) {
        const double share = (z - origin.z()) / direction.z();
        const Eigen::Vector3d hit = origin + share * direction;
        const bool on_board = std::abs(hit.x()) < 0.25 && std::abs(hit.y()) < 0.2;
        if (share > 0 && (z > 1.5 || on_board)) return z;
    }
    return 0;
}

/** What a camera at T_color_cam sees of it. */
cv::Mat1w film(const CameraModel& camera, const SE3& T_color_cam) {
    cv::Mat1w depth(camera.height, camera.width, std::uint16_t{0});
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            const Eigen::Vector3d ray = T_color_cam.R * camera.unproject(u, v, 1);
            const double z_color = cast(T_color_cam.t, ray);
            const Eigen::Vector3d hit =
                T_color_cam.t + (z_color - T_color_cam.t.z()) / ray.z() * ray;
            depth(v, u) =
                static_cast<std::uint16_t>(std::lround((T_color_cam.inverse() * hit).z() / unit_m));
        }
    }
    return depth;
}

struct Agreement {
    int same = 0, holes = 0, wrong = 0;
};

Agreement compare(const cv::Mat1w& registered, const cv::Mat1w& truth) {
    Agreement agreement;
    for (int v = 0; v < truth.rows; ++v) {
        for (int u = 0; u < truth.cols; ++u) {
            if (registered(v, u) == 0) {
                ++agreement.holes;
            } else if (std::abs(registered(v, u) - truth(v, u)) <= 2) {
                ++agreement.same;
            } else {
                ++agreement.wrong;
            }
        }
    }
    return agreement;
}

TEST(DepthRegistration, theSameCameraChangesNothing) {
    const Intrinsics camera{160, 120, 130, 130, 79.5, 59.5, {}};
    const cv::Mat1w depth = film(camera, {});
    const cv::Mat registered = DepthRegistration(camera, camera, {}, unit_m)(depth);
    EXPECT_EQ(cv::norm(registered, depth, cv::NORM_INF), 0);
}

TEST(DepthRegistration, depthComesToLieWhereColorSeesIt) {
    const Intrinsics depth_camera{160, 120, 145, 146, 78, 61, {}};
    const Intrinsics color_camera{
        200, 150, 150, 151, 100.5, 73, BrownLens{{0.1, -0.2, 0.001, -0.002, 0.05}}};
    const SE3 T_color_depth(rotationExp({0.01, -0.02, 0.03}), {0.06, 0.01, -0.02});
    const cv::Mat1w registered = DepthRegistration(depth_camera, color_camera, T_color_depth,
                                                   unit_m)(film(depth_camera, T_color_depth));
    ASSERT_EQ(registered.size(), cv::Size(200, 150));
    const Agreement inside = compare(registered(cv::Rect(40, 30, 120, 90)),
                                     film(color_camera, {})(cv::Rect(40, 30, 120, 90)));
    EXPECT_GT(inside.same, 120 * 90 * 93 / 100);
    EXPECT_LT(inside.wrong, 120 * 90 * 2 / 100) << "along the board's outline only";
    EXPECT_GT(inside.holes, 0) << "what the board hid from the depth camera";
}

TEST(DepthRegistration, whatIsBehindTheColorCameraOrTooFarIsLeftOut) {
    const Intrinsics camera{16, 12, 13, 13, 7.5, 5.5, {}};
    const cv::Mat1w depth(12, 16, std::uint16_t{60000});
    EXPECT_EQ(cv::countNonZero(DepthRegistration(
                  camera, camera, {Eigen::Matrix3d::Identity(), {0, 0, -61}}, unit_m)(depth)),
              0);
    EXPECT_EQ(cv::countNonZero(DepthRegistration(
                  camera, camera, {Eigen::Matrix3d::Identity(), {0, 0, 10}}, unit_m)(depth)),
              0);
}

}  // namespace
}  // namespace rgbd_graphslam
