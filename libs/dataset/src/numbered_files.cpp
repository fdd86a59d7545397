#include "numbered_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

bool isDigit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool endsWith(const std::string& text, const std::string& ending) {
    return text.size() > ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/** \param stem a file's name without its ending */
double stampOf(const std::string& stem, const std::string& path, double rate_hz) {
    char* end = nullptr;
    const double seconds = std::strtod(stem.c_str(), &end);
    if (!*end && isDigit(stem.front()) && stem.find('.') != std::string::npos) return seconds;
    const auto last = std::find_if(stem.rbegin(), stem.rend(), isDigit);
    if (last == stem.rend()) {
        throw Error("the name of '" + path + "' has no number",
                    "images must be named by their number or stamp");
    }
    const auto first = std::find_if_not(last, stem.rend(), isDigit);
    return std::strtod(std::string(first.base(), last.base()).c_str(), nullptr) / rate_hz;
}

/** \return false for a matrix with numbers that are not finite */
bool readPose(const std::string& path, SE3& T_world_cam) {
    std::ifstream in(path);
    double m[16];
    for (double& value : m) {
        std::string word;
        in >> word;
        char* end = nullptr;
        value = std::strtod(word.c_str(), &end);
        if (word.empty() || *end) throw Error("'" + path + "' is no 4x4 matrix", "fetch it again");
    }
    if (!std::all_of(m, m + 16, [](double value) { return std::isfinite(value); })) return false;
    const Eigen::Matrix3d R =
        (Eigen::Matrix3d() << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]).finished();
    if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > 0.01 || R.determinant() < 0) {
        throw Error("'" + path + "' is no pose, its first columns are no rotation",
                    "a pose is a 4x4 matrix, camera to world");
    }
    T_world_cam = {orthonormalised(R), {m[3], m[7], m[11]}};
    return true;
}

}  // namespace

std::vector<ListedImage> numberedFiles(const std::string& folder, const std::string& subfolder,
                                       const std::vector<std::string>& endings, double rate_hz) {
    std::vector<ListedImage> files;
    const fs::path root(folder);
    for (const auto& entry : fs::directory_iterator(root / subfolder)) {
        const std::string name = entry.path().filename();
        for (const auto& ending : endings) {
            if (!endsWith(name, ending)) continue;
            const std::string stem = name.substr(0, name.size() - ending.size());
            files.push_back({stampOf(stem, entry.path(), rate_hz),
                             subfolder.empty() ? name : subfolder + "/" + name});
        }
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
        return a.stamp_s < b.stamp_s || (a.stamp_s == b.stamp_s && a.file < b.file);
    });
    return files;
}

Trajectory readPoseFiles(const std::string& folder, const std::vector<ListedImage>& files) {
    Trajectory poses;
    for (const auto& [stamp_s, file] : files) {
        SE3 T_world_cam;
        if (readPose(fs::path(folder) / file, T_world_cam)) poses.push_back({stamp_s, T_world_cam});
    }
    return poses;
}

}  // namespace rgbd_graphslam
