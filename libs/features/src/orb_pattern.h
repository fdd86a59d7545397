/** The point pairs that a descriptor compares, for every discrete orientation. */
#pragma once
#include <array>
#include <cstdint>

namespace rgbd_graphslam {

/** Orientations are rounded to 12 degrees so that no point is rotated at run time. */
constexpr int orb_orientations = 30;
/** Farthest that a pattern point or a moment reaches from its corner, px. */
constexpr int orb_patch_radius = 15;
constexpr int orb_bits = 256;

struct OrbPoint {
    std::int8_t x, y;
};
/** Pair i of an orientation is points [2 i] and [2 i + 1]. */
using OrbPattern = std::array<std::array<OrbPoint, 2 * orb_bits>, orb_orientations>;

/** BRIEF's isotropic Gaussian sampling (Calonder et al., ECCV 2010, "G II"), drawn once from a
 * fixed seed. */
const OrbPattern& orbPattern();

}  // namespace rgbd_graphslam
