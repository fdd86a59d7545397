/** Units that sensors are recorded in, and how a recording gives itself away. */
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A unit by the name that options and messages use. */
struct SensorUnit {
    std::string name;
    /** How many of them make one unit of the project. */
    double per_ours = 1;
};

/** Of the accelerometer, in m/s^2: "m/s2", "g", "mg", "cm/s2", "mm/s2". */
const std::vector<SensorUnit>& accelerationUnits();
/** Of the gyroscope, in rad/s: "rad/s", "deg/s", "mrad/s", "mdeg/s", "rpm". */
const std::vector<SensorUnit>& angularVelocityUnits();
/** Of the odometry's way, in m: "m", "cm", "mm", "in", "ft". */
const std::vector<SensorUnit>& lengthUnits();
/** Of the odometry's heading, in rad: "rad", "deg". */
const std::vector<SensorUnit>& angleUnits();

/** What one unit is in the project's: by name, or a number as text, which may be negative.
 *  \throws Error listing the names */
double unitValue(const std::vector<SensorUnit>& units, const std::string& text);

/** The unit that explains why readings are `factor` times what is right.
 *  \param tolerance of the factor, as a share of it */
std::optional<SensorUnit> unitOfFactor(const std::vector<SensorUnit>& units, double factor,
                                       double tolerance);

}  // namespace rgbd_graphslam
