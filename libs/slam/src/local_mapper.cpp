#include "rgbd_graphslam/slam/local_mapper.h"

#include <algorithm>

#include "rgbd_graphslam/slam/global_adjustment.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/matcher.h"
#include "rgbd_graphslam/slam/thread_clock.h"
#include "rgbd_graphslam/slam/triangulation.h"

namespace rgbd_graphslam {
namespace {

constexpr int neighbours_joined = 8;
constexpr int neighbours_triangulated = 6;
constexpr int neighbours_culled = 30;
constexpr double join_window_px = 3;
constexpr int join_hamming = 50;
constexpr int probation_keyframes = 3;
constexpr double least_found_share = 0.25;
constexpr int observers_that_make_redundant = 3;

}  // namespace

/** An adjustment at work: the problem and which part of the map each piece stands for. */
struct LocalMapper::Job {
    int newest = 0;  // keyframe around which is adjusted
    BundleProblem problem;
    std::vector<int> keyframes, landmarks;
    std::vector<int> observation_keyframe;
    double cpu_ms = 0;
    std::future<void> done;
};

LocalMapper::LocalMapper(const SlamOptions& options, const Camera& camera, SlamMap& map)
    : options_(options), camera_(camera), map_(map) {}

LocalMapper::~LocalMapper() {
    if (pending_) pending_->done.wait();
}

void LocalMapper::insert(int keyframe) {
    createFromDepth(keyframe);
    if (options_.mapper.triangulate) triangulateWithNeighbours(keyframe);
    joinWithNeighbours(keyframe);
    cullLandmarks(keyframe);
    cullKeyframes(keyframe);
    if (options_.mapper.local_adjustment && keyframe != 0) startAdjustment(keyframe);
}

void LocalMapper::startAdjustment(int keyframe) {
    pending_ = makeJob(keyframe);
    if (pending_->problem.observations.empty()) return pending_.reset();  // the first of its part
    Job* job = pending_.get();
    const int iterations = options_.mapper.iterations;
    job->done = std::async(std::launch::async, [job, iterations] {
        const ThreadClock clock;
        adjustBundle(job->problem, iterations);
        job->cpu_ms = clock.cpuMs();
    });
}

double LocalMapper::handOver() {
    if (!pending_) return 0;
    pending_->done.get();
    apply(*pending_);
    const double cpu_ms = pending_->cpu_ms;
    pending_.reset();
    return cpu_ms;
}

void LocalMapper::save(ByteWriter& out) const {
    putNumbers(recent_, out);
    putFlag(pending(), out);
    if (pending()) out.putCount(pending_->newest);
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
        const Eigen::Vector3d position = T_world_cam * camera_.unproject(k.u, k.v, k.depth_m);
        recent_.push_back(map_.addLandmark(position, id, static_cast<int>(i)));
    }
}

void LocalMapper::triangulateWithNeighbours(int id) {
    auto neighbours = map_.covisible(id);
    if (neighbours.size() > neighbours_triangulated) neighbours.resize(neighbours_triangulated);
    for (const Covisibility& c : neighbours) {
        for (const TriangulatedPoint& point :
             triangulateBetween(camera_, map_, options_, id, c.keyframe)) {
            recent_.push_back(map_.addLandmark(point.position, id, point.keypoint_a));
            map_.addObservation(recent_.back(), c.keyframe, point.keypoint_b);
        }
    }
}

void LocalMapper::joinWithNeighbours(int id) {
    auto neighbours = map_.covisible(id);
    if (neighbours.size() > neighbours_joined) neighbours.resize(neighbours_joined);
    for (const Covisibility& c : neighbours) joinInto(c.keyframe, map_.keyframe(id).landmarks);
}

void LocalMapper::joinInto(int keyframe_id, std::vector<int> landmarks) {
    const Keyframe& keyframe = map_.keyframe(keyframe_id);
    const Eigen::Vector3d camera_position = keyframe.T_cam_world.inverse().t;
    MatchTable table(keyframe.frame);
    for (const int id : landmarks) {
        if (id == no_landmark || !map_.landmark(id).alive) continue;
        if (map_.keypointOf(id, keyframe_id) >= 0) continue;
        const Landmark& landmark = map_.landmark(id);
        const Eigen::Vector3d p = keyframe.T_cam_world * landmark.position;
        if (p.z() < nearest_depth_m) continue;
        const Eigen::Vector2d pixel = camera_.project(p);
        if (!camera_.contains(pixel)) continue;
        const double distance = (camera_position - landmark.position).norm();
        const int octave = map_.expectedOctave(landmark, distance);
        const int clamped = std::clamp(octave, 0, map_.levels() - 1);
        const auto radius = static_cast<float>(join_window_px * map_.scaleOf(clamped));
        table.search(id, landmark.descriptor,
                     {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), radius,
                      octave - 1, octave + 1},
                     join_hamming, 1.0f);
    }
    for (const auto& [keypoint, landmark] : table.matches()) join(landmark, keyframe_id, keypoint);
}

/** Lets `landmark` be seen by a keypoint, provided that the geometry agrees. */
void LocalMapper::join(int landmark, int keyframe, int keypoint) {
    const Keyframe& seen_by = map_.keyframe(keyframe);
    const Keypoint& k = seen_by.frame.keypoints[keypoint];
    const Measurement m = measurementOf(k, map_.scaleOf(k.octave), options_.sensor);
    const Eigen::Vector3d p = seen_by.T_cam_world * map_.landmark(landmark).position;
    if (residual(camera_, p, m).squaredNorm() > chi2Limit(m)) return;
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
    auto neighbours = map_.covisible(id);
    if (neighbours.size() > neighbours_culled) neighbours.resize(neighbours_culled);
    for (const Covisibility& c : neighbours) {
        if (c.keyframe == 0 || c.keyframe >= id - 1) continue;
        if (redundancy(map_.keyframe(c.keyframe)) <= options_.keyframes.cull_share) continue;
        const auto others = map_.covisible(c.keyframe, 1);
        if (!others.empty()) map_.cull(c.keyframe, others.front().keyframe);
    }
}

