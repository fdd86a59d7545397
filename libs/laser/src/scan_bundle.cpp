#include "scan_bundle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rgbd_graphslam {

std::vector<ScanPoint> bundle(const std::vector<Keyscan>& keyscans, int first, int last,
                              int frame) {
    std::vector<ScanPoint> points;
    const PlanarPose T_frame_world = keyscans[frame].T_world_base.inverse();
    for (int k = first; k <= last; ++k) {
        const PlanarPose T_frame_base = T_frame_world * keyscans[k].T_world_base;
        for (const ScanPoint& point : keyscans[k].scan.points) {
            points.push_back(transformed(T_frame_base, point));
        }
    }
    return points;
}

std::vector<ScanPoint> spacedOut(const std::vector<ScanPoint>& points, double spacing_m) {
    std::vector<std::pair<std::pair<long, long>, std::size_t>> keys;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector2d& p = points[i].p;
        keys.push_back({{std::lround(p.x() / spacing_m), std::lround(p.y() / spacing_m)}, i});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<ScanPoint> kept;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k == 0 || keys[k].first != keys[k - 1].first) kept.push_back(points[keys[k].second]);
    }
    return kept;
}

ScanSpan spanAround(const std::vector<Keyscan>& keyscans, int middle, int most, double way_m) {
    ScanSpan span{middle, middle};
    const double path_m = keyscans[middle].path_m;
    const int count = static_cast<int>(keyscans.size());
    while (span.first > 0 && middle - span.first < most &&
           path_m - keyscans[span.first - 1].path_m <= way_m) {
        --span.first;
    }
    while (span.last + 1 < count && span.last - middle < most &&
           keyscans[span.last + 1].path_m - path_m <= way_m) {
        ++span.last;
    }
    return span;
}

}  // namespace rgbd_graphslam
