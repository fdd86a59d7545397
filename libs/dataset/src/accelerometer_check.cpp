#include "rgbd_graphslam/dataset/accelerometer_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "rgbd_graphslam/dataset/sensor_units.h"
#include "rgbd_graphslam/dataset/signed_axes.h"
#include "verdict_text.h"

namespace rgbd_graphslam {
namespace {

constexpr double gravity = 9.81;
constexpr std::size_t fewest_readings = 10, fewest_windows = 20, most_windows = 1000;
/** Half the time that one acceleration is taken over. */
constexpr double arm_s = 0.2, longest_arm_s = 0.35;
/** Gravity is taken as constant over so long, so that drift of the tracked rotation is no error. */
constexpr double block_s = 15;
/** Median lengths that an accelerometer in m/s^2 may have while it is carried about. */
constexpr double least_median = 8, largest_median = 12;
/** Without gravity, less than this remains. */
constexpr double least_known_unit = 0.7;
/** RMS that hypotheses must differ by beyond their ratio, m/s^2. */
constexpr double least_difference = 0.15;
constexpr double explains = 1.2;  // RMS that a right hypothesis may leave, m/s^2

/** Readings around a frame, turned to the world, against its acceleration there. */
struct Window {
    std::size_t block = 0;
    /** Sum over readings of R(i, a) f(b), as row i and column 3 a + b: linear in any axes. */
    Eigen::Matrix<double, 3, 9> turned = Eigen::Matrix<double, 3, 9>::Zero();
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();

    /** Specific force in the world were the readings put right by these axes. */
    Eigen::Vector3d force(const Eigen::Matrix3d& axes) const {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) sum += axes(a, b) * turned.col(3 * a + b);
        }
        return sum;
    }
};

