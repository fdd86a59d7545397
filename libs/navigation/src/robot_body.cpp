#include "rgbd_graphslam/navigation/robot_body.h"

#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <limits>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr const char* section = "CReactiveNavigationSystem3D";

std::vector<Eigen::Vector2d> readOutline(const mrpt::config::CConfigFileBase& config,
                                         const std::string& level) {
    std::vector<double> x, y;
    config.read_vector(section, level + "VECTORX", {}, x);
    config.read_vector(section, level + "VECTORY", {}, y);
    if (x.size() < 3 || x.size() != y.size()) {
        throw Error(
            "[" + std::string(section) + "] " + level + "VECTORX and _VECTORY are no outline",
            "give as many x as y, three or more");
    }
    std::vector<Eigen::Vector2d> outline;
    for (std::size_t i = 0; i < x.size(); ++i) outline.emplace_back(x[i], y[i]);
    return outline;
}

double distanceToSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                         const Eigen::Vector2d& p) {
    const Eigen::Vector2d ab = b - a;
    const double along = std::clamp((p - a).dot(ab) / std::max(ab.squaredNorm(), 1e-12), 0., 1.);
    return (p - a - along * ab).norm();
}

/** Whether a ray from p along +x crosses the side. */
bool crosses(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& p) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return false;
    return p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

}  // namespace

RobotBody readRobotBody(const mrpt::config::CConfigFileBase& config) {
    const int levels = config.read_int(section, "HEIGHT_LEVELS", 0);
    if (levels < 1) {
        throw Error("[" + std::string(section) + "] HEIGHT_LEVELS is missing or below 1",
                    "describe the robot's body, see ini/drive.ini");
    }
    RobotBody body;
    double top_m = 0;
    for (int k = 1; k <= levels; ++k) {
        const std::string level = "LEVEL" + std::to_string(k) + "_";
        const double height_m = config.read_double(section, level + "HEIGHT", 0);
        if (!(height_m > 0))
            throw Error("[" + std::string(section) + "] " + level + "HEIGHT is not above 0",
                        "give the height of the level, m");
        body.push_back({top_m, top_m + height_m, readOutline(config, level)});
        top_m += height_m;
    }
    return body;
}

double circumscribedRadius(const RobotBody& body) {
    double radius = 0;
    for (const BodyLevel& level : body) {
        for (const auto& corner : level.outline) radius = std::max(radius, corner.norm());
    }
    return radius;
}

double signedDistance(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& p) {
    double nearest = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
        nearest = std::min(nearest, distanceToSegment(a, b, p));
        inside ^= crosses(a, b, p);
    }
    return inside ? -nearest : nearest;
}

}  // namespace rgbd_graphslam
