/** Integrals of a sampled quantity over any span of time. */
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** Linear between samples. A sample that is not later than the one before is left out. */
class RunningIntegral {
  public:
    explicit RunningIntegral(const std::vector<StampedVector>& samples) {
        for (const StampedVector& sample : samples) add(sample);
    }

    /** \return nothing where samples lack or are further apart than longest_gap_s */
    std::optional<Eigen::Vector3d> mean(double from_s, double to_s) const {
        const auto before = at(from_s), after = at(to_s);
        if (!before || !after || before->gaps != after->gaps) return std::nullopt;
        return Eigen::Vector3d((after->sum - before->sum) / (to_s - from_s));
    }

    /** Samples further apart are not joined. */
    static constexpr double longest_gap_s = 0.25;

  private:
    struct Point {
        double stamp_s;
        Eigen::Vector3d value, sum;
        int gaps;
    };

    void add(const StampedVector& sample) {
        Point point{sample.stamp_s, sample.value, Eigen::Vector3d::Zero(), 0};
        if (!points_.empty()) {
            const Point& last = points_.back();
            const double passed_s = sample.stamp_s - last.stamp_s;
            if (passed_s <= 0) return;
            point.sum = last.sum + 0.5 * passed_s * (last.value + sample.value);
            point.gaps = last.gaps + (passed_s > longest_gap_s);
        }
        points_.push_back(point);
    }

    std::optional<Point> at(double stamp_s) const {
        const auto next =
            std::upper_bound(points_.begin(), points_.end(), stamp_s,
                             [](double s, const Point& point) { return s < point.stamp_s; });
        if (next == points_.begin() || next == points_.end()) return std::nullopt;
        const Point& last = *(next - 1);
        if (next->gaps != last.gaps) return std::nullopt;
        const double passed_s = stamp_s - last.stamp_s;
        const double share = passed_s / (next->stamp_s - last.stamp_s);
        const Eigen::Vector3d value = last.value + share * (next->value - last.value);
        return Point{stamp_s, value, last.sum + 0.5 * passed_s * (last.value + value), last.gaps};
    }

    std::vector<Point> points_;
};

}  // namespace rgbd_graphslam
