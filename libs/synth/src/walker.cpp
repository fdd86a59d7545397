#include "walker.h"

#include <cmath>

namespace rgbd_graphslam::synth {

namespace {
constexpr double kSpacing_m = 0.5;
constexpr double kStride_m = 1.3;  // two steps
const double kPi = std::acos(-1.0);
}  // namespace

Walker::Walker(const std::vector<Eigen::Vector3d>& way, double speed)
    : way_(evenlySpaced(way, kSpacing_m, true), kSpacing_m / speed, true),
      steps_hz_(speed / kStride_m) {}

SE3 Walker::trunk(double t) const {
    const Eigen::Vector3d at = way_.at(t), heading = way_.velocity(t);
    const double bob = 0.02 * std::cos(4 * kPi * steps_hz_ * t);
    return {rotationExp({0, 0, std::atan2(heading.y(), heading.x())}),
            at + Eigen::Vector3d(0, 0, bob)};
}

SE3 Walker::joint(double t, const Eigen::Vector3d& at, double swing_rad) const {
    return trunk(t) * SE3(rotationExp({0, swing_rad, 0}), at);
}

SE3 Walker::leg(double t, int side) const {
    return joint(t, {0, 0.1 * side, 0.9}, 0.45 * side * std::sin(2 * kPi * steps_hz_ * t));
}

SE3 Walker::arm(double t, int side) const {
    return joint(t, {0, 0.26 * side, 1.43}, -0.4 * side * std::sin(2 * kPi * steps_hz_ * t));
}

void addWalker(const Walker& walker, const std::string& name, std::vector<Mover>& movers,
               double start_s) {
    const auto add = [&](const std::function<SE3(double)>& pose) {
        movers.push_back({name, [=](double t) { return pose(t + start_s); }, std::nullopt});
    };
    add([walker](double t) { return walker.trunk(t); });
    for (int side : {-1, 1}) add([=](double t) { return walker.leg(t, side); });
    for (int side : {-1, 1}) add([=](double t) { return walker.arm(t, side); });
}

}  // namespace rgbd_graphslam::synth
