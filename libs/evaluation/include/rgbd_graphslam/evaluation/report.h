/** Evaluations as text for people, programs and papers. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/evaluation/map_accuracy.h"
#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/metrics/drift.h"
#include "rgbd_graphslam/metrics/rpe.h"

namespace rgbd_graphslam {

/** One number, named as the TUM tools name it, e.g. "absolute_translational_error.rmse". */
struct Figure {
    std::string name;
    double value = 0;
    std::string unit;
    int decimals = 6;
};

/** What was found about one estimate or map. */
struct Report {
    std::string name;
    std::vector<Figure> figures;
};

/** Whether errors are listed along each axis, too. */
enum class PerAxis { No, Yes };

/** Counts, figures of the distance, fitted scale; with PerAxis::Yes the figures of the absolute
 *  error along x, y, z of the truth's frame too. */
Report reportOf(const std::string& estimate, const AteResult& result, PerAxis per_axis);

/** Counts, figures of the translational and rotational error; with PerAxis::Yes those of the
 *  absolute components in the frame of the first pose of each pair too. */
Report reportOf(const std::string& estimate, const RpeResult& result, PerAxis per_axis);

/** Counts, mean and further figures of the errors per length, for all lengths and for each. */
Report reportOf(const std::string& estimate, const DriftResult& result);

/** Distance of the map's points and completeness. */
Report reportOf(const std::string& map, const MapAccuracy& accuracy);

/** The forms of a table. */
enum class ReportFormat { Text, Csv, Json, Latex };

/** All reports in one table. Text: "name value unit" lines as the TUM tools print them, one column
 *  an estimate. CSV: a row an estimate. JSON: an array of objects. LaTeX: a tabular of the booktabs
 *  package, a column an estimate.
 *  \param reports not empty, with the same figures in the same order */
std::string format(const std::vector<Report>& reports, ReportFormat format);

}  // namespace rgbd_graphslam
