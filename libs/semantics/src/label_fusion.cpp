#include "rgbd_graphslam/semantics/label_fusion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

constexpr int columns = 320, sights_per_row = 80, outline_px = 2;

/** The labels without the pixels near those of other classes. */
cv::Mat1w withoutOutlines(const cv::Mat& labels) {
    const cv::Mat around =
        cv::getStructuringElement(cv::MORPH_RECT, {2 * outline_px + 1, 2 * outline_px + 1});
    cv::Mat lowest, highest;
    cv::erode(labels, lowest, around);
    cv::dilate(labels, highest, around);
    cv::Mat1w inner = labels.clone();
    inner.setTo(0, lowest != highest);
    return inner;
}

VoxelIndex voxelAt(const Eigen::Vector3d& p, double voxel_m) {
    const auto index = [&](double x) { return static_cast<int>(std::floor(x / voxel_m)); };
    return {index(p.x()), index(p.y()), index(p.z())};
}

}  // namespace

std::vector<LabelSight> LabelFusion::insert(const SE3& T_world_cam, const DepthView& view,
                                            const cv::Mat& labels) {
    std::vector<LabelSight> sights;
    const cv::Mat1w inner = withoutOutlines(labels);
    frame_.clear();
    // A pixel of 320 columns covers a centimeter at 3 m: more would say the same again.
    const int step_px = std::max(1, inner.cols / columns);
    const int sight_step_px = step_px * (columns / sights_per_row);
    for (int v = 0; v < inner.rows; v += step_px) {
        for (int u = 0; u < inner.cols; u += step_px) {
            const float z = view.depth(v, u);
            if (inner(v, u) == 0 || z <= 0 || z > view.max_range_m) continue;
            const Eigen::Vector2f& ray = view.rays.row(v)[u];
            const Eigen::Vector3d p = T_world_cam * Eigen::Vector3d(ray.x() * z, ray.y() * z, z);
            const VoxelIndex at = voxelAt(p, voxel_m_);
            LabeledVoxel& voxel = voxels_[voxelKey(at)];
            voxel.offset += (p / voxel_m_ - Eigen::Vector3d(at.x, at.y, at.z)).cast<float>();
            ++voxel.readings;
            frame_[voxelKey(at)].add(inner(v, u));
            if (u % sight_step_px == 0 && v % sight_step_px == 0) {
                sights.push_back(
                    {voxelKey(at), static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v)});
            }
        }
    }
    for (const auto& [key, seen] : frame_.entries()) {
        LabeledVoxel& voxel = voxels_[key];
        const auto all = static_cast<float>(seen.readings[0] + seen.readings[1]);
        for (std::size_t i = 0; i < 2; ++i) {
            if (seen.readings[i] > 0)
                voxel.vote.add(seen.labels[i], static_cast<float>(seen.readings[i]) / all);
        }
        ++voxel.views;
    }
    return sights;
}

void LabelFusion::FrameVoxel::add(int label) {
    const std::size_t place = readings[0] == 0 || labels[0] == label ? 0 : 1;
    if (place == 1 && readings[1] > 0 && labels[1] != label) return;
    labels[place] = static_cast<std::uint16_t>(label);
    ++readings[place];
}

Eigen::Vector3f LabelFusion::position(const VoxelTable<LabeledVoxel>::Entry& entry) const {
    const VoxelIndex v = voxelOfKey(entry.key);
    const Eigen::Vector3f mean = entry.cell.offset / static_cast<float>(entry.cell.readings);
    return static_cast<float>(voxel_m_) * (Eigen::Vector3f(v.x, v.y, v.z) + mean);
}

}  // namespace rgbd_graphslam
