/** EuRoC's folders, in which TUM-VI's recordings come, too. */
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "euroc_calibration.h"
#include "image_folders.h"
#include "list_file.h"
#include "numbered_files.h"
#include "rgbd_graphslam/core/error.h"
#include "stereo_layouts.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr double latest_ns = 1e19;

double nanoseconds(Line& line, const std::string& form) {
    const double stamp_ns = line.realNumber(form);
    if (!(stamp_ns >= 0 && stamp_ns <= latest_ns)) line.refuse("no such time in ns", form);
    return 1e-9 * stamp_ns;
}

/** The folder that holds cam0/, relative to the recording's. */
fs::path rootOf(const fs::path& folder) {
    return fs::is_directory(folder / "mav0") ? "mav0" : "";
}

std::vector<ListedImage> imagesOf(const fs::path& folder, const fs::path& camera) {
    const std::string form = "stamp_ns,file";
    const fs::path data = camera / "data", list = folder / camera / "data.csv";
    if (!fs::exists(list)) {
        const auto files = filesByNumber(folder, data, color_endings);
        return stamped(files, {1e-9, ""});
    }
    std::vector<ListedImage> images;
    forEachLine(list, [&](Line& line) {
        const double stamp_s = nanoseconds(line, form);
        const std::string file = line.rest();
        if (file.empty()) line.refuse("no file name", form);
        images.push_back({stamp_s, data / file});
    });
    return images;
}

void readImu(const fs::path& list, RgbdSequence& motion) {
    const std::string form = "stamp_ns,wx,wy,wz,ax,ay,az";
    if (!fs::exists(list)) return;
    forEachLine(list, [&](Line& line) {
        StampedVector angular, linear;
        angular.stamp_s = linear.stamp_s = nanoseconds(line, form);
        for (StampedVector* reading : {&angular, &linear}) {
            for (int i = 0; i < 3; ++i) reading->value[i] = line.realNumber(form);
        }
        motion.angular_velocity.push_back(angular);
        motion.acceleration.push_back(linear);
    });
}

/** Poses of the sensor that the list is of. */
Trajectory posesIn(const fs::path& list) {
    const std::string form = "stamp_ns,x,y,z,qw,qx,qy,qz";
    Trajectory poses;
    forEachLine(list, [&](Line& line) {
        const double stamp_s = nanoseconds(line, form);
        double v[7];
        for (double& value : v) value = line.realNumber(form);
        const Eigen::Quaterniond rotation(v[3], v[4], v[5], v[6]);
        if (!(std::abs(rotation.norm() - 1) < 0.01)) line.refuse("no unit quaternion", form);
        poses.push_back({stamp_s, SE3(rotation, {v[0], v[1], v[2]})});
    });
    std::stable_sort(poses.begin(), poses.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
    return poses;
}

/** \return the sensor's folder that it was taken from; empty when there is none */
std::string readTruth(const fs::path& root, StereoSequence& sequence) {
    for (const std::string sensor : {"state_groundtruth_estimate0", "mocap0"}) {
        if (!fs::exists(root / sensor / "data.csv")) continue;
        const SE3 T_sensor_left = readEurocPose(root / sensor / "sensor.yaml").inverse() *
                                  sequence.calibration.T_base_left;
        sequence.motion.truth = posesIn(root / sensor / "data.csv");
        for (auto& pose : sequence.motion.truth) {
            pose.T_world_cam = pose.T_world_cam * T_sensor_left;
        }
        return sensor;
    }
    return "";
}

StereoCalibration calibrationIn(const fs::path& folder, const fs::path& root) {
    const fs::path left = root / "cam0" / "sensor.yaml", right = root / "cam1" / "sensor.yaml";
    if (!fs::exists(left) || !fs::exists(right)) {
        for (const char* chain : {"dso/camchain.yaml", "camchain.yaml"}) {
            if (fs::exists(folder / chain)) return readCamchain(folder / chain);
        }
        throw Error("'" + folder.string() +
                        "' has no calibration (cam0/sensor.yaml and "
                        "cam1/sensor.yaml, or dso/camchain.yaml)",
                    "give both cameras with --camera, see doc/file-formats.md");
    }
    StereoCalibration calibration;
    calibration.name = left;
    SE3 T_base_right;
    std::tie(calibration.left, calibration.T_base_left) = readEurocCamera(left);
    std::tie(calibration.right, T_base_right) = readEurocCamera(right);
    calibration.T_left_right = calibration.T_base_left.inverse() * T_base_right;
    return calibration;
}

/** Names of the sensors' folders that nothing is taken from. */
std::string leftOut(const fs::path& root, const std::set<std::string>& taken) {
    std::set<std::string> others;
    for (const auto& entry : fs::directory_iterator(root)) {
        const std::string name = entry.path().filename();
        if (entry.is_directory() && taken.count(name) == 0) others.insert(name);
    }
    std::string text;
    for (const std::string& name : others) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

bool isEurocFolder(const fs::path& folder) {
    const fs::path root = folder / rootOf(folder);
    return fs::is_directory(root / "cam0" / "data") && fs::is_directory(root / "cam1" / "data");
}

StereoSequence readEurocFolder(const fs::path& folder, const StereoCalibration* given) {
    const fs::path in = rootOf(folder), root = folder / in;
    StereoSequence sequence;
    sequence.left = imagesOf(folder, in / "cam0");
    sequence.right = imagesOf(folder, in / "cam1");
    sequence.calibration = given ? *given : calibrationIn(folder, root);
    sequence.calibration.T_base_imu = readEurocPose(root / "imu0" / "sensor.yaml");
    readImu(root / "imu0" / "data.csv", sequence.motion);
    const std::string truth = readTruth(root, sequence);
    auto& notes = sequence.motion.notes;
    notes.push_back("EuRoC's layout: cam0 is the left camera, cam1 the right one" +
                    (truth.empty() ? ", no ground truth" : ", ground truth from " + truth));
    const std::string others = leftOut(root, {"cam0", "cam1", "imu0", truth});
    if (!others.empty()) notes.push_back("left out: " + others);
    return sequence;
}

}  // namespace rgbd_graphslam
