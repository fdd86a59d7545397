#include "rgbd_graphslam/synth/laser_scanner.h"

#include <cmath>
#include <limits>

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::uint64_t kScanNoise = 20;
constexpr double kDegree = M_PI / 180;

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}
}  // namespace

SE3 robotScanner() {
    return {Eigen::Matrix3d::Identity(), Vector3d(0.2, 0, 0.25)};
}

LaserScanner::LaserScanner(const World& world, const Scene& scene, const ScannerModel& model,
                           std::uint64_t seed)
    : world_(world), scene_(scene), model_(model), seed_(seed) {
    cut(scene.quads, SE3(), false, still_);
    cut(world.panes, SE3(), true, still_);
}

void LaserScanner::cut(const std::vector<Quad>& quads, const SE3& T_world_body, bool is_pane,
                       std::vector<Segment>& segments) const {
    const double height = robotScanner().t.z();
    for (const Quad& quad : quads) {
        std::vector<Vector2d> crossings;
        for (int i = 0; i < 4; ++i) {
            const Vector3d a = T_world_body * quad.corners[i],
                           b = T_world_body * quad.corners[(i + 1) % 4];
            if ((a.z() > height) == (b.z() > height)) continue;
            const double share = (height - a.z()) / (b.z() - a.z());
            crossings.push_back((a + share * (b - a)).head<2>());
        }
        if (crossings.size() == 2) segments.push_back({crossings[0], crossings[1], is_pane});
    }
}

double LaserScanner::range(const Vector2d& origin, const Vector2d& beam,
                           const std::vector<Segment>& segments) const {
    double nearest = std::numeric_limits<double>::infinity();
    const double least_sine = std::cos(model_.pane_deg * kDegree);
    for (const Segment& segment : segments) {
        const Vector2d along = segment.to - segment.from, off = segment.from - origin;
        const double across = cross(beam, along);
        if (std::abs(across) < 1e-12) continue;
        const double way = cross(off, along) / across, share = cross(off, beam) / across;
        if (way <= 0 || way >= nearest || share < 0 || share > 1) continue;
        if (segment.is_pane && std::abs(across) < least_sine * along.norm()) continue;
        nearest = way;
    }
    return nearest;
}

std::vector<double> LaserScanner::scan(double t, std::uint64_t index) const {
    std::vector<Segment> segments = still_;
    for (std::size_t i = 0; i < world_.movers.size(); ++i) {
        if (world_.movers[i].seen_by == Mover::SeenBy::Color) continue;
        cut(scene_.figures[i].quads, world_.movers[i].pose(t), false, segments);
    }
    const SE3 T_world_laser = world_.motion.T_world_base(t) * robotScanner();
    const double heading = std::atan2(T_world_laser.R(1, 0), T_world_laser.R(0, 0));
    Random random = Random::of(seed_, kScanNoise, index);
    std::vector<double> ranges;
    for (std::size_t i = 0; i < model_.beams(); ++i) {
        const double angle =
            heading + (static_cast<double>(i) * model_.step_deg - 0.5 * model_.field_deg) * kDegree;
        const double met =
            range(T_world_laser.t.head<2>(), {std::cos(angle), std::sin(angle)}, segments);
        const double noisy = met + model_.noise_m * random.normal();
        ranges.push_back(noisy > 0 && noisy < model_.max_range_m ? noisy : 0);
    }
    return ranges;
}

}  // namespace rgbd_graphslam::synth