double medianLength(const std::vector<StampedVector>& readings) {
    std::vector<double> lengths;
    for (const StampedVector& reading : readings) {
        if (reading.value.allFinite()) lengths.push_back(reading.value.norm());
    }
    if (lengths.size() < fewest_readings) return 0;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

/** Three frames. */
struct Arms {
    const StampedPose &before, &at, &after;
    double left_s() const { return at.stamp_s - before.stamp_s; }
    double right_s() const { return after.stamp_s - at.stamp_s; }

    /** Height of the triangle over a moment, 1 in the middle. */
    double weight(double stamp_s) const {
        return stamp_s < at.stamp_s ? (stamp_s - before.stamp_s) / left_s()
                                    : (after.stamp_s - stamp_s) / right_s();
    }

    Eigen::Vector3d acceleration() const {
        const Eigen::Vector3d velocity_before =
            (at.T_world_cam.t - before.T_world_cam.t) / left_s();
        const Eigen::Vector3d velocity_after = (after.T_world_cam.t - at.T_world_cam.t) / right_s();
        return (velocity_after - velocity_before) / (0.5 * (left_s() + right_s()));
    }
};

/** Adds the readings under the triangle. \return whether they are enough */
bool addReadings(const std::vector<StampedVector>& readings, const Trajectory& stretch,
                 const Arms& arms, double factor, Window& window) {
    auto reading = std::lower_bound(
        readings.begin(), readings.end(), arms.before.stamp_s,
        [](const StampedVector& sample, double stamp_s) { return sample.stamp_s < stamp_s; });
    double weights = 0;
    std::size_t left = 0, right = 0;
    for (; reading != readings.end() && reading->stamp_s < arms.after.stamp_s; ++reading) {
        const auto T = poseAt(stretch, reading->stamp_s);
        if (!T || !reading->value.allFinite()) continue;
        ++(reading->stamp_s < arms.at.stamp_s ? left : right);
        const double weight = arms.weight(reading->stamp_s);
        weights += weight;
        const Eigen::Vector3d force = reading->value / factor;
        for (int a = 0; a < 3; ++a) {
            window.turned.middleCols<3>(3 * a) += weight * T->R.col(a) * force.transpose();
        }
    }
    constexpr std::size_t fewest_on_a_side = 3;
    if (left < fewest_on_a_side || right < fewest_on_a_side || weights <= 0) return false;
    window.turned /= weights;
    return true;
}

/** First frame at least so long after another, or the stretch's size. */
std::size_t frameAfter(const Trajectory& stretch, std::size_t frame, double passed_s) {
    std::size_t next = frame;
    while (next < stretch.size() && stretch[next].stamp_s - stretch[frame].stamp_s < passed_s) {
        ++next;
    }
    return next;
}

std::vector<Window> windowsOf(const std::vector<StampedVector>& readings,
                              const TrackedStretches& stretches, double factor) {
    double all_s = 0;
    for (const Trajectory& stretch : stretches) {
        all_s += stretch.back().stamp_s - stretch.front().stamp_s;
    }
    const double step_s = std::max(0.5 * arm_s, all_s / most_windows);
    std::vector<Window> windows;
    std::size_t block = 0;
    for (const Trajectory& stretch : stretches) {
        double block_began_s = stretch.front().stamp_s;
        ++block;
        for (std::size_t first = 0; first < stretch.size();
             first = frameAfter(stretch, first, step_s)) {
            const std::size_t middle = frameAfter(stretch, first, arm_s);
            if (middle >= stretch.size()) break;
            const std::size_t last = frameAfter(stretch, middle, arm_s);
            if (last >= stretch.size()) break;
            const Arms arms{stretch[first], stretch[middle], stretch[last]};
            if (arms.left_s() > longest_arm_s || arms.right_s() > longest_arm_s) continue;
            if (arms.at.stamp_s - block_began_s > block_s) {
                ++block;
                block_began_s = arms.at.stamp_s;
            }
            Window window;
            window.block = block;
            window.acceleration = arms.acceleration();
            if (addReadings(readings, stretch, arms, factor, window)) windows.push_back(window);
        }
    }
    return windows;
}

/** The means of a block taken away from its windows' forces and accelerations.
 *  \param take (force, acceleration) of each window */
template <class Take>
void aboutBlockMeans(const std::vector<Window>& windows, const Eigen::Matrix3d& axes, Take take) {
    for (std::size_t first = 0; first < windows.size();) {
        std::size_t end = first;
        Eigen::Vector3d force = Eigen::Vector3d::Zero(), acceleration = force;
        for (; end < windows.size() && windows[end].block == windows[first].block; ++end) {
            force += windows[end].force(axes);
            acceleration += windows[end].acceleration;
        }
        const auto n = static_cast<double>(end - first);
        for (; first < end; ++first) {
            take(Eigen::Vector3d(windows[first].force(axes) - force / n),
                 Eigen::Vector3d(windows[first].acceleration - acceleration / n));
        }
    }
}

/** RMS of what the hypothesis leaves unexplained, m/s^2. */
double residual(const std::vector<Window>& windows, const Eigen::Matrix3d& axes) {
    double squares = 0;
    aboutBlockMeans(windows, axes, [&](const auto& force, const auto& acceleration) {
        squares += (force - acceleration).squaredNorm();
    });
    return std::sqrt(squares / static_cast<double>(windows.size()));
}

bool clearlyBetter(double better, double worse) {
    return worse * worse > 3 * better * better + least_difference * least_difference;
}

void nameUnit(double median, SensorVerdict& verdict) {
    if (median > least_median && median < largest_median) return;
    verdict.factor = median / gravity;
    const auto unit = unitOfFactor(accelerationUnits(), verdict.factor, 0.15);
    verdict.fault = SensorFault::Unit;
    addTo(verdict.finding, "its median length is " + factorText(median) + " instead of 9.81 m/s^2" +
                               (unit ? ": it is in " + unit->name : ""));
}

void nameAxes(const Eigen::Matrix3d& axes, SensorVerdict& verdict) {
    verdict.axes = axes;
    const bool negated = (-axes).isIdentity();
    verdict.fault = negated ? SensorFault::Sign : SensorFault::Axes;
    addTo(verdict.finding, negated ? "it is negated: it feels the opposite of how the camera moves"
                                   : "its axes are not where the recording says");
}

/** Correlation of forces and accelerations about their means. */
double correlation(const std::vector<Window>& windows, const Eigen::Matrix3d& axes) {
    double product = 0, of_force = 0, of_acceleration = 0;
    aboutBlockMeans(windows, axes, [&](const auto& force, const auto& acceleration) {
        product += force.dot(acceleration);
        of_force += force.squaredNorm();
        of_acceleration += acceleration.squaredNorm();
    });
    const double both = of_force * of_acceleration;
    return both > 0 ? product / std::sqrt(both) : 0;
}

/** Where gravity fits several hypotheses, as for a robot that turns about the vertical only, weak
 *  accelerations add up over many windows.
 *  \param residuals of signedAxes() */
void compareWeakly(const std::vector<Window>& windows, const std::vector<double>& residuals,
                   SensorVerdict& verdict) {
    constexpr std::size_t enough_windows = 60;
    constexpr double similar = 0.5, least_gap = 0.4, sigmas = 5, overlap = 4;
    if (windows.size() < enough_windows || residuals.front() > explains) return;
    std::vector<double> correlations;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        const bool fits = residuals[i] < residuals.front() + similar;
        correlations.push_back(fits ? correlation(windows, signedAxes()[i]) : -1);
    }
    const double best = *std::max_element(correlations.begin(), correlations.end());
    if (best < 0.5) return;
    const double gap =
        std::max(least_gap, sigmas / std::sqrt(static_cast<double>(windows.size()) / overlap));
    if (correlations.front() > best - 0.1) {
        if (!verdict.wrong()) verdict.fault = SensorFault::None;
    } else if (correlations.front() < best - gap) {
        const auto simplest = std::find_if(correlations.begin(), correlations.end(),
                                           [&](double c) { return c > best - 0.05; });
        nameAxes(signedAxes()[static_cast<std::size_t>(simplest - correlations.begin())], verdict);
        verdict.other_axes_fit = std::count_if(correlations.begin(), correlations.end(),
                                               [&](double c) { return c > best - 0.05; }) > 1;
    }
}

