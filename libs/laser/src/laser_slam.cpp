#include "rgbd_graphslam/laser/laser_slam.h"

#include <algorithm>
#include <cmath>

#include "loop_verification.h"
#include "planar_edge.h"
#include "scan_bundle.h"

namespace rgbd_graphslam {
namespace {

constexpr double degree = M_PI / 180;

/** Variances of (x, y, yaw) that a motion adds. */
Eigen::Vector3d varianceOf(const PlanarPose& motion, bool measured, const LaserOptions& options) {
    constexpr double least_m = 0.01, least_rad = 0.005;
    constexpr double guessed_m = 0.1, guessed_rad = 0.1;
    const double way = positionOf(motion).norm(), turn = std::abs(wrapped(motion.yaw));
    double xy = least_m + options.odometry_xy_share * way;
    double yaw = least_rad + options.odometry_yaw_share * turn +
                 options.odometry_yaw_deg_per_m * degree * way;
    if (!measured) {
        xy += guessed_m + 0.5 * way;
        yaw += guessed_rad + 0.5 * turn;
    }
    return {xy * xy, xy * xy, yaw * yaw};
}

double distance(const PlanarPose& a, const PlanarPose& b) {
    return (positionOf(a) - positionOf(b)).norm();
}

}  // namespace

class LaserSlam::Implementation {
  public:
    explicit Implementation(const LaserOptions& options) : options_(options) {}

    TrackedScan add(const PlanarScan& scan, const std::optional<PlanarPose>& odometry) {
        if (keyscans.empty()) return begin(scan, odometry);
        const bool measured = odometry && last_odometry_;
        const PlanarPose motion = measured ? last_odometry_->inverse() * *odometry
                                           : carriedOn(scan.stamp_s - scans.back().stamp_s);
        const Eigen::Vector3d variance = varianceOf(motion, measured, options_);
        variance_ += variance;
        variance_since_keyscan_ += variance;
        const PlanarPose guess = pose_ * motion;
        const auto aligned = align(scan, guess, motion, measured);
        const PlanarPose pose = aligned ? aligned->T_ref_scan : guess;
        note(scan, pose, aligned, odometry);
        return scans.back();
    }

    void finish() {
        if (keyscans.size() < 2) return;
        optimize();
        for (int round = 0; round < options_.refinement_rounds; ++round) {
            tieNeighbors();
            optimize();
        }
    }

    std::vector<TrackedScan> scans;
    std::vector<Keyscan> keyscans;
    std::vector<PoseEdge> edges;
    std::size_t rejected = 0;

  private:
    TrackedScan begin(const PlanarScan& scan, const std::optional<PlanarPose>& odometry) {
        keyscans.push_back({scan, {}, {}, 0});
        scans.push_back({scan.stamp_s, 0, {}, true, true, scan.points.size(), 0});
        last_odometry_ = odometry;
        renewSubmap();
        return scans.back();
    }

    /** Constant velocity. */
    PlanarPose carriedOn(double passed_s) const {
        constexpr double longest_s = 1;
        if (last_step_s_ <= 0 || passed_s > longest_s) return {};
        const double share = passed_s / last_step_s_;
        return {share * last_step_.x, share * last_step_.y, share * last_step_.yaw};
    }

    AlignmentOptions alignmentOptions() const {
        AlignmentOptions alignment;
        alignment.sigma_m = options_.point_sigma_m;
        return alignment;
    }

    static bool holds(const std::optional<ScanAlignment>& aligned) {
        constexpr double least_share = 0.35;
        constexpr std::size_t least_inliers = 12;
        return aligned && aligned->inlier_share >= least_share && aligned->inliers >= least_inliers;
    }

