#include "residual_picture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {

constexpr double length_px = 12, usual_share = 0.95;

double magnification(const std::vector<CornerResidual>& residuals) {
    std::vector<double> lengths;
    for (const CornerResidual& r : residuals) lengths.push_back(r.residual_px.norm());
    return length_px / std::max(1e-6, percentileOf(std::move(lengths), usual_share));
}

cv::Point2d point(const Eigen::Vector2d& p) {
    return {p.x(), p.y()};
}

}  // namespace

cv::Mat residualPicture(const CameraCalibration& calibration) {
    cv::Mat picture(calibration.camera.height, calibration.camera.width, CV_8UC3,
                    cv::Scalar::all(255));
    if (calibration.residuals.empty()) return picture;
    const double times = magnification(calibration.residuals);
    for (const CornerResidual& r : calibration.residuals) {
        const Eigen::Vector2d line = times * r.residual_px;
        const bool is_long = line.norm() > length_px;
        const cv::Scalar color = is_long ? cv::Scalar(40, 40, 220) : cv::Scalar(160, 90, 20);
        cv::line(picture, point(r.pixel), point(r.pixel + line), color, 1, cv::LINE_AA);
        cv::circle(picture, point(r.pixel), 1, color, cv::FILLED);
    }
    cv::putText(picture,
                formatted("x %.0f, rms %.3f px, %zu corners", times, calibration.rms_px,
                          calibration.residuals.size()),
                {8, picture.rows - 10}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 0}, 1, cv::LINE_AA);
    return picture;
}

}  // namespace rgbd_graphslam
