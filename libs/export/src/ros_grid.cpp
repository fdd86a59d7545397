#include "ros_grid.h"

#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr std::uint8_t occupied = 100, free_space = 0, unknown = 255;

void readPlace(const std::string& path, GridMap& grid) {
    std::ifstream in(path);
    bool has_cell = false, has_origin = false;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string key;
        char bracket = 0, comma = 0;
        words >> key;
        if (key == "resolution:") has_cell = static_cast<bool>(words >> grid.cell_m);
        if (key == "origin:")
            has_origin = static_cast<bool>(words >> bracket >> grid.x_m >> comma >> grid.y_m);
    }
    const bool good = has_cell && has_origin && grid.cell_m > 0 && std::isfinite(grid.cell_m) &&
                      std::isfinite(grid.x_m) && std::isfinite(grid.y_m);
    if (!good)
        throw Error("'" + path + "' has no resolution or no origin", "make it again with rgbd-map");
}

/** As grid.png and grid.yaml have it: black is occupied, white free, all else unknown. */
std::uint8_t cellOf(std::uint8_t shade) {
    constexpr int lightest_occupied = 88, darkest_free = 206;
    if (shade <= lightest_occupied) return occupied;
    return shade >= darkest_free ? free_space : unknown;
}

}  // namespace

GridMap readRosGrid(const std::string& stem) {
    GridMap grid;
    readPlace(stem + ".yaml", grid);
    const cv::Mat1b picture = cv::imread(stem + ".png", cv::IMREAD_GRAYSCALE);
    if (picture.empty())
        throw Error("cannot read '" + stem + ".png'", "make it again with rgbd-map");
    grid.cells.create(picture.size());
    for (int row = 0; row < picture.rows; ++row) {
        const std::uint8_t* const shades = picture[picture.rows - 1 - row];
        std::transform(shades, shades + picture.cols, grid.cells[row], cellOf);
    }
    return grid;
}

}  // namespace rgbd_graphslam
