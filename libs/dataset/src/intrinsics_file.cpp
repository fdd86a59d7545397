#include "rgbd_graphslam/dataset/intrinsics_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "calibration_text.h"
#include "plain_yaml.h"
#include "rgbd_graphslam/core/error.h"
#include "ros_lens.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;
using Keys = std::vector<std::string>;

const Keys width_keys = {"width", "w", "image_width"},
           height_keys = {"height", "h", "image_height"};
const Keys matrix_keys = {"intrinsic_matrix", "camera_matrix", "K", "k"};
const Keys distortion_keys = {"coeffs", "distortion_coefficients", "distortion_coeffs", "D", "d"};
const Keys model_keys = {"model", "distortion_model", "camera_model"};
const Keys units_keys = {"depth_scale", "depth_units", "scale"};
constexpr double largest_image_px = 1 << 16;

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool endsWith(const std::string& text, const std::string& ending) {
    return text.size() >= ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

bool isYaml(const std::string& path) {
    const std::string name = lowerCase(path);
    return endsWith(name, ".yaml") || endsWith(name, ".yml");
}

const Json* firstOf(const Json& node, const Keys& keys) {
    for (const std::string& key : keys) {
        const auto found = node.find(key);
        if (found != node.end() && !found->is_null()) return &*found;
    }
    return nullptr;
}

double numberOf(const Json& node, const Keys& keys, double otherwise) {
    const Json* value = firstOf(node, keys);
    return value && value->is_number() ? value->get<double>() : otherwise;
}

/** A matrix may be a list of rows. */
void appendNumbers(const Json& value, std::vector<double>& numbers, int levels = 2) {
    constexpr std::size_t most = 64;
    if (value.is_number()) numbers.push_back(value.get<double>());
    if (!value.is_array() || levels == 0) return;
    for (const Json& item : value) {
        if (numbers.size() < most) appendNumbers(item, numbers, levels - 1);
    }
}

/** Of a list, a list of rows, or a matrix with its numbers under `data`. */
std::vector<double> numbersOf(const Json& node, const Keys& keys) {
    std::vector<double> numbers;
    const Json* value = firstOf(node, keys);
    if (value && value->is_object()) value = firstOf(*value, {"data"});
    if (value) appendNumbers(*value, numbers);
    return numbers;
}

bool isCamera(const Json& node) {
    return node.is_object() && (node.contains("fx") || firstOf(node, matrix_keys) ||
                                (node.contains("intrinsics") && node["intrinsics"].is_array()));
}

/** The calibration in a tree: here, in the branch named for color, or in the first that has one.
 */
const Json* cameraIn(const Json& node, int levels = 4) {
    if (isCamera(node)) return &node;
    if (levels == 0 || !node.is_structured()) return nullptr;
    if (node.is_object()) {
        for (const auto& [key, child] : node.items()) {
            const std::string name = lowerCase(key);
            const bool is_color =
                name.find("color") != std::string::npos || name.find("rgb") != std::string::npos;
            const Json* found = is_color ? cameraIn(child, levels - 1) : nullptr;
            if (found) return found;
        }
    }
    for (const Json& child : node) {
        if (const Json* found = cameraIn(child, levels - 1)) return found;
    }
    return nullptr;
}

/** One file's calibration. */
class Calibration {
  public:
    Calibration(std::string path, const Json& node) : path_(std::move(path)), node_(node) {}

    /** \param tree where the depth unit may stand, too */
    CameraSetup setup(const Json& tree) const {
        CameraSetup setup;
        setup.name = path_;
        setSize(setup.camera);
        setIntrinsics(setup.camera);
        setDistortion(setup.camera);
        setUnits(setup, firstOf(node_, units_keys) ? node_ : tree);
        return setup;
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("calibration '" + path_ + "': " + why,
                    "mend it, or give the camera as an ini file, see ini/camera_fr1.ini");
    }

    void setSize(Intrinsics& camera) const {
        const auto resolution = numbersOf(node_, {"resolution", "image_size"});
        const bool as_list = resolution.size() == 2;
        const double width = as_list ? resolution[0] : numberOf(node_, width_keys, 0);
        const double height = as_list ? resolution[1] : numberOf(node_, height_keys, 0);
        for (const double side : {width, height}) {
            if (!(side >= 0 && side <= largest_image_px)) refuse("images have no such size");
        }
        camera.width = static_cast<int>(width);
        camera.height = static_cast<int>(height);
    }

    void setIntrinsics(Intrinsics& camera) const {
        const double missing = std::nan("");
        std::vector<double> f = {numberOf(node_, {"fx"}, missing), numberOf(node_, {"fy"}, missing),
                                 numberOf(node_, {"cx", "ppx"}, missing),
                                 numberOf(node_, {"cy", "ppy"}, missing)};
        const auto list = numbersOf(node_, {"intrinsics"}), K = numbersOf(node_, matrix_keys);
        if (!node_.contains("fx") && list.size() == 4) f = list;
        if (!node_.contains("fx") && K.size() == 9) {
            const bool by_columns = K[2] == 0 && K[5] == 0;
            f = {K[0], K[4], by_columns ? K[6] : K[2], by_columns ? K[7] : K[5]};
        }
        const bool finite =
            std::all_of(f.begin(), f.end(), [](double x) { return std::isfinite(x); });
        if (!finite || f[0] <= 0 || f[1] <= 0) refuse("no usable fx, fy, cx and cy");
        camera.fx = f[0];
        camera.fy = f[1];
        camera.cx = f[2];
        camera.cy = f[3];
    }

    void setDistortion(Intrinsics& camera) const {
        const auto coefficients = numbersOf(node_, distortion_keys);
        for (const double c : coefficients) {
            if (!std::isfinite(c)) refuse("a distortion coefficient is not a number");
        }
        const std::string model = lensModelName();
        const auto lens = lensByRosName(model, coefficients);
        if (!lens) {
            refuse("the lens model '" + model + "' with " + std::to_string(coefficients.size()) +
                   " coefficients is not supported, undistort the images");
        }
        camera.lens = coefficients.empty() ? Lens() : *lens;
        Intrinsics sized = camera;
        if (sized.width == 0) sized.width = static_cast<int>(std::min(1e4, 2 * camera.cx));
        if (sized.height == 0) sized.height = static_cast<int>(std::min(1e4, 2 * camera.cy));
        if (!CameraModel(sized).isInvertible())
            refuse("this distortion cannot be undone in the image");
    }

    /** All that the file calls model: `camera_model` often names the projection only. */
    std::string lensModelName() const {
        std::string names;
        for (const std::string& key : model_keys) {
            const Json* model = firstOf(node_, {key});
            if (model && model->is_string())
                names += (names.empty() ? "" : " ") + model->get<std::string>();
        }
        return names;
    }

    /** Units per meter, or meters per unit where below 1. */
    static void setUnits(CameraSetup& setup, const Json& node) {
        const double units = numberOf(node, units_keys, 0);
        const bool stated = units > 1e-7 && units < 1e7 && units != 1;
        constexpr double millimeters = 1000;
        setup.depth_units = !stated ? millimeters : units < 1 ? 1 / units : units;
        setup.depth_units_assumed = !stated;
    }

    std::string path_;
    const Json& node_;
};

CameraSetup parsed(const std::string& path) {
    Json tree;
    if (isYaml(path)) {
        tree = parsePlainYaml(calibrationText(path));
    } else {
        tree = Json::parse(calibrationText(path), nullptr, false);
        if (tree.is_discarded()) throw Error("'" + path + "' is not JSON", "check it");
    }
    const Json* camera = cameraIn(tree);
    if (!camera) {
        throw Error(
            "'" + path + "' has no camera: neither fx, fy, cx, cy nor a matrix of intrinsics",
            "give the camera as an ini file, see ini/camera_fr1.ini");
    }
    return Calibration(path, *camera).setup(tree);
}

}  // namespace

CameraSetup readCalibration(const std::string& path) {
    const bool is_json = endsWith(lowerCase(path), ".json");
    return is_json || isYaml(path) ? parsed(path) : readCameraFile(path);
}

std::optional<CameraSetup> calibrationIn(const std::string& folder) {
    for (const char* name :
         {"camera.ini", "camera_intrinsic.json", "intrinsic.json", "intrinsics.json", "camera.json",
          "camera_info.json", "camera_info.yaml", "camera.yaml", "intrinsics.yaml"}) {
        const fs::path path = fs::path(folder) / name;
        if (fs::is_regular_file(path)) return readCalibration(path);
    }
    return std::nullopt;
}

}  // namespace rgbd_graphslam
