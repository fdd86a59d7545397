#include "rgbd_graphslam/metrics/ate.h"

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/associate.h"
#include "rgbd_graphslam/metrics/stamps.h"

namespace rgbd_graphslam {
namespace {

/** Matched positions, column by column. */
struct Matches {
    std::vector<double> stamps_s;
    Eigen::Matrix3Xd estimate_m, truth_m;
};

[[noreturn]] void refuse(const Trajectory& estimate, const Trajectory& truth, std::size_t matches,
                         double max_difference_s) {
    throw Error(std::to_string(matches) + " poses match within " + secondsText(max_difference_s) +
                    ": " + spansOf(estimate, truth),
                "check that the files belong together, give --offset or a larger --max-difference");
}

Matches match(const Trajectory& estimate, const Trajectory& truth, const AteOptions& options) {
    const auto pairs =
        associate(stampsOf(truth), stampsOf(estimate), options.max_difference_s, options.offset_s);
    if (pairs.size() < 2) refuse(estimate, truth, pairs.size(), options.max_difference_s);
    Matches matches{{}, Eigen::Matrix3Xd(3, pairs.size()), Eigen::Matrix3Xd(3, pairs.size())};
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto& [i, j] = pairs[k];
        matches.stamps_s.push_back(estimate[j].stamp_s + options.offset_s);
        matches.truth_m.col(k) = truth[i].T_world_cam.t;
        matches.estimate_m.col(k) = estimate[j].T_world_cam.t;
    }
    return matches;
}

Similarity align(const Matches& matches, double scale) {
    Similarity alignment = alignPoints(scale * matches.estimate_m, matches.truth_m);
    alignment.scale = scale;
    return alignment;
}

std::optional<double> fittedScale(const Matches& matches) {
    try {
        return alignPoints(matches.estimate_m, matches.truth_m, AlignmentScale::Fitted).scale;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

AteResult evaluateAte(const Trajectory& estimate, const Trajectory& truth,
                      const AteOptions& options) {
    checkScale(options.scale);
    const auto poses = withUniqueStamps(estimate);
    const auto matches = match(poses, withUniqueStamps(truth), options);
    AteResult result;
    result.estimate_poses = poses.size();
    result.fitted_scale = fittedScale(matches);
    result.alignment =
        options.fit_scale ? alignPoints(matches.estimate_m, matches.truth_m, AlignmentScale::Fitted)
                          : align(matches, options.scale);
    std::vector<double> distances_m;
    for (std::size_t k = 0; k < matches.stamps_s.size(); ++k) {
        result.pairs.push_back({matches.stamps_s[k],
                                result.alignment * Eigen::Vector3d(matches.estimate_m.col(k)),
                                matches.truth_m.col(k)});
        distances_m.push_back(result.pairs.back().error_m().norm());
    }
    result.translation_m = statisticsOf(distances_m);
    return result;
}

}  // namespace rgbd_graphslam