/** The newest keyframe and its best neighbours move; others that see the same points hold them. */
std::unique_ptr<LocalMapper::Job> LocalMapper::makeJob(int id) const {
    auto job = std::make_unique<Job>();
    job->newest = id;
    std::vector<int>& keyframes = job->keyframes;
    keyframes.push_back(id);
    for (const Covisibility& c : map_.covisible(id)) {
        if (static_cast<int>(keyframes.size()) >= options_.mapper.window_keyframes) break;
        if (c.keyframe != 0) keyframes.push_back(c.keyframe);
    }
    std::sort(keyframes.begin(), keyframes.end());
    job->problem.free_cameras = static_cast<int>(keyframes.size());
    job->landmarks = landmarksSeenBy(keyframes);
    int fixed = 0;
    const std::vector<int> free = keyframes;
    for (const Covisibility& c : map_.observers(job->landmarks)) {
        if (std::binary_search(free.begin(), free.end(), c.keyframe)) continue;
        if (fixed++ >= options_.mapper.max_fixed_keyframes) break;
        keyframes.push_back(c.keyframe);
    }
    fillProblem(*job);
    return job;
}

/** Landmarks with at least two observations among what the keyframes see, by rising id. */
std::vector<int> LocalMapper::landmarksSeenBy(const std::vector<int>& keyframes) const {
    std::vector<int> landmarks;
    for (const int keyframe : keyframes) {
        for (const int landmark : map_.keyframe(keyframe).landmarks) {
            if (landmark == no_landmark) continue;
            if (map_.landmark(landmark).observations.size() >= 2) landmarks.push_back(landmark);
        }
    }
    std::sort(landmarks.begin(), landmarks.end());
    landmarks.erase(std::unique(landmarks.begin(), landmarks.end()), landmarks.end());
    return landmarks;
}

void LocalMapper::fillProblem(Job& job) const {
    BundleProblem& problem = job.problem;
    problem.camera = camera_;
    std::vector<int> camera_of(map_.keyframes().size(), -1);
    for (std::size_t c = 0; c < job.keyframes.size(); ++c) {
        camera_of[job.keyframes[c]] = static_cast<int>(c);
        problem.T_cam_world.push_back(map_.keyframe(job.keyframes[c]).T_cam_world);
    }
    for (std::size_t p = 0; p < job.landmarks.size(); ++p) {
        const Landmark& landmark = map_.landmark(job.landmarks[p]);
        problem.points.push_back(landmark.position);
        for (const Observation& o : landmark.observations) {
            if (camera_of[o.keyframe] < 0) continue;
            const Keypoint& k = map_.keyframe(o.keyframe).frame.keypoints[o.keypoint];
            problem.observations.push_back(
                {camera_of[o.keyframe], static_cast<int>(p),
                 measurementOf(k, map_.scaleOf(k.octave), options_.sensor)});
            job.observation_keyframe.push_back(o.keyframe);
        }
    }
}

void LocalMapper::apply(const Job& job) {
    const BundleProblem& problem = job.problem;
    for (int c = 0; c < problem.free_cameras; ++c) {
        moveUnadjusted(job.keyframes[c], problem.T_cam_world[c], job.landmarks);
        map_.setPose(job.keyframes[c], problem.T_cam_world[c]);
    }
    for (std::size_t p = 0; p < job.landmarks.size(); ++p) {
        if (map_.landmark(job.landmarks[p]).alive) {
            map_.landmark(job.landmarks[p]).position = problem.points[p];
        }
    }
    for (std::size_t o = 0; o < problem.observations.size(); ++o) {
        if (!problem.observations[o].outlier) continue;
        const int landmark = job.landmarks[problem.observations[o].point];
        if (map_.landmark(landmark).alive) {
            map_.removeObservation(landmark, job.observation_keyframe[o]);
        }
    }
}

/** Landmarks that one keyframe alone has seen took no part in the adjustment; left behind, they
 * would pull the next frames back to where their keyframe was. */
void LocalMapper::moveUnadjusted(int keyframe, const SE3& new_T_cam_world,
                                 const std::vector<int>& adjusted) {
    const SE3 motion = new_T_cam_world.inverse() * map_.keyframe(keyframe).T_cam_world;
    for (const int id : map_.keyframe(keyframe).landmarks) {
        if (id == no_landmark || !map_.landmark(id).alive) continue;
        if (std::binary_search(adjusted.begin(), adjusted.end(), id)) continue;
        map_.landmark(id).position = motion * map_.landmark(id).position;
    }
}

void LocalMapper::adjustAll(int iterations) {
    Job job;
    for (const Keyframe& keyframe : map_.keyframes()) {
        if (!keyframe.culled && keyframe.id != 0) job.keyframes.push_back(keyframe.id);
    }
    if (job.keyframes.empty()) return;
    job.problem.free_cameras = static_cast<int>(job.keyframes.size());
    job.landmarks = landmarksSeenBy(job.keyframes);
    job.keyframes.push_back(0);
    fillProblem(job);
    adjustBundleSparse(job.problem, iterations);
    apply(job);
}

}  // namespace rgbd_graphslam
