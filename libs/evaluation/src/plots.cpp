#include "rgbd_graphslam/evaluation/plots.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/evaluation/gnuplot.h"
#include "stamps.h"

namespace rgbd_graphslam {
namespace {

constexpr int page_width = 640;
constexpr const char* truth_color = "black";
constexpr const char* difference_color = "#d62728";

/** Distinct to the colour-blind as well: Okabe and Ito, "Color universal design", 2008. */
std::string colorOf(std::size_t series) {
    static const std::vector<std::string> colors = {"#0060c0", "#e69f00", "#009e73", "#cc79a7",
                                                    "#56b4e9", "#d55e00", "#7f7f7f"};
    return colors[series % colors.size()];
}

void setStyle(Gnuplot& plot) {
    plot.command("set border 3 linecolor '#404040'");
    plot.command("set tics nomirror out textcolor '#202020'");
    plot.command("set grid linetype 1 linecolor '#e4e4e4' linewidth 0.6");
    plot.command("set key above center horizontal Left reverse samplen 2");
}

std::string titled(const std::string& label) {
    return " title " + Gnuplot::quoted(label);
}

std::string line(const std::string& data, const std::string& color, const std::string& label) {
    return data + " with lines linewidth 1.3 linecolor '" + color + "'" + titled(label);
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text = "plot ";
    for (std::size_t k = 0; k < parts.size(); ++k) text += (k ? ", " : "") + parts[k];
    return text;
}

/** A longer pause than this between two poses is shown as a gap. */
double longestPause(const std::vector<double>& stamps_s) {
    std::vector<double> pauses;
    for (std::size_t k = 1; k < stamps_s.size(); ++k) {
        pauses.push_back(stamps_s[k] - stamps_s[k - 1]);
    }
    return pauses.empty() ? 0 : std::max(0.5, 10 * percentileOf(pauses, 0.5));
}

/** One row a stamp, with an empty row at each gap. \param row_of index to numbers */
template <class Row>
Gnuplot::Rows rowsWithGaps(const std::vector<double>& stamps_s, Row row_of) {
    const double longest_s = longestPause(stamps_s);
    Gnuplot::Rows rows;
    for (std::size_t k = 0; k < stamps_s.size(); ++k) {
        if (k > 0 && stamps_s[k] - stamps_s[k - 1] > longest_s) rows.emplace_back();
        rows.push_back(row_of(k));
    }
    return rows;
}

struct Projection {
    int across, up;  // axes of the truth's frame

    std::vector<double> operator()(const Eigen::Vector3d& p) const { return {p[across], p[up]}; }
};

Projection projectionOn(PlotPlane plane) {
    switch (plane) {
        case PlotPlane::XZ:
            return {0, 2};
        case PlotPlane::YZ:
            return {1, 2};
        case PlotPlane::XY:
            break;
    }
    return {0, 1};
}

Gnuplot::Rows pathRows(const Trajectory& path, const Similarity& alignment, Projection project) {
    return rowsWithGaps(stampsOf(path),
                        [&](std::size_t k) { return project(alignment * path[k].T_world_cam.t); });
}

Gnuplot::Rows differenceRows(const AteResult& result, Projection project) {
    Gnuplot::Rows rows;
    for (const auto& pair : result.pairs) {
        rows.push_back(project(pair.truth_m));
        rows.push_back(project(pair.aligned_m));
        rows.emplace_back();
    }
    return rows;
}

double firstStamp(const ErrorPanel& panel) {
    double first = INFINITY;
    for (const auto& series : panel.series) {
        if (!series.stamps_s.empty()) first = std::min(first, series.stamps_s.front());
    }
    return first;
}

std::string axisLabel(const ErrorPanel& panel) {
    return Gnuplot::quoted(panel.quantity + " (" + panel.unit + ")");
}

void plotPanelOverTime(Gnuplot& plot, const ErrorPanel& panel) {
    const double start_s = firstStamp(panel);
    std::vector<std::string> parts;
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const auto& [label, stamps_s, errors] = panel.series[s];
        const auto rows = rowsWithGaps(stamps_s, [&, &times = stamps_s, &values = errors](auto k) {
            return std::vector<double>{times[k] - start_s, values[k]};
        });
        const std::string data = plot.data(rows);
        const bool points = panel.style == ErrorPanel::Style::Points;
        parts.push_back(points ? data + " with points pointtype 7 pointsize 0.15 linecolor '" +
                                     colorOf(s) + "'" + titled(label)
                               : line(data, colorOf(s), label));
    }
    plot.command("set xlabel 'time (s)'");
    plot.command("set ylabel " + axisLabel(panel));
    plot.command(joined(parts));
}

/** Error against the share of errors that are not larger, in percent. */
Gnuplot::Rows cumulativeRows(std::vector<double> errors) {
    std::sort(errors.begin(), errors.end());
    Gnuplot::Rows rows{{0, 0}};
    for (std::size_t k = 0; k < errors.size(); ++k) {
        rows.push_back({errors[k], 100.0 * (k + 1) / errors.size()});
    }
    return rows;
}

/** Centre and share in percent of bins between 0 and the largest error. */
Gnuplot::Rows histogramRows(const std::vector<double>& errors, double bin_width) {
    std::vector<double> shares;
    for (const double error : errors) {
        const auto bin = static_cast<std::size_t>(error / bin_width);
        if (bin >= shares.size()) shares.resize(bin + 1, 0);
        shares[bin] += 100.0 / errors.size();
    }
    Gnuplot::Rows rows;
    for (std::size_t bin = 0; bin < shares.size(); ++bin) {
        rows.push_back({(bin + 0.5) * bin_width, shares[bin]});
    }
    return rows;
}

/** Rule of Freedman and Diaconis, "On the histogram as a density estimator", 1981. */
double binWidth(const std::vector<double>& errors) {
    const double spread = percentileOf(errors, 0.75) - percentileOf(errors, 0.25);
    const double width = 2 * spread / std::cbrt(errors.size());
    const double largest = *std::max_element(errors.begin(), errors.end());
    return std::max({width, largest / 200, 1e-12});
}

void plotPanelDistribution(Gnuplot& plot, const ErrorPanel& panel) {
    std::vector<std::string> parts;
    plot.command("set xlabel " + axisLabel(panel));
    plot.command("set ylabel 'share of poses below (%)'");
    plot.command("set yrange [0:100]\nset xrange [0:*]");
    if (panel.series.size() == 1) {
        const auto& errors = panel.series.front().errors;
        plot.command("set y2label 'share of poses in a bin (%)'\nset y2tics\nset y2range [0:*]");
        plot.command("set border 11");
        const double width = binWidth(errors);
        plot.command("set boxwidth " + std::to_string(width));
        parts.push_back(plot.data(histogramRows(errors, width)) +
                        " axes x1y2 with boxes fillstyle solid 0.25 noborder linecolor '" +
                        colorOf(0) + "' title 'in a bin'");
    }
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const auto& [label, stamps_s, errors] = panel.series[s];
        parts.push_back(line(plot.data(cumulativeRows(errors)), colorOf(s), label));
    }
    plot.command(joined(parts));
}

