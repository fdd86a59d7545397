/** KITTI's odometry benchmark. */
#include <map>

#include "image_folders.h"
#include "list_file.h"
#include "number_text.h"
#include "numbered_files.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "stereo_layouts.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** A rectified camera in the frame of image_0's. */
struct Projection {
    double f = 0, cx = 0, cy = 0;
    /** Where it sits to the right of image_0's camera, m. */
    double x_m = 0;
};

Projection projectionIn(Line& line) {
    const std::string form = "P0: and the 12 numbers of a 3x4 projection matrix";
    double P[12];
    for (double& value : P) value = line.realNumber(form);
    const bool rectified = P[0] > 0 && P[0] == P[5] && P[1] == 0 && P[4] == 0 && P[10] == 1;
    if (!rectified) line.refuse("this is not a projection of a rectified camera", form);
    return {P[0], P[2], P[6], -P[3] / P[0]};
}

/** By the names of the folders of images. */
std::map<std::string, Projection> readCalib(const std::string& path) {
    if (!fs::exists(path)) {
        throw Error("there is no '" + path + "'",
                    "fetch KITTI's calibration files, or give --camera");
    }
    std::map<std::string, Projection> projections;
    forEachLine(path, [&](Line& line) {
        std::string name;
        line.words >> name;
        const bool is_camera = name.size() == 3 && name[0] == 'P' && name[1] >= '0' &&
                               name[1] <= '3' && name[2] == ':';
        if (is_camera) projections["image_" + name.substr(1, 1)] = projectionIn(line);
    });
    return projections;
}

mrpt::img::TCamera cameraOf(const Projection& projection) {
    mrpt::img::TCamera camera;
    camera.ncols = camera.nrows = 0;
    camera.setIntrinsicParamsFromValues(projection.f, projection.f, projection.cx, projection.cy);
    return camera;
}

SE3 toTheRight(double x_m) {
    return {Eigen::Matrix3d::Identity(), {x_m, 0, 0}};
}

/** The folders of the images: gray ones before color. */
std::pair<std::string, std::string> foldersIn(const fs::path& folder) {
    const bool has_gray =
        fs::is_directory(folder / "image_0") && fs::is_directory(folder / "image_1");
    if (has_gray) return {"image_0", "image_1"};
    return {"image_2", "image_3"};
}

StereoCalibration calibrationIn(const fs::path& folder, const std::string& left,
                                const std::string& right) {
    const std::string path = folder / "calib.txt";
    const auto projections = readCalib(path);
    const auto P_left = projections.find(left), P_right = projections.find(right);
    if (P_left == projections.end() || P_right == projections.end()) {
        throw Error("'" + path + "' has no P" + left.back() + " and P" + right.back(),
                    "fetch KITTI's calibration files, or give --camera");
    }
    StereoCalibration calibration;
    calibration.name = path;
    calibration.left = cameraOf(P_left->second);
    calibration.right = cameraOf(P_right->second);
    calibration.T_base_left = calibration.T_base_imu = T_optical_from_mrpt.inverse();
    calibration.T_left_right = toTheRight(P_right->second.x_m - P_left->second.x_m);
    return calibration;
}

std::vector<double> timesIn(const fs::path& list) {
    std::vector<double> times;
    if (!fs::exists(list)) return times;
    forEachLine(list, [&](Line& line) {
        const double time_s = line.realNumber("time_s");
        if (!(time_s >= 0 && time_s < 1e10)) line.refuse("no such time in s", "time_s");
        times.push_back(time_s);
    });
    return times;
}

/** Stamps by the images' numbers; those beyond the list have none and are left out. */
std::vector<ListedImage> imagesIn(const fs::path& folder, const std::string& subfolder,
                                  const std::vector<double>& times, double rate_hz) {
    const auto files = filesByNumber(folder, subfolder, color_endings);
    if (times.empty()) return stamped(files, {1 / rate_hz, ""});
    std::vector<ListedImage> images;
    for (const auto& [number, name] : files.files) {
        if (number < static_cast<double>(times.size())) {
            images.push_back({times[static_cast<std::size_t>(number)], name});
        }
    }
    return images;
}

fs::path posesOf(const fs::path& folder) {
    const fs::path beside = folder / "poses.txt";
    if (fs::exists(beside)) return beside;
    const fs::path whole = fs::weakly_canonical(folder);
    return whole.parent_path().parent_path() / "poses" / (whole.filename().string() + ".txt");
}

/** One 3x4 matrix, image_0's camera to world, for each image. */
Trajectory truthIn(const fs::path& list, const std::vector<double>& times, double rate_hz) {
    const std::string form = "12 numbers of a 3x4 matrix, camera to world";
    Trajectory truth;
    forEachLine(list, [&](Line& line) {
        Eigen::Matrix<double, 3, 4> T;
        for (int i = 0; i < 12; ++i) T(i / 4, i % 4) = line.realNumber(form);
        const Eigen::Matrix3d R = T.leftCols<3>();
        const bool is_rotation =
            (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 0.01 && R.determinant() > 0;
        if (!is_rotation) line.refuse("the first three columns are not a rotation", form);
        const std::size_t i = truth.size();
        if (!times.empty() && i >= times.size()) line.refuse("there is no such image", form);
        const double stamp_s = times.empty() ? static_cast<double>(i) / rate_hz : times[i];
        truth.push_back({stamp_s, SE3(orthonormalized(R), T.col(3))});
    });
    return truth;
}

/** A rectified camera of the benchmark is where image_0's is but for a shift. */
void readTruth(const fs::path& folder, const std::string& left, const std::vector<double>& times,
               double rate_hz, RgbdSequence& motion) {
    const fs::path list = posesOf(folder);
    if (!fs::exists(list)) return;
    motion.truth = truthIn(list, times, rate_hz);
    if (left == "image_0" || !fs::exists(folder / "calib.txt")) return;
    const SE3 T_first_left = toTheRight(readCalib(folder / "calib.txt")[left].x_m);
    for (auto& pose : motion.truth) pose.T_world_cam = pose.T_world_cam * T_first_left;
}

}  // namespace

bool isKittiFolder(const fs::path& folder) {
    const auto [left, right] = foldersIn(folder);
    return fs::is_directory(folder / left) && fs::is_directory(folder / right);
}

StereoSequence readKittiFolder(const fs::path& folder, double rate_hz,
                               const StereoCalibration* given) {
    const auto [left, right] = foldersIn(folder);
    const auto times = timesIn(folder / "times.txt");
    StereoSequence sequence;
    sequence.left = imagesIn(folder, left, times, rate_hz);
    sequence.right = imagesIn(folder, right, times, rate_hz);
    sequence.calibration = given ? *given : calibrationIn(folder, left, right);
    readTruth(folder, left, times, rate_hz, sequence.motion);
    auto& notes = sequence.motion.notes;
    notes.push_back("KITTI's layout: " + left + " is the left camera, " + right + " the right one" +
                    (sequence.motion.truth.empty() ? ", no ground truth" : ""));
    if (times.empty()) {
        notes.push_back("no times.txt: images are taken at " + shortest(rate_hz) +
                        " frames/s (--rate)");
    }
    if (left == "image_0" && fs::is_directory(folder / "image_2")) {
        notes.push_back("left out: image_2, image_3 (color)");
    }
    return sequence;
}

}  // namespace rgbd_graphslam
