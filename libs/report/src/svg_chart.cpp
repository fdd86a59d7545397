#include "rgbd_graphslam/report/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/report/html.h"

namespace rgbd_graphslam {
namespace {

constexpr int width_px = 560, plan_height_px = 380, time_height_px = 190;
constexpr int left_px = 46, right_px = 22, top_px = 26, bottom_px = 34;
constexpr std::size_t most_points = 2000;

struct Range {
    double low = 0, high = 1;
    double length() const { return high - low; }
};

Range rangeOf(const std::vector<ChartLine>& lines, int axis) {
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const ChartLine& line : lines) {
        for (const auto& point : line.points) {
            range.low = std::min(range.low, point[axis]);
            range.high = std::max(range.high, point[axis]);
        }
    }
    return range.low <= range.high ? range : Range{};
}

/** Pixels of a chart's data. */
struct Axes {
    Range x, y;
    int height_px;

    double left() const { return left_px; }
    double right() const { return width_px - right_px; }
    double top() const { return top_px; }
    double bottom() const { return height_px - bottom_px; }
    double u(double value) const {
        return left() + (value - x.low) / x.length() * (right() - left());
    }
    double v(double value) const {
        return bottom() - (value - y.low) / y.length() * (bottom() - top());
    }
};

std::string verticalGrid(const Axes& axes, double step, const char* unit) {
    std::string svg;
    for (double x = std::ceil(axes.x.low / step) * step; x <= axes.x.high; x += step) {
        svg += formatted("<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/>", axes.u(x), axes.top(),
                         axes.bottom());
        svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%g%s</text>",
                         axes.u(x), axes.bottom() + 16, std::abs(x) < step / 2 ? 0. : x, unit);
    }
    return svg;
}

std::string horizontalGrid(const Axes& axes, double step, const char* unit) {
    std::string svg;
    for (double y = std::ceil(axes.y.low / step) * step; y <= axes.y.high; y += step) {
        svg += formatted("<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>", axes.left(), axes.v(y),
                         axes.right());
        svg += formatted("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%g%s</text>",
                         axes.left() - 5, axes.v(y) + 4, std::abs(y) < step / 2 ? 0. : y, unit);
    }
    return svg;
}

std::string polyline(const Axes& axes, const ChartLine& line) {
    std::string svg = "<polyline class=\"" + line.css_class + "\" points=\"";
    for (const auto& point : line.points) {
        svg += formatted("%.1f,%.1f ", axes.u(point.x()), axes.v(point.y()));
    }
    return svg + "\"/>";
}

/** Names with a dash of their line, from left to right above the chart. */
std::string legend(const std::vector<ChartLine>& lines) {
    constexpr int dash_px = 22, letter_px = 7;
    std::string svg;
    int x = left_px;
    for (const ChartLine& line : lines) {
        if (line.name.empty()) continue;
        svg +=
            formatted("<path class=\"%s\" d=\"M%d 13h%d\"/>", line.css_class.c_str(), x, dash_px);
        svg += formatted("<text x=\"%d\" y=\"17\">", x + dash_px + 5) + htmlEscaped(line.name) +
               "</text>";
        x += dash_px + 20 + letter_px * static_cast<int>(line.name.size());
    }
    return svg;
}

std::string element(int height_px, const std::string& content) {
    return formatted("<svg viewBox=\"0 0 %d %d\" role=\"img\">", width_px, height_px) + content +
           "</svg>\n";
}

/** Without lines of one point or none, whose name goes to the next one of the same class. */
std::vector<ChartLine> drawable(const std::vector<ChartLine>& lines) {
    std::vector<ChartLine> some;
    ChartLine nameless;
    for (const ChartLine& line : lines) {
        if (line.css_class != nameless.css_class || !line.name.empty()) nameless = line;
        if (line.points.size() < 2) continue;
        some.push_back(line);
        some.back().name = std::exchange(nameless.name, {});
    }
    return some;
}

