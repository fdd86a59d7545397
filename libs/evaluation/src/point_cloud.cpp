#include "rgbd_graphslam/evaluation/point_cloud.h"

#include <cmath>
#include <filesystem>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/evaluation/stamped_list.h"
#include "rgbd_graphslam/geometry/associate.h"
#include "rgbd_graphslam/metrics/stamps.h"

namespace rgbd_graphslam {
namespace {

void check(const PointCloudOptions& options) {
    if (options.every_pixel < 1) throw Error("every 0th pixel is none", "give 1 or more");
    if (!(options.max_depth_m >= 0) || !(options.voxel_m >= 0)) {
        throw Error("depths and voxels have no negative size", "give 0 for no limit");
    }
}

std::vector<Eigen::Vector3d> raysOf(const Camera& camera) {
    std::vector<Eigen::Vector3d> rays;
    rays.reserve(static_cast<std::size_t>(camera.width) * camera.height);
    for (int v = 0; v < camera.height; ++v) {
        for (int u = 0; u < camera.width; ++u) {
            rays.push_back(camera.unproject(u, v, 1));
        }
    }
    return rays;
}

std::string sizeText(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

cv::Mat pixelsOf(const DecodedImage& image) {
    if (!image.damage.empty()) throw Error(image.damage, "check the file");
    return image.pixels;
}

/** Those of the images for which there is a pose. \param stamps_s of the images */
std::vector<PosedImageFiles> withPoses(const std::vector<double>& stamps_s,
                                       std::vector<PosedImageFiles> images,
                                       const Trajectory& trajectory, double max_difference_s) {
    std::vector<PosedImageFiles> posed;
    for (const auto& [i, j] : associate(stamps_s, stampsOf(trajectory), max_difference_s)) {
        images[i].T_world_cam = trajectory[j].T_world_cam;
        posed.push_back(std::move(images[i]));
    }
    if (posed.empty()) {
        throw Error(
            "no pose of the trajectory is within " + secondsText(max_difference_s) + " of an image",
            "check that lists and trajectory belong together");
    }
    return posed;
}

std::string beside(const std::string& list, const std::string& file) {
    return std::filesystem::path(list).parent_path() / file;
}

}  // namespace

PointCloudBuilder::PointCloudBuilder(const Camera& camera, const PointCloudOptions& options)
    : options_(options), width_(camera.width), height_(camera.height) {
    check(options);
    rays_ = raysOf(camera);
}

void PointCloudBuilder::add(const RgbdImage& image, const SE3& T_world_cam) {
    if (image.depth.cols != width_ || image.depth.rows != height_) {
        throw Error("an image of " + sizeText(image.depth.cols, image.depth.rows) +
                        " pixels for a camera of " + sizeText(width_, height_),
                    "give the camera's calibration");
    }
    for (int v = 0; v < height_; v += options_.every_pixel) {
        for (int u = 0; u < width_; u += options_.every_pixel) {
            const double z = image.depth.at<std::uint16_t>(v, u) * image.depth_unit_m;
            if (z <= 0 || (options_.max_depth_m > 0 && z > options_.max_depth_m)) continue;
            const Eigen::Vector3d p = T_world_cam * (z * rays_[v * width_ + u]);
            if (!isNew(p)) continue;
            const auto& bgr = image.color.at<cv::Vec3b>(v, u);
            cloud_.vertices.push_back(p.cast<float>());
            cloud_.colors.push_back({bgr[2], bgr[1], bgr[0]});
        }
    }
}

bool PointCloudBuilder::isNew(const Eigen::Vector3d& p) {
    if (options_.voxel_m <= 0) return true;
    constexpr int bits = 21;  // of each axis: 2 million voxels
    std::uint64_t key = 0;
    for (const double coordinate : p) {
        const auto cell = static_cast<std::int64_t>(std::floor(coordinate / options_.voxel_m));
        key = (key << bits) | (static_cast<std::uint64_t>(cell) & ((1u << bits) - 1));
    }
    return taken_voxels_.insert(key).second;
}

std::vector<PosedImageFiles> posedImages(const std::string& color_list,
                                         const std::string& depth_list,
                                         const Trajectory& trajectory, double max_difference_s) {
    const auto colors = readStampedList(color_list), depths = readStampedList(depth_list);
    std::vector<double> stamps_s;
    std::vector<PosedImageFiles> images;
    for (const auto& [i, j] : associate(stampsOf(colors), stampsOf(depths), max_difference_s)) {
        stamps_s.push_back(colors[i].stamp_s);
        images.push_back(
            {beside(color_list, colors[i].rest), beside(depth_list, depths[j].rest), {}});
    }
    return withPoses(stamps_s, std::move(images), trajectory, max_difference_s);
}

std::vector<PosedImageFiles> posedImages(const std::string& pair_list, const Trajectory& trajectory,
                                         double max_difference_s) {
    std::vector<double> stamps_s;
    std::vector<PosedImageFiles> images;
    for (const auto& [stamp_s, rest] : readStampedList(pair_list)) {
        std::istringstream words(rest);
        std::string color, depth_stamp, depth;
        if (!(words >> color >> depth_stamp >> depth)) {
            throw Error("a line of '" + pair_list + "' has too few words: " + rest,
                        "each must be 'stamp color stamp depth', as rgbd-eval associate prints");
        }
        stamps_s.push_back(stamp_s);
        images.push_back({beside(pair_list, color), beside(pair_list, depth), {}});
    }
    return withPoses(stamps_s, std::move(images), trajectory, max_difference_s);
}

RgbdImage readRgbdImage(const std::string& color, const std::string& depth, double depth_unit_m) {
    RgbdImage image;
    image.color = pixelsOf(readColorImage(color));
    image.depth = pixelsOf(readDepthImage(depth));
    image.depth_unit_m = depth_unit_m;
    if (image.depth.size() != image.color.size()) {
        throw Error("'" + depth + "' is of another size than '" + color + "'",
                    "give color and depth registered to it");
    }
    return image;
}

}  // namespace rgbd_graphslam
