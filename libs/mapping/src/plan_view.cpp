#include "rgbd_graphslam/mapping/plan_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/mapping/framing.h"
#include "rgbd_graphslam/mapping/picture_marks.h"

namespace rgbd_graphslam {
namespace {

constexpr int margin_px = 40;
constexpr double point_radius_m = 0.006, border_share = 0.07;

/** Where meters are in the picture. */
class Paper {
  public:
    Paper(const Eigen::AlignedBox3d& box, int longer_side_px) {
        Eigen::Array2d extent(0.5, 0.5);
        if (!box.isEmpty()) {  // what lies a little outside is to be seen, too
            const Eigen::Array2d border = border_share * box.sizes().head<2>().array();
            extent = extent.max(box.sizes().head<2>().array() + 2 * border);
            left_ = box.min().x() - border.x();
            top_ = box.max().y() + border.y();
        }
        pixels_per_m_ = (longer_side_px - 2 * margin_px) / extent.maxCoeff();
        const Eigen::Array2i size = (extent * pixels_per_m_).ceil().cast<int>() + 2 * margin_px;
        picture =
            cv::Mat3b(size.y(), size.x(),
                      cv::Vec3b(background_color[2], background_color[1], background_color[0]));
    }

    template <class Vector>
    cv::Point at(const Vector& p) const {
        return {margin_px + static_cast<int>(std::lround((p.x() - left_) * pixels_per_m_)),
                margin_px + static_cast<int>(std::lround((top_ - p.y()) * pixels_per_m_))};
    }
    double pixelsPerMetre() const { return pixels_per_m_; }

    cv::Mat3b picture;

  private:
    double left_ = 0, top_ = 0, pixels_per_m_ = 1;
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
        cv::line(picture, at(inputs.keyframes[loop.from]), at(inputs.keyframes[loop.to]),
                 bgrOf(loop_color), 2, cv::LINE_AA);
    }
    for (std::size_t i = 1; i < inputs.trajectory.size(); ++i) {
        const StampedPose &from = inputs.trajectory[i - 1], &to = inputs.trajectory[i];
        if (anyBetween(inputs.unplaced_s, from.stamp_s, to.stamp_s)) continue;
        cv::line(picture, at(from), at(to), bgrOf(trajectory_color), 2, cv::LINE_AA);
    }
    constexpr int dot_px = 3;
    const double least_m = 2 * dot_px / paper_sheet.pixelsPerMetre();
    for (const std::size_t k : sparseKeyframes(inputs.keyframes, least_m))
        cv::circle(picture, at(inputs.keyframes[k]), dot_px, bgrOf(keyframe_color), cv::FILLED,
                   cv::LINE_AA);
}

}  // namespace

cv::Mat3b planView(const MapInputs& inputs, const PointMap& points, int longer_side_px) {
    const double ceiling_m = pictureCeiling(inputs);
    Paper paper_sheet(framingOf(points, inputs.keyframes, inputs.trajectory, ceiling_m).box,
                      longer_side_px);
    drawPoints(paper_sheet, points, static_cast<float>(ceiling_m));
    drawPaths(paper_sheet, inputs);
    drawScaleBar(paper_sheet.picture, 1 / paper_sheet.pixelsPerMetre());
    return paper_sheet.picture;
}

}  // namespace rgbd_graphslam
