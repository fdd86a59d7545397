#include "rgbd_graphslam/evaluation/grid_accuracy.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "point_tree.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/surface_sampling.h"

namespace rgbd_graphslam {
namespace {

constexpr double sample_spacing_m = 0.03;
constexpr double height_step_m = 0.05;  // of the search for a mover above a cell

struct GridFile {
    std::string image;
    double resolution_m = 0, x_m = 0, y_m = 0;
};

GridFile readGridFile(const std::string& yaml) {
    std::ifstream in(yaml);
    GridFile grid;
    char name[256];
    for (std::string line; std::getline(in, line);) {
        if (std::sscanf(line.c_str(), "image: %255s", name) == 1) grid.image = name;
        std::sscanf(line.c_str(), "resolution: %lf", &grid.resolution_m);
        std::sscanf(line.c_str(), "origin: [%lf, %lf", &grid.x_m, &grid.y_m);
    }
    if (grid.image.empty() || !(grid.resolution_m > 0)) {
        throw Error("'" + yaml + "' describes no grid", "give the grid.yaml of a run");
    }
    return grid;
}

/** Where obstacles are, seen from above. */
std::vector<Eigen::Vector3d> footprint(const PlyModel& surface,
                                       const GridAccuracyOptions& options) {
    std::vector<Eigen::Vector3d> points;
    forEachSurfaceSample(surface, sample_spacing_m, [&](const Eigen::Vector3d& p, double) {
        if (p.z() < options.min_z_m || p.z() > options.max_z_m) return;
        points.emplace_back(p.x(), p.y(), 0);
    });
    if (points.empty()) {
        throw Error("the true surface has no obstacle in the band of heights",
                    "check --z-min and --z-max");
    }
    return points;
}

bool underMover(const Eigen::Vector3d& cell, const GridAccuracyOptions& options) {
    for (double z = options.min_z_m; z <= options.max_z_m; z += height_step_m) {
        if (options.movers->contains({cell.x(), cell.y(), z})) return true;
    }
    return false;
}

}  // namespace

std::vector<Eigen::Vector3d> occupiedCells(const std::string& yaml) {
    const GridFile grid = readGridFile(yaml);
    const std::string path = std::filesystem::path(yaml).parent_path() / grid.image;
    cv::Mat image;
    if (std::filesystem::exists(path)) image = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (image.empty()) throw Error("cannot read the grid's picture '" + path + "'", "map again");
    std::vector<Eigen::Vector3d> cells;
    for (int v = 0; v < image.rows; ++v) {
        for (int u = 0; u < image.cols; ++u) {
            if (image.at<uchar>(v, u) != 0) continue;
            cells.emplace_back(grid.x_m + (u + 0.5) * grid.resolution_m,
                               grid.y_m + (image.rows - v - 0.5) * grid.resolution_m, 0);
        }
    }
    return cells;
}

GridAccuracy evaluateGrid(const std::vector<Eigen::Vector3d>& occupied, const PlyModel& surface,
                          const GridAccuracyOptions& options) {
    const auto obstacles = footprint(surface, options);
    const PointTree tree(obstacles);
    GridAccuracy accuracy;
    accuracy.occupied = occupied.size();
    if (options.movers) accuracy.on_movers_ways = 0;
    for (const auto& cell : occupied) {
        Eigen::Vector3d place = options.alignment * cell;
        place.z() = 0;
        if (tree.distanceTo(place) <= options.tolerance_m) continue;
        ++accuracy.wrong;
        if (options.movers && underMover(place, options)) ++*accuracy.on_movers_ways;
    }
    return accuracy;
}

Report reportOf(const std::string& grid, const GridAccuracy& accuracy) {
    const auto cells = [](const std::string& name, std::size_t count) {
        return Figure{name, static_cast<double>(count), "cells", 0};
    };
    Report report{grid, {cells("occupied", accuracy.occupied), cells("wrong", accuracy.wrong)}};
    if (accuracy.on_movers_ways) {
        report.figures.push_back(cells("on_movers_ways", *accuracy.on_movers_ways));
    }
    return report;
}

}  // namespace rgbd_graphslam
