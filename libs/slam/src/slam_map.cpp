#include "rgbd_graphslam/slam/slam_map.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/free_memory.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** Nothing but the last frame and the adjustment at work remembers landmarks by id, and neither
 *  outlives the next keyframe. */
constexpr std::size_t keyframes_of_rest = 2;

}  // namespace

SlamMap::SlamMap(double scale_factor, int levels) : log_scale_factor_(std::log(scale_factor)) {
    for (int l = 0; l < levels; ++l) scale_.push_back(std::pow(scale_factor, l));
}

void SlamMap::restore(std::vector<Keyframe> keyframes, std::vector<Landmark> landmarks) {
    keyframes_ = std::move(keyframes);
    landmarks_ = std::move(landmarks);
    alive_ = landmarks_.size();
    votes_.assign(keyframes_.size(), 0);
}

void SlamMap::save(ByteWriter& out) const {
    out.putCount(keyframes_.size());
    for (const Keyframe& keyframe : keyframes_) put(keyframe, out);
    out.putCount(landmarks_.size());
    for (const Landmark& landmark : landmarks_) {
        putFlag(landmark.alive, out);
        if (landmark.alive) put(landmark, out);
    }
    out.putCount(dead_.size());
    for (const auto& [landmark, keyframes] : dead_) {
        out.putCount(landmark);
        out.putCount(keyframes);
    }
    putNumbers(culled_, out);
    out.putCount(fixed_);
}

void SlamMap::load(ByteReader& in, const RigCameras& cameras) {
    const std::size_t keyframes = in.getCount(keyframe_bytes);
    for (std::size_t id = 0; id < keyframes; ++id) {
        keyframes_.push_back(getKeyframe(in, static_cast<int>(id), keyframes, cameras, levels()));
    }
    checkCulled(keyframes_);
    votes_.assign(keyframes, 0);
    landmarks_.resize(in.getCount(1));
    for (std::size_t id = 0; id < landmarks_.size(); ++id) {
        landmarks_[id].alive = getFlag(in);
        if (!landmarks_[id].alive) continue;
        landmarks_[id] =
            getLandmark(in, static_cast<int>(id), keyframes_, levels(), cameras.count());
        ++alive_;
    }
    loadDead(in);
    culled_ = getNumbers(in, keyframes);
    for (const int keyframe : culled_) {
        if (!keyframes_[keyframe].culled) throw DamagedBytes("a living keyframe among the culled");
    }
    fixed_ = getIndex(in, keyframes + 1, "number of fixed keyframes");
}

/** Each dead landmark is named once: its number will be given to another. */
void SlamMap::loadDead(ByteReader& in) {
    const std::size_t dead = in.getCount(2 * sizeof(std::uint32_t));
    std::vector<char> named(landmarks_.size(), 0);
    for (std::size_t i = 0; i < dead; ++i) {
        const int landmark = getIndex(in, landmarks_.size(), "landmark");
        if (landmarks_[landmark].alive || named[landmark]++) {
            throw DamagedBytes("a landmark that is not dead, or twice");
        }
        dead_.emplace_back(landmark, in.get<std::uint32_t>());
    }
}

int SlamMap::addKeyframe(Frame frame, const SE3& T_cam_world, int submap, Link link) {
    Keyframe keyframe;
    keyframe.submap = submap;
    keyframe.link = link;
    keyframe.id = static_cast<int>(keyframes_.size());
    keyframe.landmarks.assign(frame.keypoints.size(), no_landmark);
    keyframe.frame = std::move(frame);
    keyframe.frame.view = {};
    keyframe.T_cam_world = T_cam_world;
    if (!keyframes_.empty()) freeMemory(keyframes_.back().frame.patches);
    keyframes_.push_back(std::move(keyframe));
    votes_.push_back(0);
    return keyframes_.back().id;
}

