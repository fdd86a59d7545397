#include "orb_pattern.h"

#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double sampling_sigma_px = 6.2;  // patch size 31 / 5
constexpr double largest_radius_px = 14.0;

/** SplitMix64 (Steele, Lea and Flood, OOPSLA 2014). */
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /** In (0, 1). */
    double uniform() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return ((z ^ (z >> 31)) >> 11) * 0x1p-53 + 0x1p-54;
    }

  private:
    std::uint64_t state_;
};

struct Point {
    double x, y;
};

Point drawPoint(Random& random) {
    for (;;) {
        const double radius = sampling_sigma_px * std::sqrt(-2 * std::log(random.uniform()));
        const double angle = 2 * pi * random.uniform();
        if (radius <= largest_radius_px)
            return {radius * std::cos(angle), radius * std::sin(angle)};
    }
}

OrbPattern drawPattern() {
    constexpr double shortest_pair_px = 3.0;
    Random random(2011);
    std::array<Point, 2 * orb_bits> points;
    for (int i = 0; i < orb_bits; ++i) {
        do {
            points[2 * i] = drawPoint(random);
            points[2 * i + 1] = drawPoint(random);
        } while (std::hypot(points[2 * i].x - points[2 * i + 1].x,
                            points[2 * i].y - points[2 * i + 1].y) < shortest_pair_px);
    }
    OrbPattern pattern;
    for (int o = 0; o < orb_orientations; ++o) {
        const double c = std::cos(2 * pi * o / orb_orientations);
        const double s = std::sin(2 * pi * o / orb_orientations);
        for (int i = 0; i < 2 * orb_bits; ++i) {
            const Point p = points[i];
            pattern[o][i] = {static_cast<std::int8_t>(std::lround(c * p.x - s * p.y)),
                             static_cast<std::int8_t>(std::lround(s * p.x + c * p.y))};
        }
    }
    return pattern;
}

}  // namespace

const OrbPattern& orbPattern() {
    static const OrbPattern pattern = drawPattern();
    return pattern;
}

}  // namespace rgbd_graphslam
