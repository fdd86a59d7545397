#include "rgbd_graphslam/geometry/trajectory.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/input_file.h"

namespace rgbd_graphslam {
namespace {

[[noreturn]] void refuse(const std::string& path, int line, const std::string& why) {
    throw Error(path + ":" + std::to_string(line) + ": " + why,
                "each line must be 'stamp tx ty tz qx qy qz qw'");
}

std::vector<double> numbersOf(std::string text, const std::string& path, int line) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == ',' || c == '\t' || c == '\r'; }, ' ');
    std::istringstream words(text);
    std::vector<double> numbers;
    for (std::string word; words >> word;) {
        char* end = nullptr;
        numbers.push_back(std::strtod(word.c_str(), &end));
        if (*end) refuse(path, line, "'" + word + "' is not a number");
    }
    return numbers;
}

}  // namespace

std::optional<SE3> poseAt(const Trajectory& trajectory, double stamp_s, double longest_gap_s) {
    const auto after =
        std::lower_bound(trajectory.begin(), trajectory.end(), stamp_s,
                         [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
    if (after == trajectory.end()) return std::nullopt;
    if (after->stamp_s == stamp_s) return after->T_world_cam;
    if (after == trajectory.begin()) return std::nullopt;
    const auto before = after - 1;
    const double gap_s = after->stamp_s - before->stamp_s;
    if (gap_s > longest_gap_s) return std::nullopt;
    return interpolate(before->T_world_cam, after->T_world_cam,
                       (stamp_s - before->stamp_s) / gap_s);
}

Trajectory readTumPoses(const std::string& path) {
    refuseFolder(path, "a trajectory");
    std::ifstream in(path);
    if (!in) throw Error("cannot read the trajectory '" + path + "'", "check the name");
    Trajectory trajectory;
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        const auto n = numbersOf(text.substr(0, text.find('#')), path, line);
        if (n.empty()) continue;
        if (n.size() != 8) refuse(path, line, std::to_string(n.size()) + " numbers");
        if (!std::all_of(n.begin(), n.end(), [](double x) { return std::isfinite(x); })) continue;
        const Eigen::Quaterniond q(n[7], n[4], n[5], n[6]);
        if (q.norm() < 0.5) refuse(path, line, "the quaternion is not of unit length");
        trajectory.push_back({n[0], SE3(q, {n[1], n[2], n[3]})});
    }
    if (trajectory.empty()) throw Error("no pose in '" + path + "'", "give a TUM trajectory");
    return trajectory;
}

bool anyBetween(const std::vector<double>& stamps_s, double from_s, double to_s) {
    const auto next = std::upper_bound(stamps_s.begin(), stamps_s.end(), from_s);
    return next != stamps_s.end() && *next < to_s;
}

std::vector<Trajectory> pieces(const Trajectory& poses, const std::vector<std::size_t>& lengths) {
    std::vector<Trajectory> parts;
    auto begin = poses.begin();
    for (const std::size_t length : lengths) {
        const auto left = static_cast<std::size_t>(poses.end() - begin);
        const auto end = begin + static_cast<std::ptrdiff_t>(std::min(length, left));
        parts.emplace_back(begin, end);
        begin = end;
    }
    parts.emplace_back(begin, poses.end());
    return parts;
}

Trajectory readTumTrajectory(const std::string& path) {
    Trajectory trajectory = readTumPoses(path);
    std::stable_sort(trajectory.begin(), trajectory.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
    return trajectory;
}

std::string toTumText(const Trajectory& trajectory) {
    std::string text = "# timestamp tx ty tz qx qy qz qw\n";
    char line[256];
    for (const auto& [stamp, T] : trajectory) {
        const Eigen::Quaterniond q = T.quaternion();
        std::snprintf(line, sizeof(line), "%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", stamp,
                      T.t.x(), T.t.y(), T.t.z(), q.x(), q.y(), q.z(), q.w());
        text += line;
    }
    return text;
}

}  // namespace rgbd_graphslam
