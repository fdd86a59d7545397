#include "map_fit.h"

#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::string pyramidText(int levels, double scale_factor) {
    return std::to_string(levels) + " pyramid levels of factor " + std::to_string(scale_factor);
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
    const bool same_camera = map.camera.width == camera.width &&
                             map.camera.height == camera.height && map.camera.fx == camera.fx &&
                             map.camera.fy == camera.fy && map.camera.cx == camera.cx &&
                             map.camera.cy == camera.cy;
    if (use == MapUse::Extend && !same_camera) {
        throw Error("the map was made by a camera of another calibration, so it cannot be extended",
                    "localise in it, or make both rawlogs with one calibration");
    }
}

}  // namespace rgbd_graphslam
