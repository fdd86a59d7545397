#include "rgbd_graphslam/laser/point_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace rgbd_graphslam {
namespace {

/** The first point of each square and quarter of directions. */
std::vector<ScanPoint> thinned(const std::vector<ScanPoint>& points, double spacing_m) {
    using Key = std::tuple<long, long, int>;
    std::vector<std::pair<Key, std::size_t>> keys;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [p, n] = points[i];
        if (!points[i].hasNormal()) continue;
        const int quarter =
            std::abs(n.x()) > std::abs(n.y()) ? (n.x() > 0 ? 0 : 1) : (n.y() > 0 ? 2 : 3);
        keys.push_back(
            {{std::lround(p.x() / spacing_m), std::lround(p.y() / spacing_m), quarter}, i});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<ScanPoint> kept;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        if (k == 0 || keys[k].first != keys[k - 1].first) kept.push_back(points[keys[k].second]);
    }
    return kept;
}

}  // namespace

PointIndex::PointIndex(const std::vector<ScanPoint>& points, double spacing_m) {
    const std::vector<ScanPoint> kept = thinned(points, spacing_m);
    if (kept.empty()) {
        begin_ = {0};
        return;
    }
    Eigen::Vector2d high = kept.front().p;
    low_ = high;
    for (const ScanPoint& point : kept) {
        low_ = low_.cwiseMin(point.p);
        high = high.cwiseMax(point.p);
    }
    columns_ = columnOf(high.x()) + 1;
    rows_ = rowOf(high.y()) + 1;
    const auto cellOf = [&](const ScanPoint& point) {
        return static_cast<std::size_t>(rowOf(point.p.y())) * columns_ + columnOf(point.p.x());
    };
    begin_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (const ScanPoint& point : kept) ++begin_[cellOf(point) + 1];
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    points_.resize(kept.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (const ScanPoint& point : kept) points_[next[cellOf(point)]++] = point;
}

const ScanPoint* PointIndex::nearest(const Eigen::Vector2d& p, const Eigen::Vector2d& normal,
                                     double gate_m) const {
    constexpr double least_cosine = 0.5;
    const bool any_way = normal.isZero();
    const ScanPoint* best = nullptr;
    double best_square = gate_m * gate_m;
    const int x0 = std::max(0, columnOf(p.x() - gate_m)),
              x1 = std::min(columns_ - 1, columnOf(p.x() + gate_m));
    for (int y = std::max(0, rowOf(p.y() - gate_m));
         y <= std::min(rows_ - 1, rowOf(p.y() + gate_m)); ++y) {
        if (x0 > x1) break;
        const std::size_t row = static_cast<std::size_t>(y) * columns_;
        for (std::size_t i = begin_[row + x0]; i < begin_[row + x1 + 1]; ++i) {
            const double square = (points_[i].p - p).squaredNorm();
            if (square >= best_square) continue;
            if (!any_way && points_[i].normal.dot(normal) < least_cosine) continue;
            best = &points_[i];
            best_square = square;
        }
    }
    return best;
}

}  // namespace rgbd_graphslam