/** Axes and sign by motion and gravity. The first two hypotheses differ in sign only. */
void compare(const std::vector<Window>& windows, SensorVerdict& verdict) {
    std::vector<double> residuals;
    for (const Eigen::Matrix3d& axes : signedAxes()) residuals.push_back(residual(windows, axes));
    const double best = *std::min_element(residuals.begin(), residuals.end());
    if (!clearlyBetter(best, residuals.front())) {
        const bool sign_shown = clearlyBetter(residuals[0], residuals[1]);
        if (sign_shown && residuals.front() < explains) {
            if (!verdict.wrong()) verdict.fault = SensorFault::None;
        } else {
            compareWeakly(windows, residuals, verdict);
        }
        return;
    }
    if (best > explains) return;
    const auto fits = [&](double r) { return r * r < 1.3 * best * best + 0.01; };
    const auto simplest = std::find_if(residuals.begin(), residuals.end(), fits);
    nameAxes(signedAxes()[static_cast<std::size_t>(simplest - residuals.begin())], verdict);
    verdict.other_axes_fit = std::count_if(residuals.begin(), residuals.end(), fits) > 1;
}

}  // namespace

SensorVerdict checkAccelerometer(const std::vector<StampedVector>& readings,
                                 const TrackedStretches& accelerometer) {
    SensorVerdict verdict;
    const double median = medianLength(readings);
    if (median == 0) return verdict;
    if (median < least_known_unit) {
        verdict.fault = SensorFault::Unusable;
        verdict.finding = "it feels no gravity: its median length is " + factorText(median) +
                          " instead of 9.81 m/s^2";
        return verdict;
    }
    nameUnit(median, verdict);
    const double factor = verdict.factor;
    const auto windows = windowsOf(readings, accelerometer, factor);
    if (windows.size() >= fewest_windows) compare(windows, verdict);
    return verdict;
}

std::optional<double> scaleByAccelerometer(const std::vector<StampedVector>& readings,
                                           const TrackedStretches& accelerometer) {
    const auto windows = windowsOf(readings, accelerometer, 1);
    if (windows.size() < fewest_windows) return std::nullopt;
    constexpr double least_correlation = 0.9;
    const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (correlation(windows, axes) < least_correlation) return std::nullopt;
    double of_force = 0, of_acceleration = 0;
    aboutBlockMeans(windows, axes, [&](const auto& force, const auto& acceleration) {
        of_force += force.squaredNorm();
        of_acceleration += acceleration.squaredNorm();
    });

    return std::sqrt(of_force / of_acceleration);
}

}  // namespace rgbd_graphslam
