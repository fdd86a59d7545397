/** The generator behind everything random in a synthetic sequence. */
#pragma once
#include <cstdint>

namespace rgbd_graphslam::synth {

/** SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA
 *  2014): the same numbers on every platform, cheap to seed and to split. */
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /** In [0, 1). */
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
    /** In [low, high). */
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /** In [0, count). */
    int below(int count) { return static_cast<int>(uniform() * count); }
    bool chance(double probability) { return uniform() < probability; }
    /** Mean 0, deviation 1. */
    double normal();
    /** An independent generator, the same whatever else was drawn from this one before. */
    static Random of(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index = 0);

  private:
    std::uint64_t state_;
};

/** Normal deviates for whole images: looks a table of quantiles up, so that a sample costs a few
 *  instructions. Tails end at 3.7 deviations. */
class FastNormal {
  public:
    FastNormal();
    /** Two deviates from one draw would do, but one is simpler to keep in step with the pixels. */
    float operator()(Random& random) const { return table_[random.next() >> 52]; }

  private:
    float table_[4096];
};

}  // namespace rgbd_graphslam::synth
