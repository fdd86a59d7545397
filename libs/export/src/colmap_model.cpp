#include "colmap_model.h"

#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

/** Of the top-left pixel's center, where this project has 0. */
constexpr double pixel_center = 0.5;

/** "1 qw qx qy qz tx ty tz 1 name", world to camera. */
std::string imageLine(const ColmapImage& image, std::size_t number) {
    const SE3 T_cam_world = image.T_world_cam.inverse();
    const Eigen::Quaterniond q = T_cam_world.quaternion();
    const Eigen::Vector3d& t = T_cam_world.t;
    return formatted("%zu %.12g %.12g %.12g %.12g %.12g %.12g %.12g 1 ", number + 1, q.w(), q.x(),
                     q.y(), q.z(), t.x(), t.y(), t.z()) +
           image.name + "\n";
}

/** Where a point is seen, and how far its projections are from there. */
struct Track {
    std::string text;
    double error_sum_px = 0;
    int length = 0;
};

std::vector<Track> tracksOf(const ColmapModel& model) {
    std::vector<Track> tracks(model.points.size());
    for (std::size_t i = 0; i < model.images.size(); ++i) {
        const ColmapImage& image = model.images[i];
        const SE3 T_cam_world = image.T_world_cam.inverse();
        for (std::size_t f = 0; f < image.features.size(); ++f) {
            const ColmapFeature& feature = image.features[f];
            Track& track = tracks[feature.point];
            track.text += formatted(" %zu %zu", i + 1, f);
            const Eigen::Vector3d p = T_cam_world * model.points[feature.point].position;
            track.error_sum_px += (model.camera.project(p) - feature.pixel).norm();
            ++track.length;
        }
    }
    return tracks;
}

}  // namespace

std::string colmapCameras(const ColmapModel& model) {
    const Intrinsics c = model.camera.intrinsics();
    return "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n" +
           formatted("1 PINHOLE %d %d %.12g %.12g %.12g %.12g\n", c.width, c.height, c.fx, c.fy,
                     c.cx + pixel_center, c.cy + pixel_center);
}

std::string colmapImages(const ColmapModel& model) {
    std::string text =
        "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
        "# POINTS2D[] as (X, Y, POINT3D_ID)\n";
    for (std::size_t i = 0; i < model.images.size(); ++i) {
        text += imageLine(model.images[i], i);
        const char* separator = "";
        for (const ColmapFeature& feature : model.images[i].features) {
            text += formatted("%s%.6g %.6g %zu", separator, feature.pixel.x() + pixel_center,
                              feature.pixel.y() + pixel_center, feature.point + 1);
            separator = " ";
        }
        text += "\n";
    }
    return text;
}

std::string colmapPoints(const ColmapModel& model) {
    std::string text =
        "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
    const std::vector<Track> tracks = tracksOf(model);
    for (std::size_t i = 0; i < model.points.size(); ++i) {
        const auto& [p, rgb] = model.points[i];
        const Track& track = tracks[i];
        text += formatted("%zu %.9g %.9g %.9g %d %d %d %.6g", i + 1, p.x(), p.y(), p.z(), rgb[0],
                          rgb[1], rgb[2], track.length ? track.error_sum_px / track.length : 0.) +
                track.text + "\n";
    }
    return text;
}

}  // namespace rgbd_graphslam
