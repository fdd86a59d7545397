#include "rgbd_graphslam/slam/map_adjustment.h"

#include <algorithm>

#include "rgbd_graphslam/core/thread_clock.h"
#include "rgbd_graphslam/slam/keypoint_measurement.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

void put(const BundleObservation& o, ByteWriter& out) {
    out.putCount(o.keyframe);
    out.putCount(o.point);
    out.putCount(o.camera);
    const Measurement& m = o.measurement;
    for (const double x : {m.u, m.v, m.inverse_depth, m.weight_px, m.weight_depth}) out.put(x);
}

BundleObservation getObservation(ByteReader& in, const BundleProblem& problem) {
    BundleObservation o;
    o.keyframe = getIndex(in, problem.states.keyframes.size(), "keyframe");
    o.point = getIndex(in, problem.states.points.size(), "point");
    o.camera = getIndex(in, problem.cameras.size(), "camera");
    Measurement& m = o.measurement;
    for (double* x : {&m.u, &m.v, &m.inverse_depth, &m.weight_px, &m.weight_depth}) {
        *x = getFinite(in);
    }
    return o;
}

}  // namespace

MapAdjustment::MapAdjustment(const SlamMap& map, const RigCameras& cameras,
                             const SensorOptions& sensor, std::vector<int> free,
                             const std::vector<int>& fixed, std::vector<int> landmarks)
    : keyframes_(std::move(free)),
      landmarks_(std::move(landmarks)),
      keyframes_in_map_(static_cast<int>(map.keyframes().size())) {
    problem.cameras = cameras.mounted();
    problem.free_keyframes = static_cast<int>(keyframes_.size());
    keyframes_.insert(keyframes_.end(), fixed.begin(), fixed.end());
    std::vector<int> camera_of(map.keyframes().size(), -1);
    for (std::size_t c = 0; c < keyframes_.size(); ++c) {
        camera_of[keyframes_[c]] = static_cast<int>(c);
        problem.states.keyframes.push_back({map.keyframe(keyframes_[c]).T_cam_world, {}});
    }
    for (std::size_t p = 0; p < landmarks_.size(); ++p) {
        const Landmark& landmark = map.landmark(landmarks_[p]);
        problem.states.points.push_back(landmark.position);
        for (const Observation& o : landmark.observations) {
            if (camera_of[o.keyframe] < 0) continue;
            const Keypoint& k = map.keyframe(o.keyframe).frame.keypoints[o.keypoint];
            problem.observations.push_back({camera_of[o.keyframe], static_cast<int>(p),
                                            measurementOf(k, map.scaleOf(k.octave), sensor),
                                            k.camera});
            observation_keyframe_.push_back(o.keyframe);
        }
    }
}

bool MapAdjustment::isStill(int landmark, const SlamMap& map) const {
    const Landmark& now = map.landmark(landmark);
    return now.alive && now.first_keyframe < keyframes_in_map_;
}

void MapAdjustment::apply(SlamMap& map) const {
    for (int c = 0; c < problem.free_keyframes; ++c) {
        const SE3& T_cam_world = problem.states.keyframes[c].T_body_world;
        moveUnadjusted(keyframes_[c], T_cam_world, map);
        map.setPose(keyframes_[c], T_cam_world);
    }
    for (std::size_t p = 0; p < landmarks_.size(); ++p) {
        if (isStill(landmarks_[p], map)) map.setPosition(landmarks_[p], problem.states.points[p]);
    }
    for (std::size_t o = 0; o < problem.observations.size(); ++o) {
        const bool doubted = problem.observations[o].outlier;
        if (!doubted || observation_keyframe_[o] < map.fixedCount()) continue;
        const int landmark = landmarks_[problem.observations[o].point];
        if (isStill(landmark, map)) map.removeObservation(landmark, observation_keyframe_[o]);
    }
}

/** Landmarks that took no part, most because one keyframe alone has seen them, move with the first
 *  that saw them; left behind, they would pull the next frames back to where it was. */
