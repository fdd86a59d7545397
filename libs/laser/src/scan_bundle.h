/** Points of several scans in the frame of one. */
#pragma once
#include <vector>

#include "rgbd_graphslam/laser/laser_slam.h"

namespace rgbd_graphslam {

inline ScanPoint transformed(const PlanarPose& pose, const ScanPoint& point) {
    return {transformed(pose, point.p), rotated(pose.yaw, point.normal)};
}

/** Scans [first, last] in the frame of keyscan `frame`. */
std::vector<ScanPoint> bundle(const std::vector<Keyscan>& keyscans, int first, int last, int frame);

/** One point per square of `spacing_m`. */
std::vector<ScanPoint> spacedOut(const std::vector<ScanPoint>& points, double spacing_m);

/** The scans around a keyscan, at most so many and so far along the way on either side. */
struct ScanSpan {
    int first, last;
};
ScanSpan spanAround(const std::vector<Keyscan>& keyscans, int middle, int most, double way_m);

}  // namespace rgbd_graphslam
