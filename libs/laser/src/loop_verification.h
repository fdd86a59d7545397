/** Whether a keyscan is where an older one was. */
#pragma once
#include <optional>

#include "rgbd_graphslam/laser/correlation_field.h"
#include "rgbd_graphslam/laser/laser_slam.h"
#include "rgbd_graphslam/laser/scan_alignment.h"

namespace rgbd_graphslam {

/** A measured pose of keyscan `now` in the frame of keyscan `old`. */
struct ScanLoop {
    int old = 0, now = 0;
    ScanAlignment alignment;
};

/** Correlates the last scans with those around an older one, refines, and checks overlap, that no
 *  other pose in the window fits as well, and that beams of neither cross walls of the other. */
std::optional<ScanLoop> verifiedLoop(const std::vector<Keyscan>& keyscans, int old, int now,
                                     const SearchWindow& window, const LaserOptions& options);

/** Aligns a keyscan to those around another one that is near it already. */
std::optional<ScanLoop> neighborAlignment(const std::vector<Keyscan>& keyscans, int old, int now,
                                          const LaserOptions& options);

}  // namespace rgbd_graphslam
