/** How well the surfaces that several keyframes see agree. */
#pragma once
#include <cstddef>
#include <vector>

#include "rgbd_graphslam/mapping/floor.h"

namespace rgbd_graphslam {

/** Distances of single keyframes' surfaces from what all that see the place agree on, along its
 *  normal. */
struct SurfaceSpread {
    /** Surfaces of keyframes that were compared; the figures mean something from some hundreds. */
    std::size_t surfaces = 0;
    double median_m = 0, p95_m = 0;
};

/** Point-to-plane distances between keyframes: the patches of each are averaged over cells of 25 cm
 *  that at least two keyframes see, which takes away most of the sensor's noise, and compared along
 *  the mean normal of the cell. Needs no ground truth: drift, a wrong calibration and things that
 *  moved all pull surfaces apart. What is wrong alike everywhere, as the scale of depth, does not.
 *  \param keyframes the patches of each in one common frame, m */
SurfaceSpread surfaceSpread(const std::vector<SurfaceView>& keyframes);

}  // namespace rgbd_graphslam
