#include "rgbd_graphslam/synth/random.h"

#include <cmath>

namespace rgbd_graphslam::synth {

namespace {
/** Inverse of the standard normal distribution, by Newton steps on its error function. */
double normalQuantile(double share) {
    const double pi = std::acos(-1.0);
    double x = 0;
    for (int step = 0; step < 60; ++step) {
        const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - share;
        const double density = std::exp(-0.5 * x * x) / std::sqrt(2 * pi);
        const double move = error / density;
        x -= std::fmax(-0.5, std::fmin(0.5, move));
    }
    return x;
}
}  // namespace

double Random::normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::acos(-1.0) * uniform());
}

Random Random::of(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index) {
    Random mixer(seed);
    mixer.state_ ^= Random(purpose * 0x100000001b3ULL + 7).next();
    mixer.state_ ^= Random(index + 0x51ed270b9f3dULL).next();
    return Random(mixer.next());
}

FastNormal::FastNormal() {
    for (int i = 0; i < 2048; ++i) {
        const double x = normalQuantile((i + 0.5) / 4096);
        table_[i] = static_cast<float>(x);
        table_[4095 - i] = static_cast<float>(-x);
    }
}

}  // namespace rgbd_graphslam::synth
