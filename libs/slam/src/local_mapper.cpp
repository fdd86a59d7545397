#include "rgbd_graphslam/slam/local_mapper.h"

#include <algorithm>

#include "projected_search.h"
#include "rgbd_graphslam/estimation/bundle_adjustment.h"
#include "rgbd_graphslam/slam/keypoint_measurement.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/triangulation.h"

namespace rgbd_graphslam {
namespace {

constexpr int neighbors_joined = 8;
constexpr int neighbors_triangulated = 6;
constexpr int neighbors_culled = 30;
constexpr double join_window_px = 3;
constexpr int join_hamming = 50;
constexpr int probation_keyframes = 3;
constexpr double least_found_share = 0.25;
constexpr int observers_that_make_redundant = 3;

}  // namespace

LocalMapper::LocalMapper(const SlamOptions& options, const RigCameras& cameras, SlamMap& map)
    : options_(options), cameras_(cameras), map_(map) {}

void LocalMapper::insert(int keyframe) {
    createFromDepth(keyframe);
    if (options_.mapper.triangulate) triangulateWithNeighbors(keyframe);
    joinWithNeighbors(keyframe);
    cullLandmarks(keyframe);
    cullKeyframes(keyframe);
    if (map_.fixedCount() > 0) forgetOldest(keyframe);
    if (options_.mapper.local_adjustment && keyframe != 0) startAdjustment(keyframe);
}

void LocalMapper::startAdjustment(int keyframe) {
    MapAdjustment adjustment = adjustmentAround(keyframe);
    if (adjustment.problem.observations.empty()) return;  // the first of its part
    adjusted_keyframe_ = keyframe;
    const int iterations = options_.mapper.iterations;
    pending_ = std::make_unique<BackgroundBundleAdjustment>(
        std::move(adjustment), [iterations](BundleProblem& p) { adjustBundle(p, iterations); });
}

double LocalMapper::applyPendingAdjustment() {
    if (!pending_) return 0;
    const double cpu_ms = pending_->wait();
    pending_->adjustment().apply(map_);
    pending_.reset();
    return cpu_ms;
}

void LocalMapper::save(ByteWriter& out) const {
    putNumbers(recent_, out);
    putFlag(pending(), out);
    if (pending()) out.putCount(adjusted_keyframe_);
}

void LocalMapper::load(ByteReader& in) {
    recent_ = getNumbers(in, map_.landmarks().size());
    if (getFlag(in)) startAdjustment(getIndex(in, map_.keyframes().size(), "keyframe"));
}

void LocalMapper::createFromDepth(int id) {
    const SE3 T_world_cam = map_.keyframe(id).T_cam_world.inverse();
    const std::size_t keypoints = map_.keyframe(id).frame.keypoints.size();
    for (std::size_t i = 0; i < keypoints; ++i) {
        const Keypoint& k = map_.keyframe(id).frame.keypoints[i];
        if (map_.keyframe(id).landmarks[i] != no_landmark || k.depth_m <= 0) continue;
        const Eigen::Vector3d position = T_world_cam * cameras_.pointOf(k);
        recent_.push_back(map_.addLandmark(position, id, static_cast<int>(i)));
    }
}

void LocalMapper::triangulateWithNeighbors(int id) {
    auto neighbors = map_.covisible(id);
    if (neighbors.size() > neighbors_triangulated) neighbors.resize(neighbors_triangulated);
    for (const Covisibility& c : neighbors) {
        for (const TriangulatedPoint& point :
             triangulateBetween(cameras_, map_, options_, id, c.keyframe)) {
            recent_.push_back(map_.addLandmark(point.position, id, point.keypoint_a));
            map_.addObservation(recent_.back(), c.keyframe, point.keypoint_b);
        }
    }
}

void LocalMapper::joinWithNeighbors(int id) {
    auto neighbors = map_.covisible(id);
    if (neighbors.size() > neighbors_joined) neighbors.resize(neighbors_joined);
    for (const Covisibility& c : neighbors) joinInto(c.keyframe, map_.keyframe(id).landmarks);
}

// A copy, since fusing changes the list of the keyframe that it may come from.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void LocalMapper::joinInto(int keyframe_id, std::vector<int> landmarks) {
    const Keyframe& keyframe = map_.keyframe(keyframe_id);
    ProjectedSearch search(keyframe.frame, keyframe.T_cam_world, cameras_, map_);
    for (const int id : landmarks) {
        if (id == no_landmark || !map_.landmark(id).alive) continue;
        if (map_.keypointOf(id, keyframe_id) >= 0) continue;
        search.visitViews(id, [&](const ProjectedLandmark& view) {
            return search.search(view, search.octave(view), {join_window_px, 0, join_hamming, 1});
        });
    }
    for (const auto& [keypoint, landmark] : search.matches()) join(landmark, keyframe_id, keypoint);
}

