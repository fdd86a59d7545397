#include "rgbd_graphslam/geometry/rig.h"

namespace rgbd_graphslam {
namespace {

bool coincide(const SE3& a, const SE3& b) {
    constexpr double least_apart_m = 1e-4, least_apart_rad = 1e-4;
    const SE3 T = a.inverse() * b;
    return T.t.norm() < least_apart_m && T.angle() < least_apart_rad;
}

}  // namespace

Rig rigOf(const CameraModel& camera) {
    return {{{"", camera, {}, 0}}};
}

std::optional<int> Rig::find(const std::string& label) const {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        if (cameras[i].label == label) return static_cast<int>(i);
    }
    return std::nullopt;
}

std::optional<std::pair<std::string, std::string>> Rig::coincident() const {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (coincide(cameras[i].T_body_cam, cameras[j].T_body_cam)) {
                return std::make_pair(cameras[j].label, cameras[i].label);
            }
        }
    }
    return std::nullopt;
}

}  // namespace rgbd_graphslam