void SlamMap::moveLandmark(int landmark, const SE3& T_new_old) {
    Landmark& moved = landmarks_[landmark];
    moved.position = T_new_old * moved.position;
    moved.view_direction = T_new_old.R * moved.view_direction;
}

void SlamMap::mergeSubmap(int submap, int into, const SE3& T_new_old) {
    for (std::size_t id = 0; id < landmarks_.size(); ++id) {
        const Landmark& landmark = landmarks_[id];
        if (!landmark.alive) continue;
        if (keyframes_[landmark.observations.front().keyframe].submap != submap) continue;
        moveLandmark(static_cast<int>(id), T_new_old);
    }
    const SE3 T_old_new = T_new_old.inverse();
    for (Keyframe& keyframe : keyframes_) {
        if (keyframe.submap != submap) continue;
        keyframe.submap = into;
        keyframe.T_cam_world = keyframe.T_cam_world * T_old_new;
    }
}

int SlamMap::addLandmark(const Eigen::Vector3d& position, int keyframe, int keypoint) {
    Frame& frame = keyframes_[keyframe].frame;
    Landmark landmark;
    landmark.position = position;
    landmark.first_keyframe = keyframe;
    if (!frame.patches.empty()) {
        landmark.patch = std::make_shared<LandmarkPatch>(
            LandmarkPatch{frame.patches[keypoint], frame.keypoints[keypoint].octave,
                          frame.keypoints[keypoint].camera});
        frame.keypoints[keypoint].aligned = true;
    }
    ++alive_;
    const int id = freeLandmark();
    landmarks_[id] = std::move(landmark);
    addObservation(id, keyframe, keypoint);
    return id;
}

int SlamMap::freeLandmark() {
    if (!dead_.empty() && keyframes_.size() >= dead_.front().second + keyframes_of_rest) {
        const int id = dead_.front().first;
        dead_.pop_front();
        return id;
    }
    landmarks_.emplace_back();
    return static_cast<int>(landmarks_.size()) - 1;
}

void SlamMap::bury(int landmark) {
    freeMemory(landmarks_[landmark].observations);
    landmarks_[landmark].patch.reset();
    landmarks_[landmark].alive = false;
    --alive_;
    dead_.emplace_back(landmark, keyframes_.size());
}

void SlamMap::addObservation(int landmark, int keyframe, int keypoint) {
    auto& observations = landmarks_[landmark].observations;
    const auto place =
        std::lower_bound(observations.begin(), observations.end(), keyframe,
                         [](const Observation& o, int id) { return o.keyframe < id; });
    observations.insert(place, {keyframe, keypoint});
    keyframes_[keyframe].landmarks[keypoint] = landmark;
    refreshAppearance(landmark);
}

void SlamMap::addObservations(const std::vector<int>& landmarks, int keyframe) {
    for (std::size_t keypoint = 0; keypoint < landmarks.size(); ++keypoint) {
        const int landmark = landmarks[keypoint];
        if (landmark == no_landmark || !landmarks_[landmark].alive) continue;
        addObservation(landmark, keyframe, static_cast<int>(keypoint));
    }
}

void SlamMap::refreshAppearance(int landmark) {
    Landmark& refreshed = landmarks_[landmark];
    const Observation& latest = refreshed.observations.back();
    const Keyframe& keyframe = keyframes_[latest.keyframe];
    const Eigen::Vector3d to_camera = keyframe.T_cam_world.inverse().t - refreshed.position;
    const double distance = std::max(to_camera.norm(), 1e-6);
    refreshed.view_direction = to_camera / distance;
    refreshed.level0_distance = distance * scale_[keyframe.frame.keypoints[latest.keypoint].octave];
    refreshed.descriptor = keyframe.frame.descriptors[latest.keypoint];
}

void SlamMap::removeObservation(int landmark, int keyframe) {
    auto& observations = landmarks_[landmark].observations;
    const auto place = std::find_if(observations.begin(), observations.end(),
                                    [&](const Observation& o) { return o.keyframe == keyframe; });
    if (place == observations.end()) return;
    release(*place);
    observations.erase(place);
    if (observations.empty()) {
        bury(landmark);
    } else {
        refreshAppearance(landmark);
    }
}