void MapAdjustment::moveUnadjusted(int keyframe, const SE3& new_T_cam_world, SlamMap& map) const {
    const SE3 motion = new_T_cam_world.inverse() * map.keyframe(keyframe).T_cam_world;
    for (const int id : map.keyframe(keyframe).landmarks) {
        if (id == no_landmark || map.landmark(id).observations.front().keyframe != keyframe) {
            continue;
        }
        const bool takes_part = std::binary_search(landmarks_.begin(), landmarks_.end(), id);
        if (takes_part && isStill(id, map)) continue;
        map.setPosition(id, motion * map.landmark(id).position);
    }
}

void MapAdjustment::carryYounger(SlamMap& map) const {
    const auto newest =
        std::max_element(keyframes_.begin(), keyframes_.begin() + problem.free_keyframes);
    const SE3& T_cam_world = problem.states.keyframes[newest - keyframes_.begin()].T_body_world;
    const SE3 motion = T_cam_world.inverse() * map.T_cam_world(*newest);
    const SE3 back = motion.inverse();
    for (std::size_t id = 0; id < map.landmarks().size(); ++id) {
        const Landmark& landmark = map.landmark(static_cast<int>(id));
        if (!landmark.alive || landmark.observations.front().keyframe < keyframes_in_map_) continue;
        map.setPosition(static_cast<int>(id), motion * landmark.position);
    }
    for (std::size_t k = keyframes_in_map_; k < map.keyframes().size(); ++k) {
        const int id = static_cast<int>(k);
        if (!map.keyframe(id).culled) map.setPose(id, map.T_cam_world(id) * back);
    }
}

void MapAdjustment::save(ByteWriter& out) const {
    for (const auto* numbers : {&keyframes_, &landmarks_, &observation_keyframe_}) {
        putNumbers(*numbers, out);
    }
    out.putCount(keyframes_in_map_);
    out.putCount(problem.free_keyframes);
    for (const KeyframeState& k : problem.states.keyframes) encodePose(k.T_body_world, out);
    for (const Eigen::Vector3d& point : problem.states.points) {
        for (const double x : {point.x(), point.y(), point.z()}) out.put(x);
    }
    for (const BundleObservation& o : problem.observations) put(o, out);
}

MapAdjustment::MapAdjustment(ByteReader& in, const SlamMap& map, const RigCameras& cameras)
    : keyframes_(getNumbers(in, map.keyframes().size())),
      landmarks_(getNumbers(in, map.landmarks().size())),
      observation_keyframe_(getNumbers(in, map.keyframes().size())) {
    keyframes_in_map_ = getIndex(in, map.keyframes().size() + 1, "number of keyframes");
    problem.cameras = cameras.mounted();
    problem.free_keyframes = getIndex(in, keyframes_.size() + 1, "number of free keyframes");
    if (problem.free_keyframes == 0) throw DamagedBytes("an adjustment of nothing");
    for (std::size_t c = 0; c < keyframes_.size(); ++c) {
        problem.states.keyframes.push_back({decodePose(in), {}});
    }
    for (std::size_t p = 0; p < landmarks_.size(); ++p) {
        Eigen::Vector3d point;
        for (double& x : point) x = getFinite(in);
        problem.states.points.push_back(point);
    }
    for (std::size_t o = 0; o < observation_keyframe_.size(); ++o) {
        problem.observations.push_back(getObservation(in, problem));
    }
}

std::vector<int> landmarksSeenBy(const std::vector<int>& keyframes, const SlamMap& map) {
    std::vector<int> landmarks;
    for (const int keyframe : keyframes) {
        for (const int landmark : map.keyframe(keyframe).landmarks) {
            if (landmark == no_landmark) continue;
            if (map.landmark(landmark).observations.size() >= 2) landmarks.push_back(landmark);
        }
    }
    std::sort(landmarks.begin(), landmarks.end());
    landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
    return landmarks;
}

BackgroundBundleAdjustment::BackgroundBundleAdjustment(MapAdjustment adjustment, const Solve& solve)
    : adjustment_(std::move(adjustment)) {
    cpu_ms_ = std::async(std::launch::async, [this, solve] {
        const ThreadClock clock;
        solve(adjustment_.problem);
        return clock.cpuMs();
    });
}

BackgroundBundleAdjustment::~BackgroundBundleAdjustment() {
    if (cpu_ms_.valid()) cpu_ms_.wait();
}

double BackgroundBundleAdjustment::wait() {
    return cpu_ms_.get();
}

}  // namespace rgbd_graphslam
