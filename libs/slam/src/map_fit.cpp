#include "map_fit.h"

#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::string pyramidText(int levels, double scale_factor) {
    return std::to_string(levels) + " pyramid levels of factor " + std::to_string(scale_factor);
}

/** Keypoints are rectified, so only what is left of a lens then matters. */
bool sameView(const CameraModel& a, const CameraModel& b) {
    return a.rectified().intrinsics() == b.rectified().intrinsics();
}

bool sameMount(const SE3& a, const SE3& b) {
    constexpr double same_m = 1e-4, same_rad = 1e-4;
    const SE3 apart = a.inverse() * b;
    return apart.t.norm() < same_m && apart.angle() < same_rad;
}

bool sameViews(const Rig& a, const Rig& b) {
    const SE3 T_a = a.cameras[0].T_body_cam.inverse(), T_b = b.cameras[0].T_body_cam.inverse();
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        const RigCamera &in_a = a.cameras[i], &in_b = b.cameras[i];
        if (!sameView(in_a.model, in_b.model)) return false;
        if (i > 0 && !sameMount(T_a * in_a.T_body_cam, T_b * in_b.T_body_cam)) return false;
    }
    return true;
}

std::string countText(const Rig& rig) {
    const std::size_t cameras = rig.cameras.size();
    return std::to_string(cameras) + (cameras == 1 ? " RGB-D camera" : " RGB-D cameras");
}

}  // namespace

void requireFits(const MapSnapshot& map, const FeatureOptions& features, const Rig& rig,
                 MapUse use) {
    if (map.levels != features.levels || map.scale_factor != features.scale_factor) {
        throw Error("the map was made with " + pyramidText(map.levels, map.scale_factor) +
                        ", the settings have " +
                        pyramidText(features.levels, features.scale_factor),
                    "use the config.ini of the map's folder");
    }
    if (map.rig.cameras.size() != rig.cameras.size()) {
        throw Error(
            "the map was made with " + countText(map.rig) + ", this run has " + countText(rig),
            "use as many cameras; --sensor LABEL selects one");
    }
    if (use == MapUse::Extend && !sameViews(map.rig, rig)) {
        throw Error("the map was made by a camera of another calibration, so it cannot be extended",
                    "localize in it, or make both rawlogs with one calibration");
    }
}

void seeWith(const Rig& rig, MapSnapshot& map) {
    if (sameViews(map.rig, rig)) return;
    const RigCameras from(map.rig), to(rig);
    for (Keyframe& keyframe : map.keyframes) {
        for (Keypoint& k : keyframe.frame.keypoints) {
            const Eigen::Vector3d ray = from[k.camera].camera().unproject(k.u, k.v, 1);
            const Eigen::Vector2d pixel = to[k.camera].camera().project(ray);
            k.u = static_cast<float>(pixel.x());
            k.v = static_cast<float>(pixel.y());
        }
        keyframe.frame.grid = to.gridOf(keyframe.frame.keypoints);
    }
    map.rig = rig;
}

}  // namespace rgbd_graphslam