    /** ICP from the predicted pose; a correlative search first where that may be too far off, or
     *  where ICP does not hold. */
    std::optional<ScanAlignment> align(const PlanarScan& scan, const PlanarPose& guess,
                                       const PlanarPose& motion, bool measured) {
        constexpr double far_m = 0.3, far_rad = 0.2, good_share = 0.6;
        if (scan.points.empty()) return std::nullopt;
        const PlanarPrior prior{guess, variance_.cwiseInverse().asDiagonal()};
        auto aligned = alignScan(*submap_, scan.points, guess, prior, alignmentOptions());
        const bool is_far = !measured || positionOf(motion).norm() > far_m ||
                            std::abs(wrapped(motion.yaw)) > far_rad;
        if (is_far || !holds(aligned) || aligned->inlier_share < good_share) {
            const auto searched = searchAround(scan, guess, prior);
            if (searched && (!aligned || searched->inlier_share > aligned->inlier_share + 0.02))
                aligned = searched;
        }
        return holds(aligned) ? aligned : std::nullopt;
    }

    std::optional<ScanAlignment> searchAround(const PlanarScan& scan, const PlanarPose& guess,
                                              const PlanarPrior& prior) {
        constexpr double cell_m = 0.05, sigma_m = 0.08, step_rad = 0.015;
        if (submap_points_.empty()) return std::nullopt;
        if (!field_) field_.emplace(submap_points_, cell_m, sigma_m);
        const SearchWindow window{std::clamp(3 * std::sqrt(variance_.x()), 0.15, 0.6),
                                  std::clamp(3 * std::sqrt(variance_.z()), 0.1, 0.5), step_rad};
        const auto found = field_->match(scan.points, guess, window);
        if (!found) return std::nullopt;
        return alignScan(*submap_, scan.points, found->T_ref_scan, prior, alignmentOptions());
    }

    void note(const PlanarScan& scan, const PlanarPose& pose,
              const std::optional<ScanAlignment>& aligned,
              const std::optional<PlanarPose>& odometry) {
        last_step_ = pose_.inverse() * pose;
        last_step_s_ = scan.stamp_s - scans.back().stamp_s;
        last_odometry_ = odometry;
        pose_ = pose;
        if (aligned) variance_.setZero();
        const int last = static_cast<int>(keyscans.size()) - 1;
        const PlanarPose moved = keyscans[last].T_world_base.inverse() * pose;
        scans.push_back({scan.stamp_s, last, moved, aligned.has_value(), false,
                         aligned ? aligned->inliers : 0, aligned ? aligned->rms_m : 0});
        const bool is_due = positionOf(moved).norm() >= options_.keyscan_distance_m ||
                            std::abs(wrapped(moved.yaw)) >= options_.keyscan_angle_deg * degree;
        if (!is_due) return;
        addKeyscan(scan, moved, aligned);
        scans.back().keyscan = last + 1;
        scans.back().T_keyscan_base = {};
        scans.back().is_keyscan = true;
    }

    void addKeyscan(const PlanarScan& scan, const PlanarPose& T_last_now,
                    const std::optional<ScanAlignment>& aligned) {
        const int now = static_cast<int>(keyscans.size());
        const Keyscan& last = keyscans.back();
        Eigen::Matrix3d information = variance_since_keyscan_.cwiseInverse().asDiagonal();
        if (aligned) information += aligned->information;
        edges.push_back(planarEdge(now - 1, now, T_last_now, information, EdgeKind::Sequential,
                                   aligned ? static_cast<int>(aligned->inliers) : 0));
        keyscans.push_back({scan, last.T_world_base * T_last_now, last.T_tracked_base * T_last_now,
                            last.path_m + positionOf(T_last_now).norm()});
        variance_since_keyscan_.setZero();
        searchLoops(now);
        renewSubmap();
    }

    void renewSubmap() {
        const int last = static_cast<int>(keyscans.size()) - 1;
        const int first = std::max(0, last + 1 - options_.submap_scans);
        submap_points_.clear();
        for (int k = first; k <= last; ++k) {
            for (const ScanPoint& point : keyscans[k].scan.points) {
                submap_points_.push_back(transformed(keyscans[k].T_world_base, point));
            }
        }
        submap_.emplace(submap_points_);
        field_.reset();
    }

    double wayWithoutLoop(int now) const { return keyscans[now].path_m - loop_path_m_; }

    SearchWindow loopWindow(int now) const {
        const double way_m = wayWithoutLoop(now);
        SearchWindow window;
        window.xy_m = std::min(options_.loop_max_window_m, 0.3 + 0.03 * way_m);
        window.yaw_rad = std::min(40.0, 6 + 0.3 * way_m) * degree;
        window.yaw_step_rad = (window.xy_m > 0.75 ? 1.5 : 0.75) * degree;
        return window;
    }

