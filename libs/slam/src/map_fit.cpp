#include "map_fit.h"

#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::string pyramidText(int levels, double scale_factor) {
    return std::to_string(levels) + " pyramid levels of factor " + std::to_string(scale_factor);
}

/** Keypoints are undistorted, so lenses do not matter. */
bool sameView(const Camera& a, const Camera& b) {
    return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
           a.cx == b.cx && a.cy == b.cy;
}

}  // namespace

void requireFits(const MapSnapshot& map, const FeatureOptions& features, const Camera& camera,
                 MapUse use) {
    if (map.levels != features.levels || map.scale_factor != features.scale_factor) {
        throw Error("the map was made with " + pyramidText(map.levels, map.scale_factor) +
                        ", the settings have " +
                        pyramidText(features.levels, features.scale_factor),
                    "use the config.ini of the map's folder");
    }
    if (use == MapUse::Extend && !sameView(map.camera, camera)) {
        throw Error("the map was made by a camera of another calibration, so it cannot be extended",
                    "localize in it, or make both rawlogs with one calibration");
    }
}

void seeWith(const Camera& camera, MapSnapshot& map) {
    if (sameView(map.camera, camera)) return;
    const auto seen = [&](const Keypoint& k) {
        return camera.project(map.camera.unproject(k.u, k.v, 1));
    };
    for (Keyframe& keyframe : map.keyframes) {
        for (Keypoint& k : keyframe.frame.keypoints) {
            const Eigen::Vector2d pixel = seen(k);
            k.u = static_cast<float>(pixel.x());
            k.v = static_cast<float>(pixel.y());
        }
        keyframe.frame.grid = KeypointGrid(keyframe.frame.keypoints, camera.width, camera.height);
    }
    map.camera = camera;
}

}  // namespace rgbd_graphslam
