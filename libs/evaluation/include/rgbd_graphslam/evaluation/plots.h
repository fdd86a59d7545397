/** The pictures of an evaluation. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/metrics/ate.h"
#include "rgbd_graphslam/metrics/rpe.h"

namespace rgbd_graphslam {

/** An estimate under the name it has in a legend, with what was found about it. */
struct EvaluatedAte {
    std::string label;
    Trajectory estimate;
    AteResult result;
};
/** An estimate's relative errors with its name in the legend. */
struct EvaluatedRpe {
    std::string label;
    RpeResult result;
};

/** The plane of the truth's frame that is drawn. */
enum class PlotPlane { XY, XZ, YZ };

/** Truth and aligned estimates projected on a plane of the truth's frame. With one estimate a line
 *  joins each pose and its truth, as in the TUM tools' picture.
 *  \param path a .png or .svg; errors as of Gnuplot */
void plotTrajectories(const Trajectory& truth, const std::vector<EvaluatedAte>& estimates,
                      PlotPlane plane, const std::string& path);

/** How the errors of one estimate lie over time. */
struct ErrorSeries {
    std::string label;
    std::vector<double> stamps_s, errors;  // of equal length, in order of time
};
/** Errors of one kind that share an axis. */
struct ErrorPanel {
    std::string quantity, unit;
    enum class Style { Lines, Points } style = Style::Lines;
    std::vector<ErrorSeries> series;
};

std::vector<ErrorPanel> errorPanels(const std::vector<EvaluatedAte>& estimates);
/** Translation and rotation; over time at the first pose of each pair.
 *  \param style lines suit pairs of a fixed delta, points pairs drawn at random */
std::vector<ErrorPanel> errorPanels(const std::vector<EvaluatedRpe>& estimates,
                                    ErrorPanel::Style style);

/** The panels over each other, over the seconds since the first stamp. */
void plotErrorsOverTime(const std::vector<ErrorPanel>& panels, const std::string& path);

/** Per panel the share of poses below each error; with one series its histogram too. */
void plotErrorDistribution(const std::vector<ErrorPanel>& panels, const std::string& path);

}  // namespace rgbd_graphslam