void SlamMap::removeLandmark(int landmark) {
    Landmark& removed = landmarks_[landmark];
    if (!removed.alive) return;
    for (const Observation& o : removed.observations) release(o);
    bury(landmark);
}

void SlamMap::release(const Observation& o) {
    Keyframe& keyframe = keyframes_[o.keyframe];
    keyframe.landmarks[o.keypoint] = no_landmark;
    keyframe.frame.keypoints[o.keypoint].aligned = false;
}

void SlamMap::fuse(int from, int into) {
    const std::vector<Observation> moved = landmarks_[from].observations;
    landmarks_[into].times_expected += landmarks_[from].times_expected;
    landmarks_[into].times_found += landmarks_[from].times_found;
    removeLandmark(from);
    for (const Observation& o : moved) {
        if (keypointOf(into, o.keyframe) < 0) addObservation(into, o.keyframe, o.keypoint);
    }
}

void SlamMap::cull(int keyframe, int parent) {
    Keyframe& culled = keyframes_[keyframe];
    const std::vector<int> seen = culled.landmarks;
    for (const int landmark : seen) {
        if (landmark != no_landmark) removeObservation(landmark, keyframe);
    }
    culled_.push_back(keyframe);
    culled.culled = true;
    culled.parent = parent;
    culled.T_cam_parent = culled.T_cam_world * keyframes_[parent].T_cam_world.inverse();
    for (Keyframe& child : keyframes_) {
        if (!child.culled || child.parent != keyframe) continue;
        child.parent = parent;
        child.T_cam_parent = child.T_cam_parent * culled.T_cam_parent;
    }
    const double stamp_s = culled.frame.stamp_s;
    culled.frame = Frame{};
    culled.frame.stamp_s = stamp_s;
    freeMemory(culled.landmarks);
}

SE3 SlamMap::T_cam_world(int keyframe) const {
    const Keyframe& k = keyframes_[keyframe];
    return k.culled ? k.T_cam_parent * keyframes_[k.parent].T_cam_world : k.T_cam_world;
}

void SlamMap::setPose(int keyframe, const SE3& T_cam_world) {
    keyframes_[keyframe].T_cam_world = T_cam_world;
}

int SlamMap::keypointOf(int landmark, int keyframe) const {
    for (const Observation& o : landmarks_[landmark].observations) {
        if (o.keyframe == keyframe) return o.keypoint;
    }
    return -1;
}

std::vector<Covisibility> SlamMap::covisible(int keyframe, int fewest) const {
    auto all = observers(keyframes_[keyframe].landmarks, fewest);
    all.erase(std::remove_if(all.begin(), all.end(),
                             [&](const Covisibility& c) { return c.keyframe == keyframe; }),
              all.end());
    return all;
}

std::vector<Covisibility> SlamMap::observers(const std::vector<int>& landmarks, int fewest) const {
    std::vector<int> voted;
    for (const int id : landmarks) {
        if (id == no_landmark) continue;
        for (const Observation& o : landmarks_[id].observations) {
            if (votes_[o.keyframe]++ == 0) voted.push_back(o.keyframe);
        }
    }
    std::vector<Covisibility> result;
    for (const int keyframe : voted) {
        if (votes_[keyframe] >= fewest) result.push_back({keyframe, votes_[keyframe]});
        votes_[keyframe] = 0;
    }
    std::sort(result.begin(), result.end(), [](const Covisibility& a, const Covisibility& b) {
        return a.shared != b.shared ? a.shared > b.shared : a.keyframe < b.keyframe;
    });
    return result;
}

int SlamMap::expectedOctave(const Landmark& landmark, double distance) const {
    return static_cast<int>(
        std::lround(std::log(landmark.level0_distance / distance) / log_scale_factor_));
}

}  // namespace rgbd_graphslam
