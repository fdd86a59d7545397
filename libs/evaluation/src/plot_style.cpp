#include "plot_style.h"

#include <algorithm>

#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {

double longestPause(const std::vector<double>& stamps_s) {
    std::vector<double> pauses;
    for (std::size_t k = 1; k < stamps_s.size(); ++k) {
        pauses.push_back(stamps_s[k] - stamps_s[k - 1]);
    }
    return pauses.empty() ? 0 : std::max(0.5, 10 * percentileOf(pauses, 0.5));
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof(text), "%g", value);
    return text;
}

}  // namespace

void setStyle(Gnuplot& plot) {
    plot.command("set border 3 linecolor '#404040'");
    plot.command("set tics nomirror out textcolor '#202020'");
    plot.command("set format '%g'");  // the default's blank for a sign puts labels off their tics
    plot.command("set grid linetype 1 linecolor '#e4e4e4' linewidth 0.6");
    plot.command("set key above center horizontal Left reverse samplen 2");
}

std::string colorOf(std::size_t series) {
    static const std::vector<std::string> colors = {"#0060c0", "#e69f00", "#009e73", "#cc79a7",
                                                    "#56b4e9", "#d55e00", "#7f7f7f"};
    return colors[series % colors.size()];
}

std::string lineOf(const std::string& data, const std::string& color, const std::string& label,
                   double width) {
    return data + " with lines linewidth " + number(width) + " linecolor '" + color + "' title " +
           Gnuplot::quoted(label);
}

std::string pointsOf(const std::string& data, const std::string& color, const std::string& label) {
    return data + " with points pointtype 7 pointsize 0.15 linecolor '" + color + "' title " +
           Gnuplot::quoted(label);
}

std::string plotOf(const std::vector<std::string>& parts) {
    std::string text = "plot ";
    for (std::size_t k = 0; k < parts.size(); ++k) text += (k ? ", " : "") + parts[k];
    return text;
}

Gnuplot::Rows interruptedAtGaps(const std::vector<double>& stamps_s, Gnuplot::Rows rows) {
    const double longest_s = longestPause(stamps_s);
    Gnuplot::Rows result;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (k > 0 && stamps_s[k] - stamps_s[k - 1] > longest_s) result.emplace_back();
        result.push_back(std::move(rows[k]));
    }
    return result;
}

}  // namespace rgbd_graphslam
