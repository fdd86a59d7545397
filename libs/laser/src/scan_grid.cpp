#include "rgbd_graphslam/laser/scan_grid.h"

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

// Log-odds in steps of 0.05; sensor model of OctoMap: hit 0.7, miss 0.4.
constexpr int hit = 17, miss = -8, most = 70, least = -40;
constexpr double step = 0.05;

/** A raster whose cells begin at multiples of the resolution. */
class Raster {
  public:
    Raster(const std::vector<ScanBeams>& scans, double resolution_m, int memory_limit_mb)
        : resolution_m_(resolution_m) {
        Eigen::Vector2d low = scans.front().origin, high = low;
        for (const ScanBeams& scan : scans) {
            for (const Eigen::Vector2d& end : scan.ends) {
                low = low.cwiseMin(end);
                high = high.cwiseMax(end);
            }
            low = low.cwiseMin(scan.origin);
            high = high.cwiseMax(scan.origin);
        }
        x0 = cellOf(low.x()) - 1;
        y0 = cellOf(low.y()) - 1;
        const double columns = cellOf(high.x()) + 2.0 - x0, rows = cellOf(high.y()) + 2.0 - y0;
        const double megabytes = 1e-6 * columns * rows * bytes_a_cell;
        if (megabytes > memory_limit_mb) {
            throw Error(
                formatted("the grid of %.0f x %.0f cells needs %.0f MB", columns, rows, megabytes),
                formatted("set grid_resolution_m to %.3g",
                          resolution_m * std::sqrt(megabytes / memory_limit_mb)));
        }
        width = static_cast<int>(columns);
        height = static_cast<int>(rows);
        log_odds.assign(static_cast<std::size_t>(width) * height, unknown);
        touched_.assign(log_odds.size(), 0);
    }

    void insert(const ScanBeams& scan) {
        ++scan_;
        for (const Eigen::Vector2d& end : scan.ends) touch(indexOf(end), hit);
        for (const Eigen::Vector2d& end : scan.ends) pass(scan.origin, end);
    }

    static constexpr std::int8_t unknown = std::numeric_limits<std::int8_t>::min();
    int x0 = 0, y0 = 0, width = 0, height = 0;
    std::vector<std::int8_t> log_odds;

  private:
    static constexpr double bytes_a_cell = 9;  // with those of the finished grid

    int cellOf(double m) const { return static_cast<int>(std::floor(m / resolution_m_)); }
    std::size_t indexOf(const Eigen::Vector2d& p) const {
        return static_cast<std::size_t>(cellOf(p.y()) - y0) * width + (cellOf(p.x()) - x0);
    }

    /** Once per scan; hits come first. */
    void touch(std::size_t cell, int change) {
        if (touched_[cell] == scan_) return;
        touched_[cell] = scan_;
        const int before = log_odds[cell] == unknown ? 0 : log_odds[cell];
        log_odds[cell] = static_cast<std::int8_t>(std::clamp(before + change, least, most));
    }

    void pass(const Eigen::Vector2d& origin, const Eigen::Vector2d& end) {
        const double length = (end - origin).norm();
        const Eigen::Vector2d along = (end - origin) / std::max(length, 1e-9);
        const double stride = 0.7 * resolution_m_;
        for (double way = 0; way < length - resolution_m_; way += stride) {
            touch(indexOf(origin + way * along), miss);
        }
    }

    double resolution_m_;
    std::vector<std::uint32_t> touched_;
    std::uint32_t scan_ = 0;
};

Raster rasterOf(const std::vector<ScanBeams>& scans, double resolution_m, int memory_limit_mb) {
    Raster raster(scans, resolution_m, memory_limit_mb);
    for (const ScanBeams& scan : scans) raster.insert(scan);
    return raster;
}

float freeProbability(int log_odds) {
    return static_cast<float>(1 / (1 + std::exp(step * log_odds)));
}

}  // namespace

ScanGrid::ScanGrid(double resolution_m) : resolution_m_(resolution_m) {}

void ScanGrid::insert(const ScanBeams& beams) {
    scans_.push_back(beams);
}

void ScanGrid::build(mrpt::maps::COccupancyGridMap2D& grid, int memory_limit_mb) const {
    const double r = resolution_m_;
    if (scans_.empty()) {
        grid.setSize(0, r, 0, r, r, 0.5f);
        return;
    }
    const Raster raster = rasterOf(scans_, r, memory_limit_mb);
    grid.setSize(r * raster.x0, r * (raster.x0 + raster.width), r * raster.y0,
                 r * (raster.y0 + raster.height), r, 0.5f);
    for (int y = 0; y < raster.height; ++y) {
        for (int x = 0; x < raster.width; ++x) {
            const int value = raster.log_odds[static_cast<std::size_t>(y) * raster.width + x];
            if (value != Raster::unknown) grid.setCell(x, y, freeProbability(value));
        }
    }
}

void ScanGrid::mergeInto(mrpt::maps::COccupancyGridMap2D& grid, int memory_limit_mb) const {
    if (scans_.empty()) return;
    constexpr float even = 0.5f;
    mrpt::maps::COccupancyGridMap2D of_scans;
    build(of_scans, memory_limit_mb);
    const float r = static_cast<float>(resolution_m_);
    grid.resizeGrid(std::min(grid.getXMin(), of_scans.getXMin()),
                    std::max(grid.getXMax(), of_scans.getXMax()),
                    std::min(grid.getYMin(), of_scans.getYMin()),
                    std::max(grid.getYMax(), of_scans.getYMax()), even, false);
    const int dx = static_cast<int>(std::lround((of_scans.getXMin() - grid.getXMin()) / r)),
              dy = static_cast<int>(std::lround((of_scans.getYMin() - grid.getYMin()) / r));
    for (int y = 0; y < static_cast<int>(of_scans.getSizeY()); ++y) {
        for (int x = 0; x < static_cast<int>(of_scans.getSizeX()); ++x) {
            const float seen = of_scans.getCell(x, y), there = grid.getCell(x + dx, y + dy);
            const bool is_unknown = std::abs(there - even) < 0.01f;
            if (seen < std::min(even, there) || (is_unknown && seen > even)) {
                grid.setCell(x + dx, y + dy, seen);
            }
        }
    }
}

}  // namespace rgbd_graphslam
