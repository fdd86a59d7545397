#include "euroc_calibration.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "calibration_text.h"
#include "plain_yaml.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace {

using Json = nlohmann::json;

/** A sensor's entries in a file. */
class SensorNode {
  public:
    SensorNode(std::string path, Json node) : path_(std::move(path)), node_(std::move(node)) {}

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("calibration '" + path_ + "': " + why, "fetch it again, or give --camera");
    }

    bool has(const std::string& key) const { return node_.is_object() && node_.contains(key); }

    SensorNode at(const std::string& key) const { return {path_, has(key) ? node_[key] : Json()}; }

    /** Of a list, a list of rows, or a map with them under `data`; all finite. */
    std::vector<double> numbers(const std::string& key, std::size_t count) const {
        std::vector<double> found;
        if (has(key)) append(node_[key], found);
        if (found.size() != count) refuse(key + " must have " + std::to_string(count) + " numbers");
        return found;
    }

    SE3 pose(const std::string& key) const {
        const auto m = numbers(key, 16);
        const Eigen::Matrix4d T =
            Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data());
        const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
        const bool is_rotation =
            (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 0.01 && R.determinant() > 0;
        if (!is_rotation) refuse(key + " is not a rotation with a translation");
        return {orthonormalized(R), T.topRightCorner<3, 1>()};
    }

    mrpt::img::TCamera camera() const {
        constexpr double largest_image_px = 1 << 16;
        const auto size = numbers("resolution", 2), f = numbers("intrinsics", 4);
        for (const double side : size) {
            if (!(side >= 1 && side <= largest_image_px)) refuse("resolution is not an image size");
        }
        if (f[0] <= 0 || f[1] <= 0) refuse("the focal lengths must be positive");
        Intrinsics pinhole;
        pinhole.width = static_cast<int>(size[0]);
        pinhole.height = static_cast<int>(size[1]);
        pinhole.fx = f[0];
        pinhole.fy = f[1];
        pinhole.cx = f[2];
        pinhole.cy = f[3];
        return withLens(pinhole);
    }

  private:
    mrpt::img::TCamera withLens(Intrinsics pinhole) const {
        const std::string model = text("distortion_model");
        if (model.empty() || model == "none") return toTCamera(pinhole);
        const auto k =
            numbers(has("distortion_coeffs") ? "distortion_coeffs" : "distortion_coefficients", 4);
        if (model == "equidistant") {
            pinhole.lens = makeLens("kannala_brandt", k);
            return toTCamera(pinhole);
        }
        if (model != "radial-tangential" && model != "radtan") {
            refuse("the lens model '" + model + "' is not supported, undistort the images");
        }
        pinhole.lens = makeLens("rational", k);
        if (!CameraModel(pinhole).isInvertible())
            refuse("this distortion cannot be undone in the image");
        return toTCamera(pinhole);
    }

    std::string text(const std::string& key) const {
        return has(key) && node_[key].is_string() ? node_[key].get<std::string>() : std::string();
    }

    void append(const Json& value, std::vector<double>& found, int levels = 3) const {
        constexpr std::size_t most = 64;
        if (value.is_number()) {
            if (!std::isfinite(value.get<double>())) refuse("a number is not finite");
            found.push_back(value.get<double>());
        }
        if (value.is_object() && value.contains("data")) append(value["data"], found, levels - 1);
        if (!value.is_array() || levels == 0) return;
        for (const Json& item : value) {
            if (found.size() < most) append(item, found, levels - 1);
        }
    }

    std::string path_;
    Json node_;
};

SensorNode nodeIn(const std::string& path) {
    return {path, parsePlainYaml(calibrationText(path))};
}

}  // namespace

std::pair<mrpt::img::TCamera, SE3> readEurocCamera(const std::string& path) {
    const SensorNode node = nodeIn(path);
    return {node.camera(), node.pose("T_BS")};
}

SE3 readEurocPose(const std::string& path) {
    return std::filesystem::exists(path) ? nodeIn(path).pose("T_BS") : SE3();
}

StereoCalibration readCamchain(const std::string& path) {
    const SensorNode chain = nodeIn(path), left = chain.at("cam0"), right = chain.at("cam1");
    StereoCalibration calibration;
    calibration.name = path;
    calibration.left = left.camera();
    calibration.right = right.camera();
    const SE3 T_left_imu = left.has("T_cam_imu") ? left.pose("T_cam_imu") : SE3();
    const SE3 T_right_left = right.has("T_cn_cnm1")
                                 ? right.pose("T_cn_cnm1")
                                 : right.pose("T_cam_imu") * T_left_imu.inverse();
    calibration.T_base_left = T_left_imu.inverse();
    calibration.T_left_right = T_right_left.inverse();
    return calibration;
}

}  // namespace rgbd_graphslam