/** Both axes of one scale, the data in the middle. */
Axes planAxes(const std::vector<ChartLine>& lines) {
    Axes axes{rangeOf(lines, 0), rangeOf(lines, 1), plan_height_px};
    const double across = axes.right() - axes.left(), up = axes.bottom() - axes.top();
    constexpr double spare = 1.08, least_m = 0.1;
    const double m_per_px =
        spare * std::max({axes.x.length() / across, axes.y.length() / up, least_m / across});
    const auto widen = [&](Range& range, double px) {
        const double middle = (range.low + range.high) / 2, half = m_per_px * px / 2;
        range = {middle - half, middle + half};
    };
    widen(axes.x, across);
    widen(axes.y, up);
    return axes;
}

}  // namespace

const char* const chart_style =
    R"css(svg text { font: 11px system-ui, "Segoe UI", "DejaVu Sans", sans-serif; fill: #68727c; }
svg path, svg polyline { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
svg .grid { stroke: #d9dee3; stroke-width: 1; }
svg .estimate { stroke: #d9661f; } svg .truth { stroke: #4a5560; stroke-dasharray: 5 3; }
svg .before { stroke: #8a63b8; stroke-dasharray: 4 3; } svg .after { stroke: #1f77b4; }
svg .loop { stroke: #c81e3c; } svg .value { stroke: #1f77b4; stroke-width: 1.2; }
svg .lost { fill: #f6c6c6; }
)css";

std::string svgFile(const std::string& chart) {
    const std::size_t attributes = chart.find(' '), content = chart.find('>') + 1;
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" +
           chart.substr(attributes, content - attributes) + "\n<style>\n" + chart_style +
           "</style>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
           chart.substr(content);
}

double roundStep(double range, int parts) {
    const double rough = std::max(range, 1e-9) / parts;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double digit = rough / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, std::size_t most) {
    if (points.size() <= most) return points;
    const std::size_t group = (2 * points.size() + most - 1) / most;
    const auto lower = [](const auto& a, const auto& b) { return a.y() < b.y(); };
    std::vector<Eigen::Vector2d> some;
    for (std::size_t i = 0; i < points.size(); i += group) {
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end =
            points.begin() + static_cast<std::ptrdiff_t>(std::min(i + group, points.size()));
        const auto [low, high] = std::minmax_element(begin, end, lower);
        some.push_back(*std::min(low, high));
        if (low != high) some.push_back(*std::max(low, high));
    }
    return some;
}

std::string planChart(const std::vector<ChartLine>& lines) {
    const auto shown = drawable(lines);
    if (shown.empty()) return {};
    const Axes axes = planAxes(shown);
    const double step = roundStep(axes.x.length(), 8);
    std::string svg = verticalGrid(axes, step, " m") + horizontalGrid(axes, step, " m");
    for (const ChartLine& line : shown) svg += polyline(axes, line);
    return element(plan_height_px, svg + legend(shown));
}

std::string timeChart(const std::vector<ChartLine>& lines, const std::string& quantity,
                      const std::vector<std::pair<double, double>>& marked) {
    auto shown = drawable(lines);
    if (shown.empty()) return {};
    for (ChartLine& line : shown) line.points = thinned(line.points, most_points);
    Axes axes{rangeOf(shown, 0), rangeOf(shown, 1), time_height_px};
    axes.y = {0, std::max(1e-9, 1.05 * axes.y.high)};
    axes.x.high = std::max(axes.x.high, axes.x.low + 1e-9);
    std::string svg;
    for (const auto& [first, last] : marked) {
        constexpr double least_px = 2;
        svg +=
            formatted("<rect class=\"lost\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>",
                      axes.u(first), axes.top(), std::max(least_px, axes.u(last) - axes.u(first)),
                      axes.bottom() - axes.top());
    }
    svg += verticalGrid(axes, roundStep(axes.x.length(), 8), " s");
    svg += horizontalGrid(axes, roundStep(axes.y.length(), 4), "");
    for (const ChartLine& line : shown) svg += polyline(axes, line);
    svg += formatted("<text x=\"%d\" y=\"17\" text-anchor=\"end\">", width_px - right_px) +
           htmlEscaped(quantity) + "</text>";
    return element(time_height_px, svg + legend(shown));
}

}  // namespace rgbd_graphslam
