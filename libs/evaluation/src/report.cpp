#include "rgbd_graphslam/evaluation/report.h"

#include <cmath>

#include "rgbd_graphslam/core/formatted.h"
#include "tables.h"

namespace rgbd_graphslam {
namespace {

constexpr double degrees_per_radian = 180 / M_PI;

void addStatistics(const std::string& name, const std::string& unit, const Statistics& s,
                   std::vector<Figure>& figures) {
    figures.push_back({name + ".rmse", s.rmse, unit});
    figures.push_back({name + ".mean", s.mean, unit});
    figures.push_back({name + ".median", s.median, unit});
    figures.push_back({name + ".std", s.std, unit});
    figures.push_back({name + ".min", s.min, unit});
    figures.push_back({name + ".max", s.max, unit});
}

/** \param component of one error, by axis */
template <class Errors, class Component>
void addAxes(const std::string& name, const std::string& unit, const Errors& errors,
             Component component, std::vector<Figure>& figures) {
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        values.reserve(errors.size());
        for (const auto& error : errors) values.push_back(std::abs(component(error)[axis]));
        addStatistics(name + "." + "xyz"[axis], unit, statisticsOf(values), figures);
    }
}

void addCounts(std::size_t pairs, std::size_t matched, std::size_t total,
               std::vector<Figure>& figures) {
    figures.push_back({"compared_pose_pairs", static_cast<double>(pairs), "pairs", 0});
    figures.push_back({"matched_poses", static_cast<double>(matched), "poses", 0});
    figures.push_back({"total_poses", static_cast<double>(total), "poses", 0});
}

}  // namespace

Report reportOf(const std::string& estimate, const AteResult& result, PerAxis per_axis) {
    Report report{estimate, {}};
    addCounts(result.pairs.size(), result.pairs.size(), result.estimate_poses, report.figures);
    const std::string name = "absolute_translational_error";
    addStatistics(name, "m", result.translation_m, report.figures);
    if (per_axis == PerAxis::Yes) {
        addAxes(
            name, "m", result.pairs, [](const AtePair& pair) { return pair.error_m(); },
            report.figures);
    }
    const double scale = result.fitted_scale.value_or(std::nan(""));
    report.figures.push_back({"scale_that_would_fit", scale, ""});
    return report;
}

Report reportOf(const std::string& estimate, const RpeResult& result, PerAxis per_axis) {
    Report report{estimate, {}};
    addCounts(result.errors.size(), result.matched_poses, result.estimate_poses, report.figures);
    const std::string translational = "translational_error", rotational = "rotational_error";
    addStatistics(translational, "m", result.translation_m, report.figures);
    addStatistics(rotational, "deg", result.rotation_deg, report.figures);
    if (per_axis == PerAxis::Yes) {
        addAxes(
            translational, "m", result.errors,
            [](const RelativeError& error) { return error.translation_m; }, report.figures);
        addAxes(
            rotational, "deg", result.errors,
            [](const RelativeError& error) -> Eigen::Vector3d {
                return error.rotation_rad * degrees_per_radian;
            },
            report.figures);
    }
    return report;
}

Report reportOf(const std::string& estimate, const DriftResult& result) {
    Report report{estimate, {}};
    addCounts(result.errors.size(), result.matched_poses, result.estimate_poses, report.figures);
    addStatistics("translational_drift", "%", result.translation_percent, report.figures);
    addStatistics("rotational_drift", "deg/m", result.rotation_deg_m, report.figures);
    report.figures.push_back({"scale", result.scale, ""});
    for (const double length_m : result.lengths_m) {
        std::vector<double> translation;
        for (const DriftError& error : result.errors) {
            if (error.length_m == length_m) translation.push_back(error.translation_percent);
        }
        report.figures.push_back({formatted("translational_drift.%.4g_m.mean", length_m),
                                  statisticsOf(translation).mean, "%"});
    }
    return report;
}

Report reportOf(const std::string& map, const MapAccuracy& accuracy) {
    Report report{map, {}};
    const auto count = [&](const std::string& name, std::size_t value) {
        report.figures.push_back({name, static_cast<double>(value), "points", 0});
    };
    count("map_points", accuracy.distance_m.count);
    count("surface_samples", accuracy.surface_samples);
    const std::string distance = "distance_to_surface";
    addStatistics(distance, "m", accuracy.distance_m, report.figures);
    report.figures.push_back({distance + ".95_percent", accuracy.distance_95_m, "m"});
    report.figures.push_back({"points_beyond", 100 * accuracy.beyond, "%", 3});
    if (accuracy.on_movers_ways) {
        report.figures.push_back({"points_on_movers_ways", 100 * *accuracy.on_movers_ways, "%", 3});
    }
    report.figures.push_back({"completeness", 100 * accuracy.completeness, "%", 2});
    if (accuracy.completeness_of_seen) {
        report.figures.push_back(
            {"completeness_of_seen", 100 * *accuracy.completeness_of_seen, "%", 2});
    }
    return report;
}

std::string format(const std::vector<Report>& reports, ReportFormat format) {
    switch (format) {
        case ReportFormat::Csv:
            return csvTable(reports);
        case ReportFormat::Json:
            return jsonTable(reports);
        case ReportFormat::Latex:
            return latexTable(reports);
        case ReportFormat::Text:
            break;
    }
    return textTable(reports);
}

}  // namespace rgbd_graphslam