template <class PlotPanel>
void plotPanels(const std::vector<ErrorPanel>& panels, const std::string& path,
                PlotPanel plot_panel) {
    Gnuplot plot(path, page_width, 300 * panels.size());
    setStyle(plot);
    plot.command("set multiplot layout " + std::to_string(panels.size()) + ",1");
    for (const auto& panel : panels) plot_panel(plot, panel);
    plot.command("unset multiplot");
    plot.draw();
}

/** \param value_of error to number */
template <class Value>
ErrorSeries seriesOverTime(const std::string& label, std::vector<RelativeError> errors,
                           Value value_of) {
    std::stable_sort(errors.begin(), errors.end(),
                     [](const auto& a, const auto& b) { return a.from_s < b.from_s; });
    ErrorSeries series{label, {}, {}};
    for (const auto& error : errors) {
        series.stamps_s.push_back(error.from_s);
        series.errors.push_back(value_of(error));
    }
    return series;
}

}  // namespace

void plotTrajectories(const Trajectory& truth, const std::vector<EvaluatedAte>& estimates,
                      PlotPlane plane, const std::string& path) {
    Gnuplot plot(path, page_width, 560);
    setStyle(plot);
    const Projection project = projectionOn(plane);
    const std::string axes = "xyz";
    plot.command("set size ratio -1");
    plot.command(std::string("set xlabel '") + axes[project.across] + " (m)'");
    plot.command(std::string("set ylabel '") + axes[project.up] + " (m)'");
    std::vector<std::string> parts;
    if (estimates.size() == 1) {
        parts.push_back(plot.data(differenceRows(estimates.front().result, project)) +
                        " with lines linewidth 0.7 linecolor '" + difference_color +
                        "' title 'difference'");
    }
    parts.push_back(line(plot.data(pathRows(truth, {}, project)), truth_color, "truth"));
    for (std::size_t s = 0; s < estimates.size(); ++s) {
        const auto& [label, estimate, result] = estimates[s];
        parts.push_back(
            line(plot.data(pathRows(estimate, result.alignment, project)), colorOf(s), label));
    }
    plot.command(joined(parts));
    plot.draw();
}

std::vector<ErrorPanel> errorPanels(const std::vector<EvaluatedAte>& estimates) {
    ErrorPanel panel{"absolute translational error", "m", ErrorPanel::Style::Lines, {}};
    for (const auto& [label, estimate, result] : estimates) {
        ErrorSeries series{label, {}, {}};
        for (const auto& pair : result.pairs) {
            series.stamps_s.push_back(pair.stamp_s);
            series.errors.push_back(pair.error_m().norm());
        }
        panel.series.push_back(series);
    }
    return {panel};
}

std::vector<ErrorPanel> errorPanels(const std::vector<EvaluatedRpe>& estimates,
                                    ErrorPanel::Style style) {
    ErrorPanel translation{"relative translational error", "m", style, {}};
    ErrorPanel rotation{"relative rotational error", "deg", style, {}};
    for (const auto& [label, result] : estimates) {
        translation.series.push_back(seriesOverTime(
            label, result.errors, [](const auto& error) { return error.translation_m.norm(); }));
        rotation.series.push_back(seriesOverTime(label, result.errors, [](const auto& error) {
            return error.rotation_rad.norm() * 180 / M_PI;
        }));
    }
    return {translation, rotation};
}

void plotErrorsOverTime(const std::vector<ErrorPanel>& panels, const std::string& path) {
    plotPanels(panels, path, plotPanelOverTime);
}

void plotErrorDistribution(const std::vector<ErrorPanel>& panels, const std::string& path) {
    plotPanels(panels, path, plotPanelDistribution);
}

}  // namespace rgbd_graphslam
