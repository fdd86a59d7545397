#include "rgbd_graphslam/dataset/odometry_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "rgbd_graphslam/dataset/sensor_units.h"
#include "verdict_text.h"

namespace rgbd_graphslam {
namespace {

constexpr double span_s = 0.5, longest_span_s = 1.5, longest_silence_s = 0.5;
constexpr std::size_t fewest_spans = 8, fewest_turning_spans = 4;
/** Way and turning of the camera below which nothing can be told. */
constexpr double least_way_m = 0.4, least_turning_rad = 0.4;
constexpr double span_moves_m = 0.03, span_turns_rad = 0.05;
constexpr double explains = 0.85, unrelated = 0.4;
constexpr double largest_honest_factor = 1.3;
/** Factors of honest sensors scatter; a unit is the same all over. */
constexpr double steady = 0.15;

struct Planar {
    Eigen::Vector2d way;
    double heading;
};

/** Readings with headings that do not jump, on request at any moment. */
class WheelPath {
  public:
    explicit WheelPath(const std::vector<StampedVector>& readings) {
        double heading = 0;
        for (const StampedVector& reading : readings) {
            if (!reading.value.allFinite()) continue;
            if (path_.empty()) {
                first_heading_ = reading.value.z();
            } else {
                if (reading.stamp_s <= path_.back().stamp_s) continue;
                heading += std::remainder(reading.value.z() - last_heading_, 2 * M_PI);
            }
            last_heading_ = reading.value.z();
            path_.push_back({reading.stamp_s, {reading.value.x(), reading.value.y(), heading}});
        }
    }

    std::optional<Planar> at(double stamp_s) const {
        const auto after = std::lower_bound(
            path_.begin(), path_.end(), stamp_s,
            [](const StampedVector& reading, double s) { return reading.stamp_s < s; });
        if (after == path_.begin() || after == path_.end()) return std::nullopt;
        const StampedVector& before = *(after - 1);
        const double gap_s = after->stamp_s - before.stamp_s;
        if (gap_s > longest_silence_s) return std::nullopt;
        const Eigen::Vector3d value =
            before.value + (stamp_s - before.stamp_s) / gap_s * (after->value - before.value);
        return Planar{value.head<2>(), value.z()};
    }

    double firstHeading() const { return first_heading_; }

