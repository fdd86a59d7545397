#include "rgbd_graphslam/slam/global_bundle_adjuster.h"

#include "rgbd_graphslam/estimation/global_adjustment.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t most_iterations = 1000;

}  // namespace

GlobalBundleAdjuster::GlobalBundleAdjuster(const SlamOptions& options, const RigCameras& cameras,
                                           SlamMap& map)
    : options_(options), cameras_(cameras), map_(map) {}

/** Nothing while there is only one keyframe. */
std::optional<MapAdjustment> GlobalBundleAdjuster::wholeMap() const {
    std::vector<int> free;
    for (const Keyframe& keyframe : map_.keyframes()) {
        if (!keyframe.culled && !map_.isFixed(keyframe.id)) free.push_back(keyframe.id);
    }
    if (free.empty()) return std::nullopt;
    auto landmarks = landmarksSeenBy(free, map_);
    std::vector<int> fixed;
    for (const Covisibility& c : map_.observers(landmarks)) {
        if (map_.isFixed(c.keyframe)) fixed.push_back(c.keyframe);
    }
    return MapAdjustment(map_, cameras_, options_.sensor, std::move(free), fixed,
                         std::move(landmarks));
}

void GlobalBundleAdjuster::start(int iterations) {
    begun_ = wholeMap();
    if (!begun_) return;
    iterations_ = iterations;
    solveInBackground(*begun_);
}

void GlobalBundleAdjuster::solveInBackground(MapAdjustment adjustment) {
    const int iterations = iterations_;
    pending_ = std::make_unique<BackgroundBundleAdjustment>(
        std::move(adjustment),
        [iterations](BundleProblem& problem) { adjustBundleSparse(problem, iterations); });
}

double GlobalBundleAdjuster::applyPendingAdjustment() {
    const double cpu_ms = pending_->wait();
    pending_->adjustment().carryYounger(map_);
    pending_->adjustment().apply(map_);
    pending_.reset();
    begun_.reset();
    return cpu_ms;
}

void GlobalBundleAdjuster::adjustNow(int iterations) {
    auto adjustment = wholeMap();
    if (!adjustment) return;
    adjustBundleSparse(adjustment->problem, iterations);
    adjustment->apply(map_);
}

void GlobalBundleAdjuster::save(ByteWriter& out) const {
    putFlag(pending(), out);
    if (!pending()) return;
    out.putCount(iterations_);
    begun_->save(out);
}

void GlobalBundleAdjuster::load(ByteReader& in) {
    if (!getFlag(in)) return;
    iterations_ = getIndex(in, most_iterations + 1, "number of iterations");
    begun_.emplace(in, map_, cameras_);
    solveInBackground(*begun_);
}

}  // namespace rgbd_graphslam
