#include "rgbd_graphslam/dataset/sensor_units.h"

#include <cmath>
#include <cstdlib>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
constexpr double gravity = 9.80665, degree = M_PI / 180;
}  // namespace

const std::vector<SensorUnit>& accelerationUnits() {
    static const std::vector<SensorUnit> units = {
        {"m/s2", 1}, {"g", 1 / gravity}, {"mg", 1000 / gravity}, {"cm/s2", 100}, {"mm/s2", 1000}};
    return units;
}

const std::vector<SensorUnit>& angularVelocityUnits() {
    static const std::vector<SensorUnit> units = {{"rad/s", 1},
                                                  {"deg/s", 1 / degree},
                                                  {"mrad/s", 1000},
                                                  {"mdeg/s", 1000 / degree},
                                                  {"rpm", 30 / M_PI}};
    return units;
}

const std::vector<SensorUnit>& lengthUnits() {
    static const std::vector<SensorUnit> units = {
        {"m", 1}, {"cm", 100}, {"mm", 1000}, {"in", 1 / 0.0254}, {"ft", 1 / 0.3048}};
    return units;
}

const std::vector<SensorUnit>& angleUnits() {
    static const std::vector<SensorUnit> units = {{"rad", 1}, {"deg", 1 / degree}};
    return units;
}

double unitValue(const std::vector<SensorUnit>& units, const std::string& text) {
    std::string names;
    for (const SensorUnit& unit : units) {
        if (text == unit.name) return 1 / unit.per_ours;
        names += unit.name + ", ";
    }
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (!text.empty() && !*end && std::isfinite(number) && number != 0) return number;
    throw Error("'" + text + "' is not a known unit",
                "give one of " + names + "or what one unit is in " + units.front().name);
}

std::optional<SensorUnit> unitOfFactor(const std::vector<SensorUnit>& units, double factor,
                                       double tolerance) {
    for (const SensorUnit& unit : units) {
        if (std::abs(factor / unit.per_ours - 1) < tolerance) return unit;
    }
    return std::nullopt;
}

}  // namespace rgbd_graphslam
