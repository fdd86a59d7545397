#include "rgbd_graphslam/viewer/keyframe_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/viewer/point_chunks.h"

namespace rgbd_graphslam {
namespace {

constexpr double nearest_m = 0.3, farthest_point_m = 5;

int stepFor(const cv::Size& size) {
    const auto points = [](const cv::Size& grid) {
        return static_cast<std::size_t>(grid.width + 1) * static_cast<std::size_t>(grid.height + 1);
    };
    int step = 1;
    while (points(size / step) > points_a_keyframe) ++step;
    return step;
}

}  // namespace

Vertices keyframePoints(const cv::Mat& color, const cv::Mat& depth, double depth_unit_m,
                        const Camera& camera) {
    const int step = stepFor(depth.size());
    Vertices points;
    points.reserve(points_a_keyframe);
    for (int v = step / 2; v < depth.rows; v += step) {
        for (int u = step / 2; u < depth.cols; u += step) {
            const double z = depth_unit_m * depth.at<std::uint16_t>(v, u);
            if (z < nearest_m || z > farthest_point_m) continue;
            const auto& bgr = color.at<cv::Vec3b>(v, u);
            points.push_back(
                {camera.unproject(u, v, z).cast<float>(), {bgr[2], bgr[1], bgr[0], 255}});
        }
    }
    shufflePoints(points);
    return points;
}

Vertices transformed(const SE3& T_world_cam, const Vertices& points) {
    const Eigen::Matrix3f R = T_world_cam.R.cast<float>();
    const Eigen::Vector3f t = T_world_cam.t.cast<float>();
    Vertices moved = points;
    for (Vertex& vertex : moved) vertex.position = R * vertex.position + t;
    return moved;
}

cv::Mat3b paintedDepth(const cv::Mat& depth, double depth_unit_m, double farthest_m) {
    cv::Mat scaled, painted;
    depth.convertTo(scaled, CV_8U, -255 * depth_unit_m / farthest_m, 255);
    cv::applyColorMap(scaled, painted, cv::COLORMAP_TURBO);
    painted.setTo(cv::Scalar::all(0), depth == 0);
    return painted;
}

cv::Mat thinned(const cv::Mat& image, int width) {
    const int step = (image.cols + width - 1) / width;
    if (step <= 1) return image;
    cv::Mat small;
    cv::resize(image, small, cv::Size(image.cols / step, image.rows / step), 0, 0,
               cv::INTER_NEAREST);
    return small;
}

}  // namespace rgbd_graphslam
