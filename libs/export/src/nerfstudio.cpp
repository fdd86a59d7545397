#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "run_images.h"
#include "run_points.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr double depth_unit_m = 0.001;  // nerfstudio's default
constexpr std::size_t most_points = 500000;
/** Of the top-left pixel's center, where this project has 0. */
constexpr double pixel_center = 0.5;

/** Camera to world, the camera's axes x right, y up, z backwards. */
nlohmann::json openGlMatrix(const SE3& T_world_cam) {
    nlohmann::json rows = nlohmann::json::array();
    for (int i = 0; i < 3; ++i) {
        rows.push_back(
            {T_world_cam.R(i, 0), -T_world_cam.R(i, 1), -T_world_cam.R(i, 2), T_world_cam.t(i)});
    }
    rows.push_back({0., 0., 0., 1.});
    return rows;
}

/** Depth in mm; what is farther than 16 bits can say has no depth. */
cv::Mat1w depthInMillimeters(const RunImage& image) {
    cv::Mat1w result(image.depth.size());
    const double factor = image.depth_unit_m / depth_unit_m;
    const auto convert = [&](std::uint16_t depth) {
        const double value = depth * factor + 0.5;
        return value > std::numeric_limits<std::uint16_t>::max()
                   ? std::uint16_t{0}
                   : static_cast<std::uint16_t>(value);
    };
    std::transform(image.depth.begin(), image.depth.end(), result.begin(), convert);
    return result;
}

void describeCamera(const Intrinsics& camera, nlohmann::json& scene) {
    scene["camera_model"] = "OPENCV";
    scene["w"] = camera.width;
    scene["h"] = camera.height;
    scene["fl_x"] = camera.fx;
    scene["fl_y"] = camera.fy;
    scene["cx"] = camera.cx + pixel_center;
    scene["cy"] = camera.cy + pixel_center;
    for (const char* coefficient : {"k1", "k2", "p1", "p2"}) scene[coefficient] = 0.;
    scene["depth_unit_scale_factor"] = depth_unit_m;
}

class NerfstudioExporter : public Exporter {
  public:
    const char* name() const override { return "nerfstudio"; }
    const char* about() const override {
        return "transforms.json, undistorted images, depth and points for nerfstudio";
    }
    const char* fileName() const override { return "nerfstudio"; }
    bool writesFolder() const override { return true; }

    std::string write(const std::string& run_folder, const ExportOptions& options,
                      const std::string& path) const override {
        const fs::path out(path);
        const PointMap points = readRunPoints(run_folder, most_points);
        const MapInputs run = readRunFolder(run_folder, options.rawlog);
        for (const char* folder : {"images", "depth"}) fs::create_directories(out / folder);
        nlohmann::json scene, frames = nlohmann::json::array();
        const std::size_t images =
            forEachImage(run, options.all_frames, "nerfstudio", [&](const RunImage& image) {
                if (frames.empty()) describeCamera(image.camera.intrinsics(), scene);
                frames.push_back(writeFrame(image, out));
            });
        scene["frames"] = frames;
        scene["ply_file_path"] = "points.ply";
        savePly((out / "points.ply").string(), points);
        writeTextAtomically((out / "transforms.json").string(), scene.dump(1) + "\n");
        return std::to_string(images) + " images with depth, " + std::to_string(points.size()) +
               " points";
    }

  private:
    static nlohmann::json writeFrame(const RunImage& image, const fs::path& out) {
        const std::string color = "images/" + imageName("frame", image.number, "jpg");
        const std::string depth = "depth/" + imageName("frame", image.number, "png");
        writeImage((out / color).string(), image.color);
        writeImage((out / depth).string(), depthInMillimeters(image));
        return {{"file_path", color},
                {"depth_file_path", depth},
                {"transform_matrix", openGlMatrix(image.pose.T_world_cam)}};
    }
};

}  // namespace

std::unique_ptr<const Exporter> nerfstudioExporter() {
    return std::make_unique<NerfstudioExporter>();
}

}  // namespace rgbd_graphslam
