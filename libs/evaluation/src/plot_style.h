/** What the pictures have in common. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/evaluation/gnuplot.h"

namespace rgbd_graphslam {

/** Axes, grid and legend. */
void setStyle(Gnuplot& plot);

/** Distinct to the color-blind as well: Okabe and Ito, "Color universal design", 2008. */
std::string colorOf(std::size_t series);

/** Parts of a plot command: named data drawn in one way. */
std::string lineOf(const std::string& data, const std::string& color, const std::string& label,
                   double width = 1.3);
std::string pointsOf(const std::string& data, const std::string& color, const std::string& label);

/** The plot command of several parts. */
std::string plotOf(const std::vector<std::string>& parts);

/** Rows, one a stamp, with an empty row wherever the pause between two stamps is so long that a
 *  line across would mislead.
 *  \param rows as many as stamps */
Gnuplot::Rows interruptedAtGaps(const std::vector<double>& stamps_s, Gnuplot::Rows rows);

}  // namespace rgbd_graphslam
