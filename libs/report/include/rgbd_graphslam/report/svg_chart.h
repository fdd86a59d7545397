/** Charts as SVG elements that stand in an HTML page, or in a file of their own. */
#pragma once
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

namespace rgbd_graphslam {

/** How charts look, in CSS: plain enough for programs that are no browser. */
extern const char* const chart_style;

/** A line with a name. Its class gives color and dashes. */
struct ChartLine {
    std::string name;
    std::string css_class;
    std::vector<Eigen::Vector2d> points;
};

/** Ground plan: x to the right and y up in meters, both with one scale; a grid tells the size.
 * Lines of one point or none are left out. */
std::string planChart(const std::vector<ChartLine>& lines);

/** Values over seconds; the value axis begins at 0.
 *  \param marked spans (s) to shade, of any length */
std::string timeChart(const std::vector<ChartLine>& lines, const std::string& quantity,
                      const std::vector<std::pair<double, double>>& marked = {});

/** A chart as a file for browsers and picture viewers. \param chart of this header's functions */
std::string svgFile(const std::string& chart);

/** At most `most` points (at least 4) that keep the extremes of y: the lowest and the highest of
 *  equally many neighbors each, in order. */
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, std::size_t most);

/** The multiple of 1, 2 or 5 times a power of ten that divides `range` into about `parts`. */
double roundStep(double range, int parts);

}  // namespace rgbd_graphslam