  private:
    std::vector<StampedVector> path_;
    double last_heading_ = 0, first_heading_ = 0;
};

/** What wheels and camera say of one span of time. */
struct Span {
    Eigen::Vector2d wheels_way;  // in the odometry's world
    double wheels_heading;       // in its middle, since the first reading
    double wheels_turning;
    Eigen::Vector2d way;  // in the base's axes at the middle heading
    double turning;       // about the base's z
    double length;        // of the way, in all three axes: sensor_pose may be wrong
};

Span spanOf(const StampedPose& from, const StampedPose& to, const Planar& start,
            const Planar& end) {
    const SE3 moved = from.T_world_cam.inverse() * to.T_world_cam;
    const double turning = rotationLog(moved.R).z();
    const Eigen::Vector2d way = Eigen::Rotation2Dd(-0.5 * turning) * moved.t.head<2>();
    return {end.way - start.way,
            0.5 * (start.heading + end.heading),
            end.heading - start.heading,
            way,
            turning,
            moved.t.norm()};
}

std::vector<Span> spansOf(const TrackedStretches& stretches, const WheelPath& wheels) {
    std::vector<Span> spans;
    for (const Trajectory& stretch : stretches) {
        for (std::size_t from = 0, to = 0; to < stretch.size(); ++to) {
            const double passed_s = stretch[to].stamp_s - stretch[from].stamp_s;
            if (passed_s < span_s) continue;
            const auto start = wheels.at(stretch[from].stamp_s),
                       end = wheels.at(stretch[to].stamp_s);
            if (passed_s < longest_span_s && start && end) {
                spans.push_back(spanOf(stretch[from], stretch[to], *start, *end));
            }
            from = to;
        }
    }
    return spans;
}

/** Least-squares factor and correlation, without a mean: standing still is no motion. */
struct Relation {
    double factor = 1, correlation = 0;
};

Relation turningRelation(const std::vector<Span>& spans) {
    double product = 0, of_wheels = 0, of_camera = 0;
    for (const Span& span : spans) {
        product += span.wheels_turning * span.turning;
        of_wheels += span.wheels_turning * span.wheels_turning;
        of_camera += span.turning * span.turning;
    }
    if (of_wheels <= 0 || of_camera <= 0) return {};
    return {product / of_camera, product / std::sqrt(of_wheels * of_camera)};
}

/** The way in the base's axes, were the readings put right. */
Eigen::Vector2d wayInBase(const Span& span, const Eigen::Matrix2d& axes, double heading_factor,
                          double first_heading) {
    const double heading = first_heading + span.wheels_heading / heading_factor;
    return Eigen::Rotation2Dd(-heading) * (axes * span.wheels_way);
}

double wayCorrelation(const std::vector<Span>& spans, const Eigen::Matrix2d& axes,
                      double heading_factor, double first_heading) {
    double product = 0, of_wheels = 0, of_camera = 0;
    for (const Span& span : spans) {
        const Eigen::Vector2d wheels = wayInBase(span, axes, heading_factor, first_heading);
        product += wheels.dot(span.way);
        of_wheels += wheels.squaredNorm();
        of_camera += span.way.squaredNorm();
    }
    const double both = of_wheels * of_camera;
    return both > 0 ? product / std::sqrt(both) : 0;
}

struct PlanarAxes {
    Eigen::Matrix2d axes;
    std::string fault;
};

/** The simplest first. */
std::vector<PlanarAxes> planarAxes() {
    const auto matrix = [](double xx, double xy, double yx, double yy) {
        return (Eigen::Matrix2d() << xx, xy, yx, yy).finished();
    };
    return {{matrix(1, 0, 0, 1), ""},
            {matrix(-1, 0, 0, -1),
             "x and y are negated, or the yaw of sensor_pose is wrong by 180 degrees"},
            {matrix(0, 1, 1, 0), "x and y are exchanged"},
            {matrix(1, 0, 0, -1), "y is negated"},
            {matrix(-1, 0, 0, 1), "x is negated"},
            {matrix(0, -1, -1, 0), "x and y are exchanged and negated"},
            {matrix(0, -1, 1, 0), "x and y, or the yaw of sensor_pose, are turned by -90 degrees"},
            {matrix(0, 1, -1, 0), "x and y, or the yaw of sensor_pose, are turned by 90 degrees"}};
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Ratio {
    double median = 1, spread = 0;  // half the distance of the quartiles, as a share
};

/** Of lengths, so that it needs no heading. */
std::optional<Ratio> wayRatio(const std::vector<Span>& spans) {
    std::vector<double> ratios;
    for (const Span& span : spans) {
        if (span.length < span_moves_m) continue;
        ratios.push_back(span.wheels_way.norm() / span.length);
    }
    if (ratios.size() < fewest_spans) return std::nullopt;
    const double middle = median(ratios);
    std::vector<double> deviations;
    for (const double ratio : ratios) deviations.push_back(std::abs(ratio - middle));
    return Ratio{middle, middle > 0 ? median(deviations) / middle : 0};
}

/** Depth units of known cameras where the value is near one. */
double commonUnits(double units) {
    for (const double common : {100., 256., 1000., 4000., 5000., 10000.}) {
        if (std::abs(units / common - 1) < 0.1) return common;
    }
    return units;
}

class OdometryCheck {
  public:
    OdometryCheck(const std::vector<StampedVector>& readings, const TrackedStretches& base,
                  double depth_units)
        : wheels_(readings), spans_(spansOf(base, wheels_)), depth_units_(depth_units) {
        for (const Span& span : spans_) {
            if (span.length > span_moves_m) {
                way_m_ += span.length;
                wheels_way_ += span.wheels_way.norm();
            }
            if (std::abs(span.turning) > span_turns_rad) {
                turning_rad_ += std::abs(span.turning);
                ++turning_spans_;
            }
        }
    }

    OdometryVerdict verdict() {
        OdometryVerdict verdict;
        if (spans_.size() < fewest_spans) return verdict;
        nameHeading(verdict);
        nameWay(verdict);
        return verdict;
    }

  private:
    void nameHeading(OdometryVerdict& verdict) {
        if (turning_spans_ < fewest_turning_spans || turning_rad_ < least_turning_rad) return;
        const Relation relation = turningRelation(spans_);
        if (std::abs(relation.correlation) < explains) return;
        agree(verdict);
        heading_known_ = true;
        const double factor = relation.factor;
        if (factor < largest_honest_factor && factor > 1 / largest_honest_factor) return;
        verdict.heading_factor = factor;
        verdict.fault =
            factor < 0 && factor > -largest_honest_factor ? SensorFault::Sign : SensorFault::Unit;
        const bool degrees = unitOfFactor(angleUnits(), std::abs(factor), 0.15).has_value();
        addTo(verdict.finding, verdict.fault == SensorFault::Sign
                                   ? "its heading turns the other way than the camera"
                                   : "its heading turns " + factorText(factor) +
                                         " times as fast as the camera" +
                                         (degrees ? ": it is in deg" : ""));
    }

    void nameWay(OdometryVerdict& verdict) const {
        const auto ratio = wayRatio(spans_);
        if (!ratio || way_m_ < least_way_m) return;
        if (wheels_way_ < 0.02 * way_m_ && ratio->median < 0.02) {
            verdict.fault = SensorFault::Unusable;
            addTo(verdict.finding,
                  "its wheels stand still while the camera moves " + factorText(way_m_) + " m");
            return;
        }
        nameFactor(*ratio, verdict);
        nameAxes(verdict);
    }

    void nameFactor(const Ratio& ratio, OdometryVerdict& verdict) const {
        if (ratio.median < largest_honest_factor && ratio.median > 1 / largest_honest_factor)
            return;
        if (ratio.spread > steady) return;
        verdict.factor = ratio.median;
        verdict.fault = SensorFault::Unit;
        const auto unit = unitOfFactor(lengthUnits(), ratio.median, 0.12);
        addTo(verdict.finding, "its way is " + factorText(ratio.median) + " times the camera's" +
                                   (unit ? ": it is in " + unit->name : ""));
        const double units = commonUnits(depth_units_ / ratio.median);
        constexpr double least_units = 100, most_units = 20000;
        if (units < least_units || units > most_units) return;
        verdict.finding += ", or depth_units should be " + factorText(units) + " instead of " +
                           factorText(depth_units_);
    }

    /** Of headings in another unit the first one is not known, which MRPT keeps within a turn. */
    void nameAxes(OdometryVerdict& verdict) const {
        if (std::abs(std::abs(verdict.heading_factor) - 1) > 0.5) return;
        const auto all = planarAxes();
        std::vector<double> correlations;
        for (const PlanarAxes& hypothesis : all) {
            correlations.push_back(wayCorrelation(spans_, hypothesis.axes, verdict.heading_factor,
                                                  wheels_.firstHeading()));
        }
        const double best = *std::max_element(correlations.begin(), correlations.end());
        if (correlations.front() > explains) agree(verdict);
        const auto unexplained = [](double c) { return 1 - c * std::max(0.0, c); };
        const bool contradicted = unexplained(correlations.front()) > 2.5 * unexplained(best) + 0.1;
        if (best < unrelated && way_m_ > 4 * least_way_m) {
            verdict.fault = SensorFault::Unusable;
            addTo(verdict.finding,
                  "it does not drive where the camera goes, or sensor_pose is wrong");
        }
        if (best < explains || !contradicted) return;
        const auto simplest = std::find_if(correlations.begin(), correlations.end(),
                                           [&](double c) { return c > best - 0.02; });
        const PlanarAxes& found = all[static_cast<std::size_t>(simplest - correlations.begin())];
        verdict.axes.topLeftCorner<2, 2>() = found.axes;
        verdict.fault = (-found.axes).isIdentity() ? SensorFault::Sign : SensorFault::Axes;
        const bool reversed = found.axes.determinant() < 0;
        addTo(verdict.finding,
              found.fault + (reversed && !heading_known_ ? ", or the heading is negated" : ""));
    }

    static void agree(OdometryVerdict& verdict) {
        if (!verdict.wrong()) verdict.fault = SensorFault::None;
    }

    WheelPath wheels_;
    std::vector<Span> spans_;
    double depth_units_;
    double way_m_ = 0, wheels_way_ = 0, turning_rad_ = 0;
    std::size_t turning_spans_ = 0;
    bool heading_known_ = false;
};

}  // namespace

OdometryVerdict checkOdometry(const std::vector<StampedVector>& readings,
                              const TrackedStretches& base, double depth_units) {
    return OdometryCheck(readings, base, depth_units).verdict();
}

}  // namespace rgbd_graphslam