    /** Nearest older keyscans, each of another pass. */
    std::vector<int> loopCandidates(int now, double farthest_m, double least_way_m,
                                    std::size_t most, int apart) const {
        std::vector<std::pair<double, int>> near;
        for (int k = 0; k < now; ++k) {
            if (keyscans[now].path_m - keyscans[k].path_m < least_way_m) break;
            const double m = distance(keyscans[k].T_world_base, keyscans[now].T_world_base);
            if (m <= farthest_m) near.push_back({m, k});
        }
        std::sort(near.begin(), near.end());
        std::vector<int> chosen;
        for (const auto& [m, k] : near) {
            const int index = k;
            const bool is_new = std::none_of(chosen.begin(), chosen.end(), [&](int other) {
                return std::abs(other - index) < apart;
            });
            if (is_new) chosen.push_back(k);
            if (chosen.size() == most) break;
        }
        return chosen;
    }

    void searchLoops(int now) {
        constexpr double least_way_m = 8, reach_m = 3;
        constexpr std::size_t most = 3;
        constexpr int apart = 20;
        if (options_.loop_max_window_m <= 0) return;
        const SearchWindow window = loopWindow(now);
        const double every_m = std::max(0.5, 0.25 * window.xy_m);
        if (keyscans[now].path_m - searched_path_m_ < every_m) return;
        searched_path_m_ = keyscans[now].path_m;
        for (const int old : loopCandidates(now, window.xy_m + reach_m, least_way_m, most, apart)) {
            const auto loop = verifiedLoop(keyscans, old, now, window, options_);
            if (loop && consider(*loop, window)) return;
        }
    }

    /** Where the loop would put keyscan `now`. */
    PlanarPose implied(const ScanLoop& loop) const {
        return keyscans[loop.old].T_world_base * loop.alignment.T_ref_scan;
    }

    /** How the loop would move the newest part of the map. */
    PlanarPose correction(const ScanLoop& loop) const {
        return implied(loop) * keyscans[loop.now].T_world_base.inverse();
    }

    bool agree(const ScanLoop& a, const ScanLoop& b) const {
        constexpr double most_m = 0.4, most_rad = 0.05;
        const PlanarPose by_a = correction(a) * keyscans[b.now].T_world_base;
        return distance(by_a, implied(b)) < most_m &&
               std::abs(wrapped(by_a.yaw - implied(b).yaw)) < most_rad;
    }

    /** \return whether the loop was accepted */
    bool consider(const ScanLoop& loop, const SearchWindow& window) {
        constexpr double sure_window_m = 0.75, longest_wait_m = 15;
        if (window.xy_m <= sure_window_m) {
            accept({loop});
            return true;
        }
        const double path_m = keyscans[loop.now].path_m;
        pending_.erase(std::remove_if(pending_.begin(), pending_.end(),
                                      [&](const ScanLoop& other) {
                                          const bool late =
                                              path_m - keyscans[other.now].path_m > longest_wait_m;
                                          rejected += late;
                                          return late;
                                      }),
                       pending_.end());
        const auto second = std::find_if(pending_.begin(), pending_.end(), [&](const auto& other) {
            return other.now < loop.now && agree(other, loop);
        });
        if (second == pending_.end()) {
            pending_.push_back(loop);
            return false;
        }
        const ScanLoop first = *second;
        rejected += pending_.size() - 1;
        pending_.clear();
        accept({first, loop});
        return true;
    }

    void accept(const std::vector<ScanLoop>& loops) {
        constexpr double still_m = 0.05, still_rad = 0.01;
        const ScanLoop& last = loops.back();
        const PlanarPose off = keyscans[last.now].T_world_base.inverse() * implied(last);
        for (const ScanLoop& loop : loops) {
            edges.push_back(planarEdge(loop.old, loop.now, loop.alignment.T_ref_scan,
                                       loop.alignment.information, EdgeKind::Loop,
                                       static_cast<int>(loop.alignment.inliers)));
        }
        loop_path_m_ = keyscans[last.now].path_m;
        if (positionOf(off).norm() < still_m && std::abs(wrapped(off.yaw)) < still_rad) return;
        optimize();
        pose_ = keyscans[last.now].T_world_base;
    }

