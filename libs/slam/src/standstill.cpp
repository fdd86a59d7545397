#include "standstill.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr std::size_t fewest_per_quarter = 12;
constexpr int quarters_at_rest = 3;
/** For ever so many landmarks, and what noise adds to the median of one. */
constexpr double largest_median_px = 0.1, noise_px = 0.6;

/** How far landmarks are from where the keyframe saw them, px. */
struct Quarter {
    std::vector<float> du, dv;

    bool rests() {
        if (du.size() < fewest_per_quarter) return false;
        const double most = largest_median_px + noise_px / std::sqrt(du.size());
        return std::abs(median(du)) < most && std::abs(median(dv)) < most;
    }
    static float median(std::vector<float>& values) {
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }
};

}  // namespace

bool standsAt(const Keyframe& keyframe, const Frame& frame, const std::vector<int>& landmarks,
              const SlamMap& map, const RigCameras& cameras) {
    std::array<Quarter, 4> quarters;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        if (landmarks[i] == no_landmark) continue;
        const int seen_as = map.keypointOf(landmarks[i], keyframe.id);
        if (seen_as < 0) continue;
        const Keypoint& now = frame.keypoints[i];
        const Keypoint& then = keyframe.frame.keypoints[seen_as];
        if (now.camera != then.camera) continue;
        const CameraModel& camera = cameras[now.camera].camera();
        const int column = 2 * then.u > static_cast<float>(camera.width);
        const int row = 2 * then.v > static_cast<float>(camera.height);
        quarters[2 * row + column].du.push_back(now.u - then.u);
        quarters[2 * row + column].dv.push_back(now.v - then.v);
    }
    return std::count_if(quarters.begin(), quarters.end(), [](Quarter& q) { return q.rests(); }) >=
           quarters_at_rest;
}

}  // namespace rgbd_graphslam
