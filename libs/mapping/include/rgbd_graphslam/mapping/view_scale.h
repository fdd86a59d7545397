/** How large things in a picture of a map are: lines on the floor with their distances, and a bar
 * of a round length. */
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "rgbd_graphslam/mapping/orbit_camera.h"

namespace rgbd_graphslam {

/** The largest of 1, 2 and 5 times a power of ten that is not above. \param most_m positive */
double roundLength(double most_m);

/** As people say it: "20 cm", "1.5 m", "2 km". */
std::string lengthText(double length_m);

/** A bar of a round length. */
struct ScaleBar {
    double length_m = 0, length_px = 0;
};

/** \param most_px that the bar may be long */
ScaleBar scaleBar(double m_per_px, double most_px);

/** Lines on the floor at multiples of a round step, about a dozen along the longer side. */
struct FloorGrid {
    double x_min_m = 0, x_max_m = 0, y_min_m = 0, y_max_m = 0;  // multiples of the step
    double step_m = 1;
};
FloorGrid floorGrid(const Eigen::AlignedBox3d& box);

/** A text at a place of a picture. */
struct SceneLabel {
    Eigen::Vector2d pixel;
    std::string text;
};

/** Distances along the two edges of the floor that face the eye: x or y in world coordinates at
 *  multiples of the grid's step, of so few lines that labels are at least `least_px` apart. */
std::vector<SceneLabel> floorLabels(const FloorGrid& grid, const OrbitCamera& camera,
                                    const Eigen::Vector2i& size_px, double least_px = 52);

}  // namespace rgbd_graphslam
