#include "rgbd_graphslam/synth/motion.h"

#include <array>
#include <cmath>

#include "rgbd_graphslam/synth/random.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;
const double kPi = std::acos(-1.0);

/** Six independent sums of sinusoids of about unit size. */
class Wobble {
  public:
    explicit Wobble(std::uint64_t seed) {
        const double hertz[] = {0.55, 1.2, 2.7, 5.8};
        const double share[] = {1, 0.6, 0.18, 0.05};
        Random random = Random::of(seed, 2);
        for (auto& channel : waves_)
            for (int i = 0; i < 4; ++i)
                channel[i] = {2 * kPi * hertz[i] * random.uniform(0.8, 1.2),
                              2 * kPi * random.uniform(), share[i]};
    }
    Vector3d at(double t, int first) const {
        Vector3d sum(0, 0, 0);
        for (int axis = 0; axis < 3; ++axis)
            for (const Wave& wave : waves_[first + axis])
                sum[axis] += wave.size * std::sin(wave.omega * t + wave.phase);
        return sum;
    }

  private:
    struct Wave {
        double omega, phase, size;
    };
    std::array<std::array<Wave, 4>, 6> waves_;
};

/** Up and down with every step, sideways with every other. */
Vector3d stepping(double t, const Vector3d& right, double size_m) {
    const double steps_hz = 1.8;
    return size_m * (std::sin(2 * kPi * steps_hz * t) * Vector3d(0, 0, 1) +
                     0.6 * std::sin(kPi * steps_hz * t) * right);
}
}  // namespace

Spline::Spline(std::vector<Vector3d> controls, double step_s, bool closed)
    : controls_(std::move(controls)), step_s_(step_s), closed_(closed) {}

double Spline::duration() const {
    const auto count = static_cast<double>(controls_.size());
    return step_s_ * (closed_ ? count : count - 1);
}

const Vector3d& Spline::control(long index) const {
    const long count = static_cast<long>(controls_.size());
    if (closed_) return controls_[((index % count) + count) % count];
    return controls_[std::min(std::max(index, 0L), count - 1)];
}

Vector3d Spline::at(double t) const {
    const double position = t / step_s_, floor = std::floor(position), u = position - floor;
    const long i = static_cast<long>(floor);
    const double a = (1 - u) * (1 - u) * (1 - u), b = 3 * u * u * u - 6 * u * u + 4,
                 c = -3 * u * u * u + 3 * u * u + 3 * u + 1, d = u * u * u;
    return (a * control(i - 1) + b * control(i) + c * control(i + 1) + d * control(i + 2)) / 6;
}

Vector3d Spline::velocity(double t) const {
    const double position = t / step_s_, floor = std::floor(position), u = position - floor;
    const long i = static_cast<long>(floor);
    const double a = -(1 - u) * (1 - u), b = 3 * u * u - 4 * u, c = -3 * u * u + 2 * u + 1,
                 d = u * u;
    return (a * control(i - 1) + b * control(i) + c * control(i + 1) + d * control(i + 2)) /
           (2 * step_s_);
}

std::vector<Vector3d> evenlySpaced(const std::vector<Vector3d>& corners, double spacing_m,
                                   bool closed) {
    std::vector<Vector3d> way = corners;
    if (closed) way.push_back(corners.front());
    double total = 0;
    for (std::size_t i = 1; i < way.size(); ++i) total += (way[i] - way[i - 1]).norm();
    const int count = std::max(4, static_cast<int>(std::lround(total / spacing_m)));
    std::vector<Vector3d> points;
    double passed = 0;
    std::size_t leg = 1;
    for (int i = 0; i < (closed ? count : count + 1); ++i) {
        const double wanted = total * i / count;
        while (leg + 1 < way.size() && passed + (way[leg] - way[leg - 1]).norm() < wanted)
            passed += (way[leg] - way[leg - 1]).norm(), ++leg;
        const Vector3d edge = way[leg] - way[leg - 1];
        points.push_back(way[leg - 1] + edge * ((wanted - passed) / edge.norm()));
    }
    return points;
}

SE3 lookingAt(const Vector3d& from, const Vector3d& target) {
    const Vector3d forward = (target - from).normalized();
    const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
    Eigen::Matrix3d R;
    R << right, forward.cross(right), forward;
    return {R, from};
}

Eigen::Matrix3d forwardToOptical() {
    Eigen::Matrix3d R;
    R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return R;
}

Motion handHeld(const Spline& positions, const Spline& targets, const Tremble& tremble,
                std::uint64_t seed) {
    Motion motion;
    motion.duration_s = positions.duration();
    const Wobble wobble(seed);
    motion.T_world_cam = [=](double t) {
        SE3 pose = lookingAt(positions.at(t), targets.at(t));
        pose.t +=
            tremble.translation_m * wobble.at(t, 0) + stepping(t, pose.R.col(0), tremble.step_m);
        pose.R = pose.R * rotationExp(tremble.rotation_rad * wobble.at(t, 3));
        return pose;
    };
    return motion;
}

SE3 robotCamera() {
    return {forwardToOptical().transpose(), Vector3d(0.15, 0, 0.6)};
}

Motion planarRobot(const Spline& way) {
    Motion motion;
    motion.duration_s = way.duration();
    motion.T_world_base = [way](double t) {
        const Vector3d at = way.at(t), heading = way.velocity(t);
        return SE3(rotationExp({0, 0, std::atan2(heading.y(), heading.x())}),
                   Vector3d(at.x(), at.y(), 0));
    };
    motion.T_world_cam = [base = motion.T_world_base](double t) { return base(t) * robotCamera(); };
    return motion;
}

}  // namespace rgbd_graphslam::synth