    /** Loops, and neighbors tied at the end, get the robust kernel. */
    void optimize() {
        do {
            PoseGraph graph;
            for (const Keyscan& keyscan : keyscans) {
                graph.nodes.push_back(toSE3(keyscan.T_world_base));
            }
            graph.edges = edges;
            for (PoseEdge& edge : graph.edges) {
                if (edge.kind == EdgeKind::Covisibility) edge.kind = EdgeKind::Loop;
            }
            optimizePoseGraph(graph, {});
            for (std::size_t k = 0; k < keyscans.size(); ++k) {
                keyscans[k].T_world_base = toPlanar(graph.nodes[k]);
            }
        } while (dropContradicted());
    }

    bool isContradicted(const PoseEdge& edge) const {
        constexpr double most_m = 0.5, most_rad = 0.1;
        const PlanarPose found =
            keyscans[edge.from].T_world_base.inverse() * keyscans[edge.to].T_world_base;
        const PlanarPose off = toPlanar(edge.T_from_to).inverse() * found;
        return positionOf(off).norm() > most_m || std::abs(wrapped(off.yaw)) > most_rad;
    }

    bool dropContradicted() {
        const auto wrong = std::remove_if(edges.begin(), edges.end(), [&](const PoseEdge& edge) {
            return edge.kind != EdgeKind::Sequential && isContradicted(edge);
        });
        const auto count = static_cast<std::size_t>(edges.end() - wrong);
        rejected += count;
        edges.erase(wrong, edges.end());
        return count > 0;
    }

    void tieNeighbors() {
        constexpr double farthest_m = 2.5, least_way_m = 4;
        constexpr std::size_t most = 2;
        constexpr int apart = 10;
        edges.erase(std::remove_if(
                        edges.begin(), edges.end(),
                        [](const PoseEdge& edge) { return edge.kind == EdgeKind::Covisibility; }),
                    edges.end());
        for (int now = 0; now < static_cast<int>(keyscans.size()); ++now) {
            for (const int old : loopCandidates(now, farthest_m, least_way_m, most, apart)) {
                const auto tie = neighborAlignment(keyscans, old, now, options_);
                if (!tie) continue;
                edges.push_back(planarEdge(old, now, tie->alignment.T_ref_scan,
                                           tie->alignment.information, EdgeKind::Covisibility,
                                           static_cast<int>(tie->alignment.inliers)));
            }
        }
    }

    const LaserOptions options_;
    PlanarPose pose_, last_step_;
    double last_step_s_ = 0;
    std::optional<PlanarPose> last_odometry_;
    /** Of the predicted pose since the last alignment, and of the motion since the last keyscan. */
    Eigen::Vector3d variance_ = Eigen::Vector3d::Zero(),
                    variance_since_keyscan_ = Eigen::Vector3d::Zero();
    std::vector<ScanPoint> submap_points_;
    std::optional<PointIndex> submap_;
    std::optional<CorrelationField> field_;
    double loop_path_m_ = 0, searched_path_m_ = 0;
    std::vector<ScanLoop> pending_;
};

LaserSlam::LaserSlam(const LaserOptions& options)
    : impl_(std::make_unique<Implementation>(options)) {}

LaserSlam::~LaserSlam() = default;

TrackedScan LaserSlam::add(const PlanarScan& scan, const std::optional<PlanarPose>& odometry) {
    return impl_->add(scan, odometry);
}

void LaserSlam::finish() {
    impl_->finish();
}

const std::vector<TrackedScan>& LaserSlam::scans() const {
    return impl_->scans;
}

const std::vector<Keyscan>& LaserSlam::keyscans() const {
    return impl_->keyscans;
}

const std::vector<PoseEdge>& LaserSlam::edges() const {
    return impl_->edges;
}

PlanarPose LaserSlam::poseOf(const TrackedScan& scan) const {
    return impl_->keyscans[scan.keyscan].T_world_base * scan.T_keyscan_base;
}

std::size_t LaserSlam::rejectedLoops() const {
    return impl_->rejected;
}

}  // namespace rgbd_graphslam
