#include "rgbd_graphslam/viewer/live_run.h"

#include <utility>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"

namespace rgbd_graphslam {
namespace {

/** A move that can be seen: a pixel, from where a run is followed. */
constexpr double least_move_m = 0.005, least_turn_rad = 0.001;

bool hasMoved(const SE3& a, const SE3& b) {
    return (a.t - b.t).norm() > least_move_m || (a.inverse() * b).angle() > least_turn_rad;
}

std::vector<KeyframeEdge> edgesOf(const std::vector<std::pair<int, int>>& pairs) {
    std::vector<KeyframeEdge> edges;
    edges.reserve(pairs.size());
    for (const auto& [from, to] : pairs) edges.push_back({from, to});
    return edges;
}

}  // namespace

bool LiveRun::update() {
    if (state_ == State::Ended) return false;
    if (state_ == State::Waiting) {
        if (!client_.connect(folder_)) {
            if (!hasResult()) return false;
            state_ = State::Ended;  // it was over before the viewer was ready
            return true;
        }
        state_ = State::Running;
    }
    const auto messages = client_.receive();
    for (const std::string& bytes : messages) {
        try {
            take(decode(bytes));
        } catch (const Error& e) {
            sayWarning(e.what());
        }
    }
    if (client_.connected()) return std::exchange(picture_is_new_, false);
    state_ = State::Ended;
    return true;
}

void LiveRun::askForPicture() {
    if (state_ != State::Running || std::exchange(asked_, true)) return;
    client_.askForPicture();
}

bool LiveRun::hasResult() const {
    const std::filesystem::path summary = std::filesystem::path(folder_) / "summary.json";
    std::error_code none;
    const auto written = std::filesystem::last_write_time(summary, none);
    return !none && written >= since_;
}

void LiveRun::take(const LiveMessage& message) {
    if (const auto* frame = std::get_if<LiveFrame>(&message)) {
        takeFrame(*frame);
    } else {
        takeMap(std::get<LiveMap>(message));
    }
}

void LiveRun::takeFrame(const LiveFrame& frame) {
    if (frame.is_picture) {
        frame_ = frame;
        picture_is_new_ = true;
        asked_ = false;
    }
    statistics_.insert(statistics_.end(), frame.statistics.begin(), frame.statistics.end());
    for (const LiveStatistic& statistic : frame.statistics) {
        if (statistic.lost) run_.unplaced_s.push_back(statistic.stamp_s);
    }
    if (!frame.lost) run_.trajectory.push_back({frame.stamp_s, frame.T_world_cam});
    if (frame.keyframe < 0) return;
    const Camera camera = imageCamera(frame);
    const auto id = static_cast<std::size_t>(frame.keyframe);
    if (clouds_.size() <= id) clouds_.resize(id + 1);
    clouds_[id] = Cloud{keyframePoints(frame.color, frame.depth, frame.depth_unit_m, camera),
                        frame.T_world_cam,
                        {},
                        false};
}

void LiveRun::takeMap(const LiveMap& map) {
    ++revisions_;
    run_.trajectory = map.path;
    run_.keyframes = map.keyframes;
    run_.loops = edgesOf(map.loops);
    run_.covisibility = edgesOf(map.covisibility);
    for (std::size_t k = 0; k < std::min(clouds_.size(), map.keyframes.size()); ++k) {
        if (clouds_[k]) clouds_[k]->T_world_cam = map.keyframes[k].T_world_cam;
    }
}

std::vector<std::pair<std::size_t, Vertices>> LiveRun::takeMovedClouds() {
    std::vector<std::pair<std::size_t, Vertices>> moved;
    for (std::size_t k = 0; k < clouds_.size(); ++k) {
        auto& cloud = clouds_[k];
        if (!cloud || (cloud->shown && !hasMoved(cloud->T_world_shown, cloud->T_world_cam)))
            continue;
        moved.emplace_back(k, transformed(cloud->T_world_cam, cloud->points_cam));
        cloud->T_world_shown = cloud->T_world_cam;
        cloud->shown = true;
    }
    return moved;
}

}  // namespace rgbd_graphslam
