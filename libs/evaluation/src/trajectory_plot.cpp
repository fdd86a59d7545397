#include <algorithm>
#include <cmath>

#include "plot_style.h"
#include "rgbd_graphslam/evaluation/plots.h"
#include "rgbd_graphslam/metrics/stamps.h"

namespace rgbd_graphslam {
namespace {

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
    Gnuplot::Rows rows;
    for (const auto& pose : path) rows.push_back(project(alignment * pose.T_world_cam.t));
    return interruptedAtGaps(stampsOf(path), std::move(rows));
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

/** Of everything that is drawn, in meters. */
struct Extent {
    double min_across = INFINITY, max_across = -INFINITY, min_up = INFINITY, max_up = -INFINITY;

    void include(const Gnuplot::Rows& rows) {
        for (const auto& row : rows) {
            if (row.empty()) continue;
            min_across = std::min(min_across, row[0]);
            max_across = std::max(max_across, row[0]);
            min_up = std::min(min_up, row[1]);
            max_up = std::max(max_up, row[1]);
        }
    }
    double across() const { return std::max(max_across - min_across, 1e-3); }
    double up() const { return std::max(max_up - min_up, 1e-3); }
};

/** 1, 2 or 5 times a power of ten that divides a length into about eight. */
double ticStep(double length) {
    const double raw = length / 8;
    const double power = std::pow(10, std::floor(std::log10(raw)));
    for (const double factor : {1, 2, 5}) {
        if (factor * power >= raw) return factor * power;
    }
    return 10 * power;
}

/** Page size in points so that an equally scaled picture of the extent fills it. */
struct Page {
    int width, height;

    explicit Page(const Extent& extent) {
        constexpr double largest = 540, smallest = 260, beside = 110, above = 130;
        const double points_per_m = largest / std::max(extent.across(), extent.up());
        const auto side = [&](double length_m) {
            return std::max(smallest, points_per_m * length_m);
        };
        width = static_cast<int>(side(extent.across()) + beside);
        height = static_cast<int>(side(extent.up()) + above);
    }
};

/** The lines of one picture. */
class TrajectoryPicture {
  public:
    void add(Gnuplot::Rows rows, const std::string& color, const std::string& label,
             double width = 1.3) {
        extent_.include(rows);
        lines_.push_back({std::move(rows), color, label, width});
    }

    void draw(Projection projection, const std::string& path) const {
        const Page page(extent_);
        Gnuplot plot(path, page.width, page.height);
        setStyle(plot);
        setAxes(plot, projection);
        std::vector<std::string> parts;
        for (const auto& [rows, color, label, width] : lines_) {
            parts.push_back(lineOf(plot.data(rows), color, label, width));
        }
        plot.command(plotOf(parts));
        plot.draw();
    }

  private:
    struct Line {
        Gnuplot::Rows rows;
        std::string color, label;
        double width;
    };

    void setAxes(Gnuplot& plot, Projection projection) const {
        const std::string names = "xyz";
        const std::string step = std::to_string(ticStep(std::max(extent_.across(), extent_.up())));
        plot.command("set size ratio -1");
        plot.command("set xtics " + step + "\nset ytics " + step);
        plot.command("set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03");
        plot.command("set autoscale noextend");
        plot.command(std::string("set xlabel '") + names[projection.across] + " (m)'");
        plot.command(std::string("set ylabel '") + names[projection.up] + " (m)'");
    }

    std::vector<Line> lines_;
    Extent extent_;
};

}  // namespace

void plotTrajectories(const Trajectory& truth, const std::vector<EvaluatedAte>& estimates,
                      PlotPlane plane, const std::string& path) {
    const Projection project = projectionOn(plane);
    TrajectoryPicture picture;
    if (estimates.size() == 1) {
        picture.add(differenceRows(estimates.front().result, project), "#d62728", "difference",
                    0.7);
    }
    picture.add(pathRows(truth, {}, project), "black", "truth");
    for (std::size_t s = 0; s < estimates.size(); ++s) {
        const auto& [label, estimate, result] = estimates[s];
        picture.add(pathRows(estimate, result.alignment, project), colorOf(s), label);
    }
    picture.draw(project, path);
}

}  // namespace rgbd_graphslam
