#include "rgbd_graphslam/features/frame.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {
constexpr int cell_px = 16;
}

KeypointGrid::KeypointGrid(const std::vector<Keypoint>& keypoints, int width, int height,
                           int cameras)
    : columns_((width + cell_px - 1) / cell_px), rows_((height + cell_px - 1) / cell_px) {
    std::vector<int> cell_of(keypoints.size());
    first_.assign(columns_ * rows_ * cameras + 1, 0);
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
        const Keypoint& k = keypoints[i];
        cell_of[i] = (k.camera * rows_ + clampedRow(k.v)) * columns_ + clampedColumn(k.u);
        ++first_[cell_of[i] + 1];
    }
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    indices_.resize(keypoints.size());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < keypoints.size(); ++i)
        indices_[next[cell_of[i]]++] = static_cast<int>(i);
}

int KeypointGrid::clampedColumn(float u) const {
    return std::clamp(static_cast<int>(u) / cell_px, 0, columns_ - 1);
}

int KeypointGrid::clampedRow(float v) const {
    return std::clamp(static_cast<int>(v) / cell_px, 0, rows_ - 1);
}

void append(Frame seen, int camera, Frame& frame) {
    for (Keypoint& keypoint : seen.keypoints) {
        keypoint.camera = camera;
        frame.keypoints.push_back(keypoint);
    }
    frame.descriptors.insert(frame.descriptors.end(), seen.descriptors.begin(),
                             seen.descriptors.end());
    frame.patches.insert(frame.patches.end(), seen.patches.begin(), seen.patches.end());
}

}  // namespace rgbd_graphslam
