#include "rgbd_graphslam/dataset/stereo_rectifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double exactly = 1e-6;
/** Of the image that both cameras must show. */
constexpr double least_common_share = 0.2;

bool isRectified(const Intrinsics& left, const Intrinsics& right, const SE3& T_left_right) {
    const Eigen::Vector3d& t = T_left_right.t;
    const bool same = left == right && !left.hasDistortion() && left.fx == left.fy;
    return same && t.x() > 0 && std::hypot(t.y(), t.z()) < exactly * t.x() &&
           T_left_right.angle() < exactly;
}

/** Axes of the rectified cameras in the left camera's optical frame, in columns. */
Eigen::Matrix3d rectifiedAxes(const SE3& T_left_right) {
    const Eigen::Vector3d x = T_left_right.t.normalized();
    const Eigen::Vector3d forward = Eigen::Vector3d::UnitZ() + T_left_right.R.col(2);
    const Eigen::Vector3d z = (forward - x * x.dot(forward)).normalized();
    Eigen::Matrix3d axes;
    axes << x, z.cross(x), z;
    return axes;
}

/** What a camera sees in the middle of its image, on the plane z = 1 of the rectified one. */
Eigen::Vector2d middle(const Intrinsics& camera, const Eigen::Matrix3d& R_rectified_cam) {
    const Eigen::Vector3d p =
        R_rectified_cam *
        CameraModel(camera).unproject(0.5 * (camera.width - 1), 0.5 * (camera.height - 1), 1);
    return p.head<2>() / p.z();
}

Intrinsics canvas(const Intrinsics& left, const Intrinsics& right, const Eigen::Vector2d& middle) {
    Intrinsics camera;
    camera.width = left.width;
    camera.height = left.height;
    camera.fx = camera.fy = 0.25 * (left.fx + left.fy + right.fx + right.fy);
    camera.cx = 0.5 * (camera.width - 1) - camera.fx * middle.x();
    camera.cy = 0.5 * (camera.height - 1) - camera.fy * middle.y();
    return camera;
}

/** \param outside CV_8UC1, 1 where an image has nothing to show
 *  \return a large rectangle where it has everything: the worst side is moved until all are good */
cv::Rect fullRectangle(const cv::Mat1b& outside) {
    cv::Rect r(0, 0, outside.cols, outside.rows);
    while (r.width > 1 && r.height > 1) {
        const cv::Mat view = outside(r);
        const std::array<double, 4> bad = {
            cv::sum(view.col(0))[0] / r.height, cv::sum(view.col(r.width - 1))[0] / r.height,
            cv::sum(view.row(0))[0] / r.width, cv::sum(view.row(r.height - 1))[0] / r.width};
        const auto worst = std::max_element(bad.begin(), bad.end());
        if (*worst == 0) return r;
        const auto side = worst - bad.begin();
        r.x += side == 0;
        r.width -= side < 2;
        r.y += side == 2;
        r.height -= side >= 2;
    }
    return {};
}

}  // namespace

/** One of the two cameras. */
struct StereoRectifier::Side {
    CameraModel camera;
    Eigen::Matrix3d R_cam_rectified;

    /** \param outside is set to 1 where the camera does not see */
    Map mapTo(const CameraModel& rectified, cv::Mat1b& outside) const {
        Map map{cv::Mat1f(outside.size()), cv::Mat1f(outside.size())};
        for (int v = 0; v < outside.rows; ++v) {
            for (int u = 0; u < outside.cols; ++u) {
                const Eigen::Vector3d p = R_cam_rectified * rectified.unproject(u, v, 1);
                const Eigen::Vector2d seen = camera.project(p);
                if (!camera.isValid(p) || !camera.contains(seen)) outside(v, u) = 1;
                map.x.at<float>(v, u) = static_cast<float>(seen.x());
                map.y.at<float>(v, u) = static_cast<float>(seen.y());
            }
        }
        return map;
    }
};

cv::Mat StereoRectifier::Map::apply(const cv::Mat& image) const {
    if (x.empty()) return image;
    cv::Mat rectified;
    cv::remap(image, rectified, x, y, cv::INTER_LINEAR);
    return rectified;
}

StereoRectifier::StereoRectifier(const Intrinsics& left, const Intrinsics& right,
                                 const SE3& T_left_right)
    : camera_(left), baseline_m_(T_left_right.t.norm()) {
    if (isRectified(left, right, T_left_right)) return;
    const Eigen::Vector3d& t = T_left_right.t;
    if (!(t.x() > 0) || !(t.x() > 0.5 * t.norm())) {
        throw Error("the right camera of the stereo pairs is not to the right of the left one",
                    "exchange the two cameras, or correct their calibration");
    }
    T_left_rectified_.R = rectifiedAxes(T_left_right);
    const Side sides[] = {{left, T_left_rectified_.R},
                          {right, T_left_right.R.transpose() * T_left_rectified_.R}};
    camera_ = canvas(left, right,
                     0.5 * (middle(left, sides[0].R_cam_rectified.transpose()) +
                            middle(right, sides[1].R_cam_rectified.transpose())));
    cv::Mat1b outside = cv::Mat1b::zeros(camera_.height, camera_.width);
    left_ = sides[0].mapTo(camera_, outside);
    right_ = sides[1].mapTo(camera_, outside);
    const cv::Rect common = fullRectangle(outside);
    if (common.area() < least_common_share * outside.size().area()) {
        throw Error("the two cameras of the stereo pairs have hardly any view in common",
                    "correct their calibration");
    }
    for (Map* map : {&left_, &right_}) {
        map->x = map->x(common).clone();
        map->y = map->y(common).clone();
    }
    camera_.width = common.width;
    camera_.height = common.height;
    camera_.cx -= common.x;
    camera_.cy -= common.y;
}

}  // namespace rgbd_graphslam
