#include "rgbd_graphslam/evaluation/consistency.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/metrics/alignment.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

/** The truth farther from a frame's stamp on either side says nothing about it. */
constexpr double widest_gap_s = 0.1;
/** 95 % of the chi-square distribution with six degrees of freedom. */
constexpr double band_low = 1.237, band_high = 14.449;
constexpr double sigmas = 3;

std::optional<SE3> truthAt(const Trajectory& truth, double stamp_s) {
    const auto after = std::lower_bound(
        truth.begin(), truth.end(), stamp_s,
        [](const StampedPose& pose, double stamp) { return pose.stamp_s < stamp; });
    if (after == truth.end()) return std::nullopt;
    if (after->stamp_s == stamp_s) return after->T_world_cam;
    if (after == truth.begin()) return std::nullopt;
    const StampedPose& before = *(after - 1);
    if (after->stamp_s - before.stamp_s > widest_gap_s) return std::nullopt;
    const double share = (stamp_s - before.stamp_s) / (after->stamp_s - before.stamp_s);
    return interpolate(before.T_world_cam, after->T_world_cam, share);
}

struct Pair {
    const ClaimedPose* claim = nullptr;
    SE3 T_world_true;
};

/** Each pose is six points around its camera, so that a camera that stands still is aligned, too.
 */
Similarity alignmentOf(const std::vector<Pair>& pairs) {
    constexpr double lever_m = 0.5;
    Eigen::Matrix3Xd from(3, 6 * pairs.size()), to(3, 6 * pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const SE3 &claimed = pairs[k].claim->T_world_cam, &truly = pairs[k].T_world_true;
        for (int i = 0; i < 6; ++i) {
            const double lever = i < 3 ? lever_m : -lever_m;
            const Eigen::Vector3d point = lever * Eigen::Vector3d::Unit(i % 3);
            from.col(6 * k + i) = claimed * point;
            to.col(6 * k + i) = truly * point;
        }
    }
    return alignPoints(from, to);
}

void addJumps(const std::vector<Pair>& pairs, Consistency& result) {
    for (std::size_t k = 1; k < pairs.size(); ++k) {
        if (!pairs[k - 1].claim->believed || !pairs[k].claim->believed) continue;
        const SE3 moved = pairs[k - 1].claim->T_world_cam.inverse() * pairs[k].claim->T_world_cam;
        const SE3 truly = pairs[k - 1].T_world_true.inverse() * pairs[k].T_world_true;
        result.largest_jump_m = std::max(result.largest_jump_m, (moved.t - truly.t).norm());
    }
}

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

/** \return nothing where the run claims none, e.g. of a lost frame */
std::optional<ClaimedPose> claimOf(const std::vector<std::string>& cells, std::size_t first_sigma) {
    if (cells.size() < first_sigma + 6) return std::nullopt;
    ClaimedPose claim;
    claim.stamp_s = std::stod(cells[0]);
    claim.believed = cells[1] == "tracked" || cells[1] == "recovered";
    for (int i = 0; i < 6; ++i) {
        claim.sigma[i] = std::stod(cells[first_sigma + i]);
        if (!(claim.sigma[i] > 0) || !std::isfinite(claim.sigma[i])) throw std::out_of_range("");
    }
    return claim;
}

}  // namespace

Consistency evaluateConsistency(const std::vector<ClaimedPose>& poses, const Trajectory& truth,
                                const TruthAccuracy& accuracy) {
    std::vector<Pair> pairs, believed;
    for (const ClaimedPose& claim : poses) {
        const auto T_world_true = truthAt(truth, claim.stamp_s);
        if (!T_world_true) continue;
        pairs.push_back({&claim, *T_world_true});
        if (claim.believed) believed.push_back(pairs.back());
    }
    if (believed.size() < 2) {
        throw Error("fewer than two tracked frames have a true pose",
                    "check that run and truth belong together");
    }
    Consistency result;
    result.poses = pairs.size();
    result.believed = believed.size();
    const Similarity alignment = alignmentOf(believed);
    for (const Pair& pair : believed) {
        const SE3 T_cam_true = (alignment * pair.claim->T_world_cam).inverse() * pair.T_world_true;
        Vector6d error;
        error << T_cam_true.t, rotationLog(T_cam_true.R);
        Vector6d variance = pair.claim->sigma.cwiseAbs2();
        variance.head<3>().array() += accuracy.sigma_m * accuracy.sigma_m;
        variance.tail<3>().array() += accuracy.sigma_rad * accuracy.sigma_rad;
        const Vector6d normalized = error.cwiseQuotient(variance.cwiseSqrt());
        const double sum = normalized.squaredNorm();
        const double share = 1.0 / static_cast<double>(believed.size());
        result.nees += sum * share;
        result.nees_in_band += (sum > band_low && sum < band_high) * share;
        result.within_3_sigma += (normalized.cwiseAbs().maxCoeff() <= sigmas) * share;
        result.worst_m = std::max(result.worst_m, error.head<3>().norm());
        result.worst_rad = std::max(result.worst_rad, error.tail<3>().norm());
    }
    addJumps(pairs, result);
    return result;
}

std::vector<ClaimedPose> readClaimedPoses(const std::string& run_folder) {
    const fs::path folder(run_folder);
    const std::string path = (folder / "frames.csv").string();
    std::ifstream in(path);
    std::string line;
    if (!std::getline(in, line)) throw Error("cannot read '" + path + "'", "give a run's folder");
    const auto titles = cellsOf(line);
    const auto first = std::find(titles.begin(), titles.end(), "std_x_m");
    if (first == titles.end()) {
        throw Error("'" + path + "' tells no standard deviations", "run rgbd-slam again");
    }
    std::map<long long, SE3> poses;
    const auto microseconds = [](double stamp_s) { return std::llround(stamp_s * 1e6); };
    for (const StampedPose& pose : readTumPoses((folder / "trajectory.txt").string())) {
        poses[microseconds(pose.stamp_s)] = pose.T_world_cam;
    }
    std::vector<ClaimedPose> claims;
    for (int number = 2; std::getline(in, line); ++number) {
        try {
            auto claim = claimOf(cellsOf(line), static_cast<std::size_t>(first - titles.begin()));
            if (!claim) continue;
            const auto pose = poses.find(microseconds(claim->stamp_s));
            if (pose == poses.end()) continue;
            claim->T_world_cam = pose->second;
            claims.push_back(*claim);
        } catch (const std::logic_error&) {
            throw Error(path + ":" + std::to_string(number) + " is no line of a run",
                        "run rgbd-slam again");
        }
    }
    return claims;
}

Report reportOf(const std::string& run, const Consistency& consistency) {
    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    return {run,
            {{"poses", count(consistency.poses), "poses", 0},
             {"tracked_poses", count(consistency.believed), "poses", 0},
             {"nees", consistency.nees, "", 3},
             {"nees_in_95_percent_band", 100 * consistency.nees_in_band, "%", 2},
             {"within_3_sigma", 100 * consistency.within_3_sigma, "%", 2},
             {"worst_translational_error", consistency.worst_m, "m"},
             {"worst_rotational_error", consistency.worst_rad, "rad"},
             {"largest_jump", consistency.largest_jump_m, "m"}}};
}

}  // namespace rgbd_graphslam
