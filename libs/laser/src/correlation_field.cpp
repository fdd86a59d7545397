#include "rgbd_graphslam/laser/correlation_field.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr int full = 255;

/** Likelihood around a point, a square of 2 * radius + 1 cells. */
std::vector<std::uint8_t> gaussianKernel(int radius, double sigma_cells) {
    std::vector<std::uint8_t> kernel;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            const double chi2 = (x * x + y * y) / (sigma_cells * sigma_cells);
            kernel.push_back(static_cast<std::uint8_t>(std::lround(full * std::exp(-0.5 * chi2))));
        }
    }
    return kernel;
}

}  // namespace

CorrelationField::CorrelationField(const std::vector<ScanPoint>& points, double resolution_m,
                                   double sigma_m)
    : resolution_m_(resolution_m) {
    const int radius = static_cast<int>(std::ceil(2.5 * sigma_m / resolution_m));
    Eigen::Vector2d high = points.front().p;
    low_ = high;
    for (const ScanPoint& point : points) {
        low_ = low_.cwiseMin(point.p);
        high = high.cwiseMax(point.p);
    }
    low_.array() -= (radius + 1) * resolution_m;
    high.array() += (radius + 1) * resolution_m;
    const Cell last = cellOf(high);
    width_ = last.x + 1;
    height_ = last.y + 1;
    field_.assign(static_cast<std::size_t>(width_) * height_, 0);
    const Table kernel = gaussianKernel(radius, sigma_m / resolution_m);
    for (const ScanPoint& point : points) splat(point.p, kernel, radius);
    buildMaxima();
}

void CorrelationField::splat(const Eigen::Vector2d& p, const Table& kernel, int radius) {
    const Cell center = cellOf(p);
    if (field_[static_cast<std::size_t>(center.y) * width_ + center.x] == full) return;
    const int side = 2 * radius + 1;
    for (int y = 0; y < side; ++y) {
        auto* row =
            &field_[static_cast<std::size_t>(center.y + y - radius) * width_ + center.x - radius];
        for (int x = 0; x < side; ++x) row[x] = std::max(row[x], kernel[y * side + x]);
    }
}

/** maxima(x, y) is the largest value of field [x, x + block) x [y, y + block). Cells left of and
 *  below the field, whose blocks reach into it, are stored clamped by at(): see sum(). */
void CorrelationField::buildMaxima() {
    Table rows(field_.size(), 0);
    for (int y = 0; y < height_; ++y) {
        const auto* in = &field_[static_cast<std::size_t>(y) * width_];
        auto* out = &rows[static_cast<std::size_t>(y) * width_];
        for (int x = 0; x < width_; ++x) {
            out[x] = *std::max_element(in + x, in + std::min(width_, x + block));
        }
    }
    maxima_.assign(field_.size(), 0);
    for (int y = 0; y < height_; ++y) {
        auto* out = &maxima_[static_cast<std::size_t>(y) * width_];
        for (int k = y; k < std::min(height_, y + block); ++k) {
            const auto* in = &rows[static_cast<std::size_t>(k) * width_];
            for (int x = 0; x < width_; ++x) out[x] = std::max(out[x], in[x]);
        }
    }
}

int CorrelationField::sum(const Table& table, const std::vector<Cell>& cells, int dx,
                          int dy) const {
    int total = 0;
    const bool is_bound = &table == &maxima_;
    for (const Cell& cell : cells) {
        int x = cell.x + dx, y = cell.y + dy;
        if (is_bound) {  // blocks that begin outside of the field reach into it
            if (x < 0 && x > -block) x = 0;
            if (y < 0 && y > -block) y = 0;
        }
        total += at(table, x, y);
    }
    return total;
}

struct CorrelationField::Best {
    int score = -1, yaw = 0, dx = 0, dy = 0;
    /** Best of the other region. */
    int runner_up = 0;
    int far_cells = 0, far_yaws = 0;

