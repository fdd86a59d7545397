/** 256-bit binary descriptors. */
#pragma once
#include <array>
#include <cstdint>

namespace rgbd_graphslam {

using Descriptor = std::array<std::uint64_t, 4>;

/** Number of bits that differ, 0 to 256. */
inline int hammingDistance(const Descriptor& a, const Descriptor& b) {
    int bits = 0;
    for (int i = 0; i < 4; ++i) bits += __builtin_popcountll(a[i] ^ b[i]);
    return bits;
}

}  // namespace rgbd_graphslam
