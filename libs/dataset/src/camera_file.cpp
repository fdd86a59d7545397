#include "rgbd_graphslam/dataset/camera_file.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/math/TPose3D.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/ini_formulas.h"
#include "rgbd_graphslam/core/input_file.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/stereo_sequence.h"

namespace rgbd_graphslam {
namespace {

constexpr const char* left_section = "CAMERA_PARAMS";
constexpr const char* right_section = "CAMERA_PARAMS_RIGHT";
constexpr const char* stereo_section = "STEREO";
const std::vector<std::string> mrpt_keys = {
    "resolution",       "fx",           "fy",         "cx", "cy", "dist",
    "distortion_model", "focal_length", "camera_name"};
const std::vector<std::string> own_keys = {"depth_units", "depth_scale", "sensor_pose", "imu_pose"};

/** MRPT takes a comment line with an equals sign for a key. */
bool isComment(const std::string& key) {
    return key.rfind("//", 0) == 0 || key[0] == '#';
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool contains(const std::vector<std::string>& list, const std::string& item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

/** One section of a camera file being read. */
class CameraFile {
  public:
    CameraFile(const std::string& path, std::string section)
        : path_(path), section_(std::move(section)) {
        const std::string text =
            readTextFile(path, "a camera file", "give fr1, fr2, fr3, ros or an ini file");
        refuseFormulas(text, path);
        try {
            config_.setContent(text);
        } catch (const std::exception& e) {  // MRPT's variables
            refuse(e.what());
        }
        if (!config_.sectionExists(section_)) refuse("has no section [" + section_ + "]");
        refuseRepeatedKeys(text);
    }

    Intrinsics camera() {
        checkKeys();
        const Lens lens = lensOfFile();
        config_.write(section_, "distortion_model", std::string("none"));
        config_.write(section_, "dist", std::string("[0 0 0 0 0]"));
        mrpt::img::TCamera camera;
        try {
            camera.loadFromConfigFile(section_, config_);
        } catch (const std::exception&) {
            refuse("MRPT cannot read it");
        }
        checkPinhole(camera);
        Intrinsics own = toCamera(camera);
        own.lens = lens;
        if (!CameraModel(own).contains({own.cx, own.cy})) refusePrincipalPoint(own);
        if (!CameraModel(own).isInvertible())
            refuse("dist: this distortion cannot be undone in the image");
        return own;
    }

    bool has(const std::string& key) const { return config_.keyExists(section_, key); }

    double positive(const std::string& key, double otherwise) const {
        if (!has(key)) return otherwise;
        const auto numbers = numbersOf(key);
        if (numbers.size() != 1 || numbers[0] <= 0) refuse(key + " must be one positive number");
        return numbers[0];
    }

    double number(const std::string& key) const {
        if (!has(key)) refuse("the key '" + key + "' is missing");
        const auto numbers = numbersOf(key);
        if (numbers.size() != 1) refuse(key + " must be one number");
        return numbers[0];
    }

    SE3 pose(const std::string& key, const SE3& otherwise) const {
        if (!has(key)) return otherwise;
        const auto n = numbersOf(key);
        if (n.size() != 6) refuse(key + " must be [x y z yaw pitch roll] in m and degrees");
        const double rad = M_PI / 180;
        return toSE3(mrpt::poses::CPose3D(n[0], n[1], n[2], n[3] * rad, n[4] * rad, n[5] * rad));
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("camera file '" + path_ + "': " + why, "see ini/camera_fr1.ini for the form");
    }

    /** Images of a few pixels leave no room for doubts. */
    [[noreturn]] void refusePrincipalPoint(const Intrinsics& camera) const {
        const auto doubts = doubtsOf(camera);
        refuse(doubts.empty() ? "the principal point is outside the image" : doubts.front());
    }

    std::vector<double> numbersOf(const std::string& key) const {
        std::string text = config_.read_string(section_, key, "");
        std::replace_if(
            text.begin(), text.end(), [](char c) { return c == '[' || c == ']' || c == ','; }, ' ');
        std::istringstream words(text);
        std::vector<double> numbers;
        for (std::string word; words >> word;) {
            char* end = nullptr;
            numbers.push_back(std::strtod(word.c_str(), &end));
            if (*end || !std::isfinite(numbers.back()))
                refuse(key + ": '" + word + "' is not a number");
        }
        return numbers;
    }

    /** MRPT takes keys that differ in case only for one, and the last value for its value. */
    void refuseRepeatedKeys(const std::string& text) const {
        std::istringstream lines(text);
        std::map<std::string, std::pair<std::string, int>> seen;  // by the key in lower case
        bool in_section = false;
        int number = 1;
        for (std::string line; std::getline(lines, line); ++number) {
            const auto start = line.find_first_not_of(" \t\r");
            if (start == std::string::npos || isComment(line.substr(start)) || line[start] == ';') {
                continue;
            }
            if (line[start] == '[') {
                in_section = lowerCase(line.substr(start + 1, line.find(']') - start - 1)) ==
                             lowerCase(section_);
                continue;
            }
            const auto end = line.find_first_of(" \t=", start);
            const std::string key = line.substr(start, end - start);
            if (!in_section || line.find('=') == std::string::npos) continue;
            const auto [first, is_new] = seen.insert({lowerCase(key), {key, number}});
            if (is_new) continue;
            refuse("'" + key + "' in line " + std::to_string(number) + " repeats '" +
                   first->second.first + "' of line " + std::to_string(first->second.second) +
                   ", leave one");
        }
    }

    /** Read here rather than by MRPT, which mixes up the coefficients of a fisheye. */
    Lens lensOfFile() const {
        const std::string model = config_.read_string(section_, "distortion_model", "plumb_bob");
        const auto coefficients = has("dist") ? numbersOf("dist") : std::vector<double>();
        const std::size_t n = coefficients.size();
        if (model == "none") return {};
        if (model == "plumb_bob") {
            if (n != 0 && n != 4 && n != 5 && n != 8)
                refuse("dist must be [k1 k2 p1 p2], [k1 k2 p1 p2 k3] or [k1 k2 p1 p2 k3 k4 k5 k6]");
            return makeLens("rational", coefficients);
        }
        if (model != "kannala_brandt")
            refuse("distortion_model must be none, plumb_bob or kannala_brandt");
        if (n != 4) refuse("dist must be [k1 k2 k3 k4] for kannala_brandt");
        return makeLens("kannala_brandt", coefficients);
    }

    void checkKeys() const {
        std::vector<std::string> keys;
        config_.getAllKeys(section_, keys);
        for (const auto& key : keys) {
            if (!isComment(key) && !contains(mrpt_keys, key) && !contains(own_keys, key)) {
                refuse("unknown key '" + key + "'");
            }
        }
        for (const std::string key : {"fx", "fy", "cx", "cy"}) {
            if (!has(key)) refuse("the key '" + key + "' is missing");
            if (numbersOf(key).size() != 1) refuse(key + " must be one number");
        }
        if (!has("resolution") || numbersOf("resolution").size() != 2) {
            refuse("resolution must be [columns rows]");
        }
    }

    void checkPinhole(const mrpt::img::TCamera& camera) const {
        if (camera.fx() <= 0 || camera.fy() <= 0) refuse("fx and fy must be positive");
        if (camera.ncols == 0 || camera.nrows == 0) refuse("resolution must be positive");
    }

    std::string path_, section_;
    mrpt::config::CConfigFileMemory config_;
};

std::string poseText(const SE3& T) {
    const mrpt::poses::CPose3D pose = toCPose3D(T);
    std::string text = "[";
    for (const double meters : {pose.x(), pose.y(), pose.z()}) text += shortest(meters) + " ";
    for (const double rad : {pose.yaw(), pose.pitch()}) text += shortest(rad * 180 / M_PI) + " ";
    return text + shortest(pose.roll() * 180 / M_PI) + "]";
}

bool sameMotion(const SE3& a, const SE3& b) {
    return (a.t - b.t).norm() < 1e-12 && (a.R - b.R).norm() < 1e-12;
}

CameraSetup setupOf(const std::string& name, double fx, double fy, double cx, double cy,
                    const std::array<double, 5>& distortion) {
    CameraSetup setup;
    BrownLens brown;
    setup.name = name;
    setup.camera.fx = fx;
    setup.camera.fy = fy;
    setup.camera.cx = cx;
    setup.camera.cy = cy;
    std::copy(distortion.begin(), distortion.end(), brown.coefficients.begin());
    setup.camera.lens = brown;
    return setup;
}

bool digitAt(const std::string& text, std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
}

}  // namespace

CameraSetup::CameraSetup() : T_sensor_imu(kinectImuAxes()) {}

SE3 kinectImuAxes() {
    return {(Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(), Eigen::Vector3d::Zero()};
}

std::optional<CameraSetup> cameraByName(const std::string& name) {
    if (name == "fr1") {
        return setupOf(name, 517.3, 516.5, 318.6, 255.3,
                       {0.2624, -0.9531, -0.0054, 0.0026, 1.1633});
    }
    if (name == "fr2") {
        return setupOf(name, 520.9, 521.0, 325.1, 249.7,
                       {0.2312, -0.7849, -0.0033, -0.0001, 0.9172});
    }
    if (name == "fr3") return setupOf(name, 535.4, 539.2, 320.1, 247.6, {});
    if (name == "ros") return setupOf(name, 525, 525, 319.5, 239.5, {});
    return std::nullopt;
}

std::optional<CameraSetup> cameraByFolderName(const std::string& folder) {
    const std::string name = lowerCase(folder);
    for (const std::string number : {"1", "2", "3"}) {
        for (const std::string prefix : {"freiburg", "fr"}) {
            const auto at = name.find(prefix + number);
            if (at != std::string::npos && !digitAt(name, at + prefix.size() + 1)) {
                return cameraByName("fr" + number);
            }
        }
    }
    return std::nullopt;
}

std::vector<std::string> doubtsOf(const Intrinsics& camera) {
    constexpr double narrowest_deg = 15, widest_deg = 150, farthest_off = 0.25;
    const double off_x = std::abs(camera.cx - 0.5 * (camera.width - 1)) / camera.width;
    const double off_y = std::abs(camera.cy - 0.5 * (camera.height - 1)) / camera.height;
    std::vector<std::string> doubts;
    char text[240];
    if (!(off_x <= farthest_off) || !(off_y <= farthest_off)) {
        const bool outside = !(off_x <= 0.5) || !(off_y <= 0.5);
        std::snprintf(text, sizeof text,
                      "the principal point (cx %.6g, cy %.6g) is %s the image of %dx%d pixels; it "
                      "should be near %.6g, %.6g, unless the calibration is for another resolution",
                      camera.cx, camera.cy, outside ? "outside" : "far from the center of",
                      camera.width, camera.height, 0.5 * (camera.width - 1),
                      0.5 * (camera.height - 1));
        doubts.emplace_back(text);
    }
    const double view_deg = 360 / M_PI * std::atan(0.5 * camera.width / camera.fx);
    if (view_deg < narrowest_deg || view_deg > widest_deg) {
        std::snprintf(text, sizeof text,
                      "fx = %.6g means a field of view of %.0f degrees; usual cameras have 40 to "
                      "90, fx = %.0f to %.0f",
                      camera.fx, view_deg, 0.5 * camera.width, 1.37 * camera.width);
        doubts.emplace_back(text);
    }
    return doubts;
}

void requirePrincipalPoint(const Intrinsics& camera, const std::string& name) {
    if (CameraModel(camera).contains({camera.cx, camera.cy})) return;
    const auto doubts = doubtsOf(camera);
    throw Error("the calibration '" + name + "': " +
                    (doubts.empty() ? "the principal point is outside the image" : doubts.front()),
                "mend it, or give another with --camera");
}

std::optional<Intrinsics> resizedTo(const Intrinsics& camera, int width, int height) {
    constexpr int largest_factor = 8;
    const int more = std::max(width, camera.width), less = std::min(width, camera.width);
    const bool same_aspect =
        std::int64_t{width} * camera.height == std::int64_t{height} * camera.width;
    if (less <= 0 || !same_aspect || more % less != 0 || more / less > largest_factor) {
        return std::nullopt;
    }
    const double factor = static_cast<double>(width) / camera.width;
    return scaled(camera, factor, width, height);
}

CameraSetup readCameraFile(const std::string& path) {
    CameraFile file(path, left_section);
    CameraSetup setup;
    setup.name = path;
    setup.camera = file.camera();
    setup.depth_units = file.positive("depth_units", setup.depth_units);
    setup.depth_units_assumed = !file.has("depth_units");
    setup.depth_scale = file.positive("depth_scale", setup.depth_scale);
    setup.T_base_sensor = file.pose("sensor_pose", setup.T_base_sensor);
    setup.T_sensor_imu = file.pose("imu_pose", setup.T_sensor_imu);
    return setup;
}

StereoCalibration readStereoCameraFile(const std::string& path) {
    const CameraSetup left = readCameraFile(path);
    CameraFile right(path, right_section);
    const CameraFile stereo(path, stereo_section);
    StereoCalibration calibration;
    calibration.name = path;
    calibration.left = toTCamera(left.camera);
    calibration.right = toTCamera(right.camera());
    calibration.T_base_left = left.T_base_sensor * T_optical_from_mrpt.inverse();
    calibration.T_base_imu = left.T_base_sensor * left.T_sensor_imu;
    calibration.T_left_right.t.x() = stereo.number("baseline");
    return calibration;
}

std::string toIniText(const CameraSetup& setup) {
    const Intrinsics& camera = setup.camera;
    std::ostringstream out;
    out << "[" << left_section << "]\nresolution = [" << camera.width << " " << camera.height
        << "]\n";
    out << "fx = " << shortest(camera.fx) << "\nfy = " << shortest(camera.fy) << "\n";
    out << "cx = " << shortest(camera.cx) << "\ncy = " << shortest(camera.cy) << "\n";
    const std::string model = lensModel(camera.lens);
    out << "distortion_model = " << (model == "rational" ? "plumb_bob" : model) << "\ndist = [";
    const char* separator = "";
    for (const double k : lensCoefficients(camera.lens)) {
        out << separator << shortest(k);
        separator = " ";
    }
    out << "]\n";
    out << "depth_units = " << shortest(setup.depth_units) << "\n";
    if (setup.depth_scale != 1) out << "depth_scale = " << shortest(setup.depth_scale) << "\n";
    if (!sameMotion(setup.T_base_sensor, {})) {
        out << "sensor_pose = " << poseText(setup.T_base_sensor) << "\n";
    }
    if (!sameMotion(setup.T_sensor_imu, kinectImuAxes())) {
        out << "imu_pose = " << poseText(setup.T_sensor_imu) << "\n";
    }
    return out.str();
}

}  // namespace rgbd_graphslam