    bool isNear(int other_yaw, int x, int y) const {
        return std::abs(x - dx) <= far_cells && std::abs(y - dy) <= far_cells &&
               std::abs(other_yaw - yaw) <= far_yaws;
    }
    /** \return whether a candidate of this bound can still change anything */
    bool interestedIn(const Candidate& c) const {
        const bool may_be_far =
            !isNear(c.yaw, c.dx, c.dy) || !isNear(c.yaw, c.dx + block - 1, c.dy + block - 1);
        return c.bound > score || (may_be_far && c.bound > runner_up);
    }
    void note(int other_score, int other_yaw, int x, int y) {
        if (other_score > score) {
            if (!isNear(other_yaw, x, y)) runner_up = std::max(runner_up, score);
            score = other_score;
            yaw = other_yaw;
            dx = x;
            dy = y;
        } else if (!isNear(other_yaw, x, y)) {
            runner_up = std::max(runner_up, other_score);
        }
    }
};

void CorrelationField::refine(const Candidate& candidate, const std::vector<Cell>& cells, int reach,
                              Best& best) const {
    for (int dy = candidate.dy; dy < std::min(candidate.dy + block, reach + 1); ++dy) {
        for (int dx = candidate.dx; dx < std::min(candidate.dx + block, reach + 1); ++dx) {
            best.note(sum(field_, cells, dx, dy), candidate.yaw, dx, dy);
        }
    }
}

std::optional<Correlation> CorrelationField::match(const std::vector<ScanPoint>& scan,
                                                   const PlanarPose& guess,
                                                   const SearchWindow& window) const {
    if (scan.empty()) return std::nullopt;
    const int reach = static_cast<int>(std::ceil(window.xy_m / resolution_m_));
    const int yaws = static_cast<int>(std::ceil(window.yaw_rad / window.yaw_step_rad));
    const auto poseOf = [&](int yaw, int dx, int dy) {
        return PlanarPose{guess.x + dx * resolution_m_, guess.y + dy * resolution_m_,
                          wrapped(guess.yaw + yaw * window.yaw_step_rad)};
    };
    std::vector<std::vector<Cell>> cells(2 * yaws + 1);
    std::vector<Candidate> candidates;
    for (int yaw = -yaws; yaw <= yaws; ++yaw) {
        auto& turned = cells[yaw + yaws];
        for (const ScanPoint& point : scan) {
            turned.push_back(cellOf(transformed(poseOf(yaw, 0, 0), point.p)));
        }
        for (int dy = -reach; dy <= reach; dy += block) {
            for (int dx = -reach; dx <= reach; dx += block) {
                candidates.push_back({yaw, dx, dy, sum(maxima_, turned, dx, dy)});
            }
        }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.bound > b.bound; });
    Best best;
    best.far_cells = static_cast<int>(std::lround(0.5 / resolution_m_));
    best.far_yaws = static_cast<int>(std::lround(0.25 / window.yaw_step_rad));
    for (const Candidate& candidate : candidates) {
        if (candidate.bound <= best.runner_up) break;
        if (best.interestedIn(candidate))
            refine(candidate, cells[candidate.yaw + yaws], reach, best);
    }
    const double most = full * static_cast<double>(scan.size());
    return Correlation{poseOf(best.yaw, best.dx, best.dy), best.score / most,
                       best.runner_up / most};
}

double CorrelationField::contradiction(const Eigen::Vector2d& origin,
                                       const std::vector<Eigen::Vector2d>& ends) const {
    constexpr double margin_m = 0.4;
    constexpr int occupied = 200;
    std::size_t crossed = 0;
    for (const Eigen::Vector2d& end : ends) {
        const double length = (end - origin).norm() - margin_m;
        const Eigen::Vector2d along = (end - origin).normalized();
        for (double way = margin_m; way < length; way += 0.7 * resolution_m_) {
            const Cell cell = cellOf(origin + way * along);
            if (at(field_, cell.x, cell.y) < occupied) continue;
            ++crossed;
            break;
        }
    }
    return ends.empty() ? 0 : static_cast<double>(crossed) / static_cast<double>(ends.size());
}

}  // namespace rgbd_graphslam
