/** Search for a scan's pose over a whole window. */
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "rgbd_graphslam/laser/planar_scan.h"

namespace rgbd_graphslam {

/** Window of poses around a guess, half widths. */
struct SearchWindow {
    double xy_m = 0.3, yaw_rad = 0.2;
    double yaw_step_rad = 0.01;
};

/** The best pose in a window. */
struct Correlation {
    PlanarPose T_ref_scan;
    /** Mean likelihood of the points, 0 to 1. */
    double score = 0;
    /** Best score of poses further than half a meter or 0.25 rad from the best one: close to
     *  `score` where places look alike. Zero in windows that are not wider. */
    double runner_up = 0;
};

/** A raster of how likely a beam ends in each cell, for exhaustive matching (Olson, "Real-time
 *  correlative scan matching", ICRA 2009): a table of maxima over 8 x 8 cells bounds the score of a
 *  block of translations, and blocks that cannot win are skipped. The result is that of trying
 *  every translation of the raster. */
class CorrelationField {
  public:
    /** \param points of the reference, m; not empty
     *  \param sigma_m standard deviation of where beams end */
    CorrelationField(const std::vector<ScanPoint>& points, double resolution_m, double sigma_m);

    /** \return nothing where the scan has no points */
    std::optional<Correlation> match(const std::vector<ScanPoint>& scan, const PlanarPose& guess,
                                     const SearchWindow& window) const;

    /** Share of the beams from `origin` to the points (reference frame) that pass through an
     *  occupied cell well before they end: the places differ, whatever the ends say. */
    double contradiction(const Eigen::Vector2d& origin,
                         const std::vector<Eigen::Vector2d>& ends) const;

  private:
    static constexpr int block = 8;
    struct Cell {
        int x, y;
    };
    using Table = std::vector<std::uint8_t>;

    void splat(const Eigen::Vector2d& p, const Table& kernel, int radius);
    void buildMaxima();
    int at(const Table& table, int x, int y) const {
        return x < 0 || y < 0 || x >= width_ || y >= height_
                   ? 0
                   : table[static_cast<std::size_t>(y) * width_ + x];
    }
    Cell cellOf(const Eigen::Vector2d& p) const {
        return {static_cast<int>(std::floor((p.x() - low_.x()) / resolution_m_)),
                static_cast<int>(std::floor((p.y() - low_.y()) / resolution_m_))};
    }
    int sum(const Table& table, const std::vector<Cell>& cells, int dx, int dy) const;

    struct Candidate {
        int yaw, dx, dy, bound;
    };
    struct Best;
    void refine(const Candidate& candidate, const std::vector<Cell>& cells, int reach,
                Best& best) const;

    double resolution_m_;
    Eigen::Vector2d low_;
    int width_ = 0, height_ = 0;
    Table field_, maxima_;
};

}  // namespace rgbd_graphslam
