#include "recording_survey.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace {

constexpr double most_beyond = 0.5;

}  // namespace

RecordingSurvey::RecordingSurvey(
    const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& beginning) {
    for (std::size_t i = 0; i < beginning.size(); i += step) {
        try {
            add(beginning[i]);
        } catch (const Error&) {
            continue;
        }
    }
}

void RecordingSurvey::add(const mrpt::obs::CObservation3DRangeScan::Ptr& observation) {
    const RgbdImage image = colorAndDepth(observation);
    depth_unit_m_ = image.depth_unit_m;
    stereo_ = !image.right.empty();
    depths_.add(image.depth);
    focal_length_px_ = CameraModel(cameraOf(*observation)).pixelsPerRadian().x();
    if (!image.color.empty()) registration_.add(image.color, image.depth);
}

double RecordingSurvey::shareBeyond(double depth_m) const {
    return depths_.shareBeyond(depth_m / depth_unit_m_);
}

double RecordingSurvey::suitableDepthMaxM() const {
    const double better_m = betterMaxDepth(depth()).value_or(default_depth_max_m);
    return std::clamp(better_m, default_depth_max_m, 100.0);
}

std::optional<SurveyWarning> RecordingSurvey::unitsWarning() const {
    if (stereo_) return std::nullopt;
    const DepthSummary summary = depth();
    // TUM's units are those of an import that was told none.
    const bool assumed = std::abs(1 / depth_unit_m_ - 5000) < 1;
    const auto units = plausibleDepthUnits(depths_, 1 / depth_unit_m_, assumed);
    if (!units && !isImplausible(summary)) return std::nullopt;
    SurveyWarning warning;
    warning.refuses = isImplausible(summary);
    warning.text = formatted("depth has a median of %.2f m with %.6g units per meter",
                             summary.median_m, 1 / depth_unit_m_);
    if (units) {
        warning.text += formatted(
            "; with depth_units = %g it would be %.2f m: import the "
            "recording again with --depth-units %g if that is right",
            *units, summary.median_m / depth_unit_m_ / *units, *units);
    } else {
        warning.text += ", which is hardly right: check depth_units";
    }
    return warning;
}

std::optional<SurveyWarning> RecordingSurvey::registrationWarning() const {
    const auto found = registration_.finding();
    if (!found) return std::nullopt;
    return SurveyWarning{toText(*found, focal_length_px_) +
                             "; import the recording again with --register camera_depth.ini",
                         true};
}

std::vector<SurveyWarning> RecordingSurvey::warnings(const FeatureOptions& features,
                                                     const MapOptions& maps) const {
    std::vector<SurveyWarning> all;
    if (const auto units = unitsWarning()) all.push_back(*units);
    if (const auto registration = registrationWarning()) all.push_back(*registration);
    const double beyond = shareBeyond(features.farthestDepthM());
    if (beyond > most_beyond) {
        all.push_back(
            {formatted("%.0f %% of the depth readings are beyond depth_max_m = %g and "
                       "are not used; FeatureOptions.depth_max_m = %g takes them",
                       100 * beyond, features.farthestDepthM(), suitableDepthMaxM())});
    }
    const double beyond_map = shareBeyond(maps.max_range_m);
    if (beyond_map > most_beyond) {
        all.push_back(
            {formatted("%.0f %% of the depth readings are beyond max_range_m = %g and "
                       "will not be in the maps; MapOptions.max_range_m = %.0f takes "
                       "three quarters of them",
                       100 * beyond_map, maps.max_range_m,
                       std::min(100.0, std::ceil(depth().upper_quartile_m)))});
    }
    return all;
}

}  // namespace rgbd_graphslam
