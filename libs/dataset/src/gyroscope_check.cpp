#include "rgbd_graphslam/dataset/gyroscope_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rgbd_graphslam/dataset/sensor_units.h"
#include "rgbd_graphslam/dataset/signed_axes.h"
#include "running_integral.h"
#include "verdict_text.h"

namespace rgbd_graphslam {
namespace {

constexpr double span_s = 0.15, longest_span_s = 0.5;
constexpr std::size_t most_spans = 1500, fewest_spans = 20;
/** Turning of the camera (RMS about its mean) below which nothing can be told. */
constexpr double least_turning_rad_s = 0.08;
constexpr double delay_step_s = 0.01;
constexpr double fine_step_s = 0.004;
constexpr int most_delay_steps = 50;
constexpr double least_delay_s = 0.05;
/** Correlation of a hypothesis that explains the readings, and of one that explains nothing. */
constexpr double explains = 0.8, unrelated = 0.3;
constexpr double largest_honest_factor = 1.4;

struct Turning {
    double from_s, to_s;
    Eigen::Vector3d rate_rad_s;  // in the gyroscope's axes
};

/** Spans of tracked motion, not overlapping. */
std::vector<Turning> turningsOf(const TrackedStretches& stretches) {
    std::vector<Turning> turnings;
    for (const Trajectory& stretch : stretches) {
        for (std::size_t from = 0, to = 0; to < stretch.size(); ++to) {
            const double passed_s = stretch[to].stamp_s - stretch[from].stamp_s;
            if (passed_s < span_s) continue;
            if (passed_s < longest_span_s) {
                const Eigen::Matrix3d R =
                    stretch[from].T_world_cam.R.transpose() * stretch[to].T_world_cam.R;
                turnings.push_back(
                    {stretch[from].stamp_s, stretch[to].stamp_s, rotationLog(R) / passed_s});
            }
            from = to;
        }
    }
    const std::size_t step = 1 + turnings.size() / most_spans;
    for (std::size_t i = 1; i * step < turnings.size(); ++i) turnings[i] = turnings[i * step];
    turnings.resize((turnings.size() + step - 1) / step);
    return turnings;
}

/** Second moments, about their means, of readings and turning at one delay. */
struct Moments {
    std::size_t count = 0;
    Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();  // readings times turning
    double of_readings = 0, of_turning = 0;           // mean squares

    /** Correlation of readings with the turning, were they put right by these axes. */
    double correlation(const Eigen::Matrix3d& axes) const {
        const double product = of_readings * of_turning;
        return product > 0 ? (axes * cross).trace() / std::sqrt(product) : 0;
    }
};

Moments momentsAt(double delay_s, const RunningIntegral& readings,
                  const std::vector<Turning>& turnings) {
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
    Eigen::Vector3d mean_reading = Eigen::Vector3d::Zero(), mean_turning = mean_reading;
    for (const Turning& turning : turnings) {
        const auto reading = readings.mean(turning.from_s + delay_s, turning.to_s + delay_s);
        if (!reading) continue;
        pairs.emplace_back(*reading, turning.rate_rad_s);
        mean_reading += *reading;
        mean_turning += turning.rate_rad_s;
    }
    Moments moments;
    moments.count = pairs.size();
    if (pairs.empty()) return moments;
    const auto n = static_cast<double>(pairs.size());
    for (const auto& [reading, turning] : pairs) {
        const Eigen::Vector3d r = reading - mean_reading / n, t = turning - mean_turning / n;
        moments.cross += r * t.transpose() / n;
        moments.of_readings += r.squaredNorm() / n;
        moments.of_turning += t.squaredNorm() / n;
    }
    return moments;
}

/** What is left unexplained, as a share of the variance. */
double unexplained(double correlation) {
    return 1 - std::max(0.0, correlation) * std::max(0.0, correlation);
}

/** Whether the better correlation is so by more than noise and small misalignments make. */
bool clearlyBetter(double better, double worse) {
    return unexplained(worse) > 2.5 * unexplained(better) + 0.03;
}

class GyroscopeCheck {
  public:
    GyroscopeCheck(const std::vector<StampedVector>& readings, const TrackedStretches& gyroscope)
        : readings_(readings), turnings_(turningsOf(gyroscope)) {
        for (int step = -most_delay_steps; step <= most_delay_steps; ++step) {
            at_delay_.push_back(momentsAt(step * delay_step_s, readings_, turnings_));
        }
    }

    SensorVerdict verdict() const {
        const Moments& now = at_delay_[most_delay_steps];
        SensorVerdict verdict;
        if (now.count < fewest_spans || now.of_turning < square(least_turning_rad_s)) {
            return verdict;
        }
        const Match best = bestMatch(), as_recorded = bestDelay(Eigen::Matrix3d::Identity());
        if (best.correlation < explains) return disagreement(now, best);
        verdict.fault = SensorFault::None;
        const Match match =
            clearlyBetter(best.correlation, as_recorded.correlation) ? best : as_recorded;
        nameDelay(match, verdict);
        nameFactor(match, verdict);
        nameAxes(match, verdict);
        return verdict;
    }

  private:
    struct Match {
        Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
        int delay = most_delay_steps;
        double correlation = -1;
    };

    static double square(double x) { return x * x; }

