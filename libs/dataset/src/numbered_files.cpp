#include "numbered_files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "stamp_unit.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

bool isDigit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool endsWith(const std::string& text, const std::string& ending) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
    };
    return text.size() > ending.size() &&
           std::equal(ending.begin(), ending.end(),
                      text.end() - static_cast<std::ptrdiff_t>(ending.size()),
                      [&](char b, char a) { return same(a, b); });
}

/** The last number in a file's name: digits, with decimals behind a point where there are any.
 *  \param stem the name without its ending */
std::string lastNumberIn(const std::string& stem, const std::string& path) {
    const auto last = std::find_if(stem.rbegin(), stem.rend(), isDigit);
    if (last == stem.rend()) {
        throw Error("the name of '" + path + "' has no number",
                    "images must be named by their number or stamp");
    }
    auto first = std::find_if_not(last, stem.rend(), isDigit);
    if (first != stem.rend() && *first == '.') {
        const auto whole = std::find_if_not(first + 1, stem.rend(), isDigit);
        if (whole != first + 1) first = whole;
    }
    return std::string(first.base(), last.base());
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
        if (word.empty() || *end) throw Error("'" + path + "' is not a 4x4 matrix", "fetch it again");
    }
    if (!std::all_of(m, m + 16, [](double value) { return std::isfinite(value); })) return false;
    const Eigen::Matrix3d R =
        (Eigen::Matrix3d() << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]).finished();
    if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > 0.01 || R.determinant() < 0) {
        throw Error("'" + path + "' is not a pose, its first columns are not a rotation",
                    "a pose is a 4x4 matrix, camera to world");
    }
    T_world_cam = {orthonormalized(R), {m[3], m[7], m[11]}};
    return true;
}

}  // namespace

NumberedFiles filesByNumber(const std::string& folder, const std::string& subfolder,
                            const std::vector<std::string>& endings) {
    NumberedFiles found;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / subfolder)) {
        const std::string name = entry.path().filename();
        for (const auto& ending : endings) {
            if (!endsWith(name, ending)) continue;
            const std::string stem = name.substr(0, name.size() - ending.size());
            const std::string number = lastNumberIn(stem, entry.path());
            found.with_decimals |= number.find('.') != std::string::npos;
            found.padded |= number.size() > 1 && number[0] == '0' && number[1] != '.';
            found.files.push_back({std::strtod(number.c_str(), nullptr),
                                   subfolder.empty() ? name : subfolder + "/" + name});
            break;
        }
    }
    std::sort(found.files.begin(), found.files.end(), [](const auto& a, const auto& b) {
        return a.number < b.number || (a.number == b.number && a.name < b.name);
    });
    return found;
}

NumberMeaning meaningOf(const NumberedFiles& files, double rate_hz) {
    constexpr double most_frames = 1e7;
    std::vector<double> numbers;
    for (const auto& file : files.files) numbers.push_back(file.number);
    const bool small = numbers.empty() || numbers.back() < most_frames;
    if (!files.with_decimals && (areFrameNumbers(numbers) || (files.padded && small))) {
        return {1 / rate_hz,
                "images are numbered: taken at " + shortest(rate_hz) + " frames/s (--rate)"};
    }
    const StampUnit unit = unitOfStamps(numbers);
    return {unit.seconds, std::string("file names are taken as stamps in ") + unit.name};
}

std::vector<ListedImage> stamped(const NumberedFiles& files, const NumberMeaning& meaning) {
    std::vector<ListedImage> images;
    for (const auto& [number, name] : files.files) {
        images.push_back({number * meaning.seconds, name});
    }
    return images;
}

std::vector<ListedImage> numberedFiles(const std::string& folder, const std::string& subfolder,
                                       const std::vector<std::string>& endings, double rate_hz) {
    return stamped(filesByNumber(folder, subfolder, endings), {1 / rate_hz, ""});
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
