#include "rgbd_graphslam/evaluation/mover_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double column_m = 0.25;
constexpr double resting_m_s = 0.02;
const char* const header =
    "stamp_s,name,carried,speed_m_s,x_m,y_m,z_m,qx,qy,qz,qw,size_x_m,size_y_m,size_z_m";

long long columnKey(long x, long y) {
    return (static_cast<long long>(x) << 32) ^ (y & 0xffffffffLL);
}

long columnOf(double coordinate_m) {
    return std::lround(std::floor(coordinate_m / column_m));
}

/** Half the extent of a box along the world's axes. */
Eigen::Vector3d reach(const MoverBox& box) {
    return box.T_world_box.R.cwiseAbs() * (0.5 * box.size_m);
}

/** \throws std::logic_error when the line is damaged */
MoverBox boxOf(const std::string& line) {
    MoverBox box;
    std::istringstream in(line);
    std::vector<double> numbers;
    int column = 0;
    for (std::string cell; std::getline(in, cell, ','); ++column) {
        if (column == 1) {
            box.name = cell;
        } else {
            numbers.push_back(std::stod(cell));
        }
    }
    if (column != 14) throw std::invalid_argument("columns");
    box.stamp_s = numbers[0];
    box.carried = numbers[1] != 0;
    box.speed_m_s = numbers[2];
    const Eigen::Quaterniond q(numbers[9], numbers[6], numbers[7], numbers[8]);
    box.T_world_box = {q.normalized().toRotationMatrix(), {numbers[3], numbers[4], numbers[5]}};
    box.size_m = {numbers[10], numbers[11], numbers[12]};
    return box;
}

}  // namespace

bool MoverBox::contains(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d inside = T_world_box.inverse() * point;
    return (2 * inside.cwiseAbs().array() <= size_m.array()).all();
}

std::vector<MoverBox> readMoverBoxes(const std::string& path) {
    std::ifstream in(path);
    std::string line;
    if (!std::getline(in, line)) throw Error("cannot read '" + path + "'", "check the name");
    if (line != header) {
        throw Error(path + ":1 is not the title line of boxes of movers",
                    "give a movers.csv of rgbd-synth");
    }
    std::vector<MoverBox> boxes;
    for (int number = 2; std::getline(in, line); ++number) {
        try {
            boxes.push_back(boxOf(line));
        } catch (const std::logic_error&) {
            throw Error(path + ":" + std::to_string(number) + " is no box of a mover",
                        "render the sequence again");
        }
    }
    return boxes;
}

MoverWays::MoverWays(std::vector<MoverBox> boxes) : boxes_(std::move(boxes)) {
    while (last_stamp_ < boxes_.size() && boxes_[last_stamp_].stamp_s != boxes_.back().stamp_s) {
        ++last_stamp_;
    }
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
        const Eigen::Vector3d low = boxes_[i].T_world_box.t - reach(boxes_[i]),
                              high = boxes_[i].T_world_box.t + reach(boxes_[i]);
        for (long x = columnOf(low.x()); x <= columnOf(high.x()); ++x) {
            for (long y = columnOf(low.y()); y <= columnOf(high.y()); ++y) {
                in_column_[columnKey(x, y)].push_back(i);
            }
        }
    }
}

bool MoverWays::restsAt(const Eigen::Vector3d& point) const {
    return std::any_of(
        boxes_.begin() + static_cast<std::ptrdiff_t>(last_stamp_), boxes_.end(),
        [&](const MoverBox& box) { return box.speed_m_s < resting_m_s && box.contains(point); });
}

bool MoverWays::contains(const Eigen::Vector3d& point) const {
    const auto column = in_column_.find(columnKey(columnOf(point.x()), columnOf(point.y())));
    if (column == in_column_.end()) return false;
    const auto& near = column->second;
    return std::any_of(near.begin(), near.end(),
                       [&](std::size_t i) { return boxes_[i].contains(point); }) &&
           !restsAt(point);
}

}  // namespace rgbd_graphslam
