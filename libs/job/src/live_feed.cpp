#include "live_feed.h"

#include <algorithm>
#include <utility>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds picture_interval(100), keyframe_interval(50), map_interval(1000);
/** The map is sent so rarely that copying it takes less than this part of the time. */
constexpr int least_map_pause = 500;
constexpr std::size_t most_statistics = 20000;

FeatureState stateOf(FeatureView::State state) {
    switch (state) {
        case FeatureView::State::Tracked:
            return FeatureState::Tracked;
        case FeatureView::State::Lost:
            return FeatureState::Lost;
        case FeatureView::State::New:
            break;
    }
    return FeatureState::New;
}

std::vector<LiveFeature> liveFeatures(const VisualSlam& slam, const Camera& camera) {
    std::vector<LiveFeature> features;
    for (const FeatureView& feature : slam.features()) {
        if (feature.camera != 0) continue;
        const Eigen::Vector2d seen = camera.unrectify(feature.pixel);
        features.push_back(
            {static_cast<float>(seen.x()), static_cast<float>(seen.y()), stateOf(feature.state)});
    }
    return features;
}

/** Without images, features and statistics. */
LiveFrame messageOf(const StreamedFrame& frame, const TrackedFrame& tracked,
                    const GraphSlamSession& session) {
    LiveFrame message;
    message.is_picture = false;
    message.stamp_s = tracked.stamp_s;
    message.lost = tracked.origin == FrameOrigin::Lost;
    message.T_world_cam = session.T_base_cam() * tracked.T_world_cam;
    message.keyframe = tracked.keyframe.value_or(-1);
    message.camera = cameraOf(*frame.observation);
    return message;
}

}  // namespace

LiveFeed::LiveFeed(const std::string& folder) {
    try {
        server_ = std::make_unique<LiveServer>(folder);
    } catch (const Error& e) {
        sayDetail(e.what());
    }
}

void LiveFeed::note(const StreamedFrame& frame, const TrackedFrame& tracked, double frame_ms,
                    const GraphSlamSession& session) {
    if (!server_) return;
    addStatistic(tracked, frame_ms);
    if (!server_->ready() || frame.camera != 0) return;  // pictures are the first camera's
    const auto now = Clock::now();
    const bool wanted = server_->pictureWanted() && now >= next_picture_;
    if (wanted && now >= next_map_) {
        sendMap(session);
        next_map_ =
            now + std::max<Clock::duration>(map_interval, least_map_pause * (Clock::now() - now));
    } else if (wanted) {
        sendPicture(frame, tracked, session);
        next_picture_ = now + picture_interval;
    } else if (tracked.keyframe && now >= next_keyframe_) {
        send(frame, messageOf(frame, tracked, session));
        next_keyframe_ = now + keyframe_interval;
    }
}

void LiveFeed::addStatistic(const TrackedFrame& tracked, double frame_ms) {
    if (statistics_.size() == most_statistics) {  // nobody has looked on for long
        statistics_.erase(statistics_.begin(), statistics_.begin() + most_statistics / 2);
    }
    statistics_.push_back({tracked.stamp_s, static_cast<float>(frame_ms), tracked.inliers,
                           tracked.origin == FrameOrigin::Lost});
}

void LiveFeed::sendPicture(const StreamedFrame& frame, const TrackedFrame& tracked,
                           const GraphSlamSession& session) {
    LiveFrame message = messageOf(frame, tracked, session);
    message.is_picture = true;
    message.features = liveFeatures(session.slam(), message.camera);
    message.statistics = std::exchange(statistics_, {});
    server_->pictureSent();
    send(frame, std::move(message));
}

/** The images are reduced in the server's thread. */
void LiveFeed::send(const StreamedFrame& frame, LiveFrame message) {
    const RgbdImage image = colorAndDepth(frame.observation);
    server_->post([message = std::move(message), image]() mutable {
        putImages(image, message);
        return encode(std::move(message));
    });
}

void LiveFeed::sendMap(const GraphSlamSession& session) {
    LiveMap map;
    const SE3& T_base_cam = session.T_base_cam();  // z up instead of the camera's z forward
    for (const TrackedFrame& frame : session.slam().frames()) {
        if (frame.origin == FrameOrigin::Lost) continue;
        map.path.push_back({frame.stamp_s, T_base_cam * frame.T_world_cam});
    }
    for (const KeyframeView& keyframe : session.slam().keyframes()) {
        map.keyframes.push_back({keyframe.stamp_s, T_base_cam * keyframe.T_world_cam});
    }
    for (const PoseEdge& edge : session.slam().loops()) map.loops.emplace_back(edge.from, edge.to);
    map.covisibility = session.slam().covisibility();
    server_->post([map = std::move(map)] { return encode(map); });
}

}  // namespace rgbd_graphslam