    Match bestDelay(const Eigen::Matrix3d& axes) const {
        Match best;
        for (int delay = 0; delay <= 2 * most_delay_steps; ++delay) {
            if (at_delay_[delay].count < fewest_spans) continue;
            const double correlation = at_delay_[delay].correlation(axes);
            if (correlation > best.correlation) best = {axes, delay, correlation};
        }
        return best;
    }

    bool anotherFits(const Match& match) const {
        return std::any_of(signedAxes().begin(), signedAxes().end(),
                           [&](const Eigen::Matrix3d& axes) {
                               return !axes.isApprox(match.axes) &&
                                      asGood(bestDelay(axes).correlation, match.correlation);
                           });
    }

    static bool asGood(double correlation, double best) {
        return unexplained(correlation) < 1.2 * unexplained(best) + 0.002;
    }

    /** The simplest of those that are about as good as the best. */
    Match bestMatch() const {
        std::vector<Match> matches;
        double highest = -1;
        for (const Eigen::Matrix3d& axes : signedAxes()) {
            matches.push_back(bestDelay(axes));
            highest = std::max(highest, matches.back().correlation);
        }
        return *std::find_if(matches.begin(), matches.end(), [&](const Match& match) {
            return asGood(match.correlation, highest);
        });
    }

    /** The peak is a parabola's; its bend tells how well it is known. */
    std::optional<StampDelay> delayOf(const Match& match) const {
        if (match.delay == 0 || match.delay == 2 * most_delay_steps) return std::nullopt;
        const double before = at_delay_[match.delay - 1].correlation(match.axes);
        const double after = at_delay_[match.delay + 1].correlation(match.axes);
        const double bend = before - 2 * match.correlation + after;
        if (bend >= 0) return std::nullopt;
        const int step = match.delay - most_delay_steps;
        const auto n = static_cast<double>(at_delay_[match.delay].count);
        const double coarse_s = delay_step_s * (step + 0.5 * (before - after) / bend);
        return StampDelay{refined(coarse_s, match.axes),
                          delay_step_s * std::sqrt(unexplained(match.correlation) / (n * -bend))};
    }

    /** The parabola through three delays this near to the peak is not bent by what is farther. */
    double refined(double coarse_s, const Eigen::Matrix3d& axes) const {
        const auto at = [&](double delay_s) {
            return momentsAt(delay_s, readings_, turnings_).correlation(axes);
        };
        const double here = at(coarse_s), before = at(coarse_s - fine_step_s),
                     after = at(coarse_s + fine_step_s);
        const double bend = before - 2 * here + after;
        if (bend >= 0) return coarse_s;
        return coarse_s + fine_step_s * std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
    }

    void nameDelay(const Match& match, SensorVerdict& verdict) const {
        verdict.measured_delay = delayOf(match);
        if (!verdict.measured_delay) return;
        constexpr double sigmas = 5;
        const auto [delay_s, sigma_s] = *verdict.measured_delay;
        if (std::abs(delay_s) < std::max(least_delay_s, sigmas * sigma_s)) return;
        verdict.fault = SensorFault::TimeOffset;
        verdict.delay_s = delay_s;
        addTo(verdict.finding, delayText(delay_s));
    }

    void nameFactor(const Match& match, SensorVerdict& verdict) const {
        const Moments& moments = at_delay_[match.delay];
        const double factor = (match.axes * moments.cross).trace() / moments.of_turning;
        if (factor < largest_honest_factor && factor > 1 / largest_honest_factor) return;
        verdict.fault = SensorFault::Unit;
        verdict.factor = factor;
        const auto unit = unitOfFactor(angularVelocityUnits(), factor, 0.15);
        addTo(verdict.finding, "it turns " + factorText(factor) + " times as fast as the camera" +
                                   (unit ? ": it is in " + unit->name : ""));
    }

    void nameAxes(const Match& match, SensorVerdict& verdict) const {
        if (match.axes.isIdentity()) return;
        verdict.axes = match.axes;
        verdict.other_axes_fit = anotherFits(match);
        const bool negated = (-match.axes).isIdentity();
        verdict.fault = negated ? SensorFault::Sign : SensorFault::Axes;
        addTo(verdict.finding, negated ? "it is negated: it turns the other way than the camera"
                                       : "its axes are not where the recording says");
    }

    /** No hypothesis explains the readings. */
    SensorVerdict disagreement(const Moments& now, const Match& best) const {
        SensorVerdict verdict;
        constexpr double still = 0.05;  // share of the camera's turning
        if (now.of_readings < square(still) * now.of_turning) {
            verdict.fault = SensorFault::Unusable;
            verdict.finding = "its readings hardly change while the camera turns";
            return verdict;
        }
        const bool well_seen =
            now.count >= 2 * fewest_spans && now.of_turning > square(2 * least_turning_rad_s);
        if (best.correlation > unrelated || !well_seen) return verdict;
        verdict.fault = SensorFault::Unusable;
        verdict.finding = "its readings have nothing to do with how the camera turns";
        return verdict;
    }

    RunningIntegral readings_;
    std::vector<Turning> turnings_;
    std::vector<Moments> at_delay_;
};

}  // namespace

SensorVerdict checkGyroscope(const std::vector<StampedVector>& readings,
                             const TrackedStretches& gyroscope) {
    return GyroscopeCheck(readings, gyroscope).verdict();
}

}  // namespace rgbd_graphslam
