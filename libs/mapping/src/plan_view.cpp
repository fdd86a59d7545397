#include "rgbd_graphslam/mapping/plan_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace rgbd_graphslam {
namespace {

const cv::Scalar orange(20, 120, 240), blue(200, 90, 30), red(60, 25, 215), dark(60, 60, 60);
const cv::Vec3b paper(243, 239, 236);
constexpr int margin_px = 40;
constexpr double lowest_ceiling_m = 2, point_radius_m = 0.006;
constexpr float outliers = 0.002f;  // share of points that may lie outside the picture on each side

float ceilingOf(const MapInputs& inputs) {
    double ceiling = lowest_ceiling_m;
    for (const auto& pose : inputs.trajectory)
        ceiling = std::max(ceiling, pose.T_world_cam.t.z() + 0.1);
    return static_cast<float>(ceiling);
}

/** Where metres are in the picture. */
class Paper {
  public:
    Paper(const MapInputs& inputs, const PointMap& points, int longer_side_px) {
        std::vector<float> x{0}, y{0};
        for (const MapPoint& point : points) {
            x.push_back(point.position.x());
            y.push_back(point.position.y());
        }
        Eigen::Array2d low(quantile(x, outliers), quantile(y, outliers));
        Eigen::Array2d high(quantile(x, 1 - outliers), quantile(y, 1 - outliers));
        for (const auto& pose : inputs.trajectory) {
            low = low.min(pose.T_world_cam.t.head<2>().array());
            high = high.max(pose.T_world_cam.t.head<2>().array());
        }
        const Eigen::Array2d extent = (high - low).max(0.5);
        pixels_per_m_ = (longer_side_px - 2 * margin_px) / extent.maxCoeff();
        left_ = low.x();
        top_ = high.y();
        const Eigen::Array2i size = (extent * pixels_per_m_).ceil().cast<int>() + 2 * margin_px;
        picture = cv::Mat3b(size.y(), size.x(), paper);
    }

    template <class Vector>
    cv::Point at(const Vector& p) const {
        return {margin_px + static_cast<int>(std::lround((p.x() - left_) * pixels_per_m_)),
                margin_px + static_cast<int>(std::lround((top_ - p.y()) * pixels_per_m_))};
    }
    double pixelsPerMetre() const { return pixels_per_m_; }

    cv::Mat3b picture;

  private:
    static double quantile(std::vector<float>& values, float share) {
        const auto nth = values.begin() +
                         static_cast<std::ptrdiff_t>(share * static_cast<float>(values.size() - 1));
        std::nth_element(values.begin(), nth, values.end());
        return *nth;
    }
    double left_, top_, pixels_per_m_;
};

/** The highest point below the ceiling wins its pixels; lower ones are a little darker. */
void drawPoints(Paper& paper_sheet, const PointMap& points, float ceiling_m) {
    cv::Mat3b& picture = paper_sheet.picture;
    cv::Mat1f height(picture.size(), -std::numeric_limits<float>::infinity());
    const int radius =
        std::max(1, static_cast<int>(std::lround(point_radius_m * paper_sheet.pixelsPerMetre())));
    for (const auto& [p, rgb] : points) {
        if (p.z() > ceiling_m) continue;
        const cv::Point center = paper_sheet.at(p);
        const float shade = 0.75f + 0.25f * std::clamp(p.z() / ceiling_m, 0.f, 1.f);
        const cv::Vec3b bgr(cv::saturate_cast<std::uint8_t>(shade * rgb[2]),
                            cv::saturate_cast<std::uint8_t>(shade * rgb[1]),
                            cv::saturate_cast<std::uint8_t>(shade * rgb[0]));
        for (int v = std::max(center.y - radius, 0);
             v <= std::min(center.y + radius, picture.rows - 1); ++v) {
            for (int u = std::max(center.x - radius, 0);
                 u <= std::min(center.x + radius, picture.cols - 1); ++u) {
                if (p.z() <= height(v, u)) continue;
                height(v, u) = p.z();
                picture(v, u) = bgr;
            }
        }
    }
}

void drawPaths(Paper& paper_sheet, const MapInputs& inputs) {
    cv::Mat& picture = paper_sheet.picture;
    const auto at = [&](const StampedPose& pose) { return paper_sheet.at(pose.T_world_cam.t); };
    for (const auto& loop : inputs.loops) {
        cv::line(picture, at(inputs.keyframes[loop.from]), at(inputs.keyframes[loop.to]), red, 2,
                 cv::LINE_AA);
    }
    for (std::size_t i = 1; i < inputs.trajectory.size(); ++i) {
        const StampedPose &from = inputs.trajectory[i - 1], &to = inputs.trajectory[i];
        if (anyBetween(inputs.unplaced_s, from.stamp_s, to.stamp_s)) continue;
        cv::line(picture, at(from), at(to), orange, 2, cv::LINE_AA);
    }
    for (const auto& keyframe : inputs.keyframes)
        cv::circle(picture, at(keyframe), 3, blue, cv::FILLED, cv::LINE_AA);
}

void drawScale(Paper& paper_sheet) {
    const int bar = static_cast<int>(std::lround(paper_sheet.pixelsPerMetre()));
    const cv::Point left(margin_px / 2, paper_sheet.picture.rows - margin_px / 3);
    cv::line(paper_sheet.picture, left, left + cv::Point(bar, 0), dark, 3);
    cv::putText(paper_sheet.picture, "1 m", left + cv::Point(4, -6), cv::FONT_HERSHEY_SIMPLEX, 0.5,
                dark, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat3b planView(const MapInputs& inputs, const PointMap& points, int longer_side_px) {
    Paper paper_sheet(inputs, points, longer_side_px);
    drawPoints(paper_sheet, points, ceilingOf(inputs));
    drawPaths(paper_sheet, inputs);
    drawScale(paper_sheet);
    return paper_sheet.picture;
}

}  // namespace rgbd_graphslam