/** Lets `landmark` be seen by a keypoint, provided that the geometry agrees. */
void LocalMapper::join(int landmark, int keyframe, int keypoint) {
    const Keyframe& seen_by = map_.keyframe(keyframe);
    const Keypoint& k = seen_by.frame.keypoints[keypoint];
    const Measurement m = measurementOf(k, map_.scaleOf(k.octave), options_.sensor);
    const PointView view(cameras_[k.camera], seen_by.T_cam_world, map_.landmark(landmark).position);
    if (view.residual(m).squaredNorm() > chi2Limit(m)) return;
    const int other = seen_by.landmarks[keypoint];
    if (!map_.landmark(landmark).alive) return;
    if (other == no_landmark) {
        map_.addObservation(landmark, keyframe, keypoint);
    } else if (map_.landmark(other).observations.size() >=
               map_.landmark(landmark).observations.size()) {
        map_.fuse(landmark, other);
    } else {
        map_.fuse(other, landmark);
    }
}

/** New landmarks must be found again by tracking and seen by a second keyframe soon. */
void LocalMapper::cullLandmarks(int keyframe) {
    std::vector<int> still_recent;
    for (const int id : recent_) {
        const Landmark& landmark = map_.landmark(id);
        if (!landmark.alive) continue;
        const int age = keyframe - landmark.first_keyframe;
        const bool unreliable =
            landmark.times_found < least_found_share * landmark.times_expected ||
            (age >= 2 && landmark.observations.size() < 2);
        if (unreliable) {
            map_.removeLandmark(id);
        } else if (age < probation_keyframes) {
            still_recent.push_back(id);
        }
    }
    recent_ = std::move(still_recent);
}

/** Whether enough other keyframes see a landmark on the same or a finer pyramid level. */
bool LocalMapper::isRedundant(const Landmark& landmark, int keyframe, int octave) const {
    int others = 0;
    for (const Observation& o : landmark.observations) {
        if (o.keyframe == keyframe) continue;
        others += map_.keyframe(o.keyframe).frame.keypoints[o.keypoint].octave <= octave + 1;
        if (others >= observers_that_make_redundant) return true;
    }
    return false;
}

/** Share of a keyframe's landmarks that others see as well. */
double LocalMapper::redundancy(const Keyframe& keyframe) const {
    int landmarks = 0, redundant = 0;
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
        if (keyframe.landmarks[i] == no_landmark) continue;
        ++landmarks;
        redundant += isRedundant(map_.landmark(keyframe.landmarks[i]), keyframe.id,
                                 keyframe.frame.keypoints[i].octave);
    }
    return landmarks ? static_cast<double>(redundant) / landmarks : 0;
}

void LocalMapper::cullKeyframes(int id) {
    auto neighbors = map_.covisible(id);
    if (neighbors.size() > neighbors_culled) neighbors.resize(neighbors_culled);
    for (const Covisibility& c : neighbors) {
        if (map_.isFixed(c.keyframe) || c.keyframe >= id - 1) continue;
        if (redundancy(map_.keyframe(c.keyframe)) <= options_.keyframes.cull_share) continue;
        const auto others = map_.covisible(c.keyframe, 1);
        if (!others.empty()) map_.cull(c.keyframe, others.front().keyframe);
    }
}

/** Beside a fixed map only the latest keyframes are kept, so that memory stays flat. The one that
 *  goes must still move with its own submap. */
void LocalMapper::forgetOldest(int newest) {
    std::vector<int> living;
    for (int id = map_.fixedCount(); id <= newest; ++id) {
        if (!map_.keyframe(id).culled) living.push_back(id);
    }
    if (static_cast<int>(living.size()) <= options_.mapper.localization_keyframes) return;
    const auto seen_with = map_.covisible(living[0]);
    const auto held = std::find_if(seen_with.begin(), seen_with.end(),
                                   [&](const Covisibility& c) { return map_.isFixed(c.keyframe); });
    const int submap = map_.keyframe(living[0]).submap;
    const auto next = std::find_if(living.begin() + 1, living.end(),
                                   [&](int id) { return map_.keyframe(id).submap == submap; });
    const int younger = next == living.end() ? living[1] : *next;
    map_.cull(living[0], held == seen_with.end() ? younger : held->keyframe);
}

/** The newest keyframe and its best neighbors move; others that see the same points hold them. */
MapAdjustment LocalMapper::adjustmentAround(int id) const {
    std::vector<int> free = {id};
    for (const Covisibility& c : map_.covisible(id)) {
        if (static_cast<int>(free.size()) >= options_.mapper.window_keyframes) break;
        if (!map_.isFixed(c.keyframe)) free.push_back(c.keyframe);
    }
    std::sort(free.begin(), free.end());
    std::vector<int> landmarks = landmarksSeenBy(free, map_);
    std::vector<int> fixed;
    for (const Covisibility& c : map_.observers(landmarks)) {
        if (std::binary_search(free.begin(), free.end(), c.keyframe)) continue;
        if (static_cast<int>(fixed.size()) >= options_.mapper.max_fixed_keyframes) break;
        fixed.push_back(c.keyframe);
    }
    return {map_, cameras_, options_.sensor, free, fixed, std::move(landmarks)};
}

}  // namespace rgbd_graphslam
