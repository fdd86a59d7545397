#include <algorithm>
#include <cmath>

#include "plot_style.h"
#include "rgbd_graphslam/evaluation/plots.h"

namespace rgbd_graphslam {
namespace {

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

/** Seconds since `start_s` and error. */
Gnuplot::Rows rowsOverTime(const ErrorSeries& series, double start_s) {
    Gnuplot::Rows rows;
    for (std::size_t k = 0; k < series.errors.size(); ++k) {
        rows.push_back({series.stamps_s[k] - start_s, series.errors[k]});
    }
    return interruptedAtGaps(series.stamps_s, std::move(rows));
}

void plotPanelOverTime(Gnuplot& plot, const ErrorPanel& panel) {
    const double start_s = firstStamp(panel);
    std::vector<std::string> parts;
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const std::string data = plot.data(rowsOverTime(panel.series[s], start_s));
        const std::string& label = panel.series[s].label;
        const bool points = panel.style == ErrorPanel::Style::Points;
        parts.push_back(points ? pointsOf(data, colorOf(s), label)
                               : lineOf(data, colorOf(s), label));
    }
    plot.command("set xlabel 'time (s)'\nset xrange [0:*] noextend\nset yrange [0:*]");
    plot.command("set ylabel " + axisLabel(panel));
    plot.command(plotOf(parts));
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

/** Rule of Freedman and Diaconis, "On the histogram as a density estimator", 1981. */
double binWidth(const std::vector<double>& errors) {
    const double spread = percentileOf(errors, 0.75) - percentileOf(errors, 0.25);
    const double width = 2 * spread / std::cbrt(errors.size());
    const double largest = *std::max_element(errors.begin(), errors.end());
    return std::max({width, largest / 200, 1e-12});
}

/** Center and share in percent of the bins from 0 to the largest error. */
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

/** On the axis at the right, since the bins hold far less than the whole. */
std::string histogramPart(Gnuplot& plot, const std::vector<double>& errors) {
    plot.command("set border 11\nset y2tics\nset y2range [0:*]");
    plot.command("set y2label 'share in a bin (%)'");
    Gnuplot::Rows rows = histogramRows(errors, binWidth(errors));
    for (auto& row : rows) row.push_back(binWidth(errors));
    return plot.data(rows) + " axes x1y2 with boxes fillstyle solid 0.25 noborder linecolor '" +
           colorOf(0) + "' title 'share in a bin'";
}

void plotPanelDistribution(Gnuplot& plot, const ErrorPanel& panel) {
    plot.command("set xrange [0:*]\nset yrange [0:100]");
    plot.command("set xlabel " + axisLabel(panel));
    plot.command("set ylabel 'share not larger (%)'");
    std::vector<std::string> parts;
    if (panel.series.size() == 1) {
        parts.push_back(histogramPart(plot, panel.series.front().errors));
    }
    for (std::size_t s = 0; s < panel.series.size(); ++s) {
        const auto& series = panel.series[s];
        parts.push_back(lineOf(plot.data(cumulativeRows(series.errors)), colorOf(s), series.label));
    }
    plot.command(plotOf(parts));
}

/** The panels over each other, the legend over the first. */
template <class PlotPanel>
void plotPanels(const std::vector<ErrorPanel>& panels, const std::string& path,
                PlotPanel plot_panel) {
    constexpr int width = 640, panel_height = 290;
    Gnuplot plot(path, width, panel_height * static_cast<int>(panels.size()));
    setStyle(plot);
    plot.command("set lmargin 11");
    plot.command("set multiplot layout " + std::to_string(panels.size()) + ",1");
    for (const auto& panel : panels) {
        plot_panel(plot, panel);
        plot.command("unset key");
    }
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

double translationOf(const RelativeError& error) {
    return error.translation_m.norm();
}
double rotationOf(const RelativeError& error) {
    return error.rotation_rad.norm() * 180 / M_PI;
}

}  // namespace

std::vector<ErrorPanel> errorPanels(const std::vector<EvaluatedAte>& estimates) {
    ErrorPanel panel{"translational error", "m", ErrorPanel::Style::Lines, {}};
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
    ErrorPanel translation{"translational error", "m", style, {}};
    ErrorPanel rotation{"rotational error", "deg", style, {}};
    for (const auto& [label, result] : estimates) {
        translation.series.push_back(seriesOverTime(label, result.errors, translationOf));
        rotation.series.push_back(seriesOverTime(label, result.errors, rotationOf));
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
