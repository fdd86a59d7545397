#include "rgbd_graphslam/slam/visual_slam.h"

#include "slam_pipeline.h"

namespace rgbd_graphslam {

const char* toString(FrameOrigin origin) {
    switch (origin) {
        case FrameOrigin::Tracked:
            return "tracked";
        case FrameOrigin::Recovered:
            return "recovered";
        case FrameOrigin::DeadReckoned:
            return "dead_reckoned";
        case FrameOrigin::Uncertain:
            return "uncertain";
        case FrameOrigin::Lost:
            break;
    }
    return "lost";
}

VisualSlam::VisualSlam(const SlamOptions& options, const Rig& rig)
    : pipeline_(std::make_unique<SlamPipeline>(options, rig)) {}

VisualSlam::VisualSlam(const SlamOptions& options, const Rig& rig, MapSnapshot map, MapUse use)
    : VisualSlam(options, rig) {
    pipeline_->restore(std::move(map), use);
}

VisualSlam::~VisualSlam() = default;

Frame VisualSlam::prepare(const RgbdImage& image) const {
    return prepare(std::vector<CameraImage>{{0, image}});
}

Frame VisualSlam::prepare(const std::vector<CameraImage>& images) const {
    return pipeline_->prepare(images);
}

TrackedFrame VisualSlam::track(Frame frame) {
    return pipeline_->track(std::move(frame));
}

std::vector<PoseEdge> VisualSlam::closeLoops(int keyframe) {
    return pipeline_->closeLoops(keyframe);
}

std::vector<PoseEdge> VisualSlam::findLoops(int keyframe) {
    return pipeline_->findLoops(keyframe);
}

void VisualSlam::correct(const std::vector<SE3>& T_world_keyframe) {
    pipeline_->correct(T_world_keyframe);
}

void VisualSlam::finish() {
    pipeline_->finish();
}

PoseEdge VisualSlam::odometryEdge(int keyframe) const {
    return pipeline_->odometryEdge(keyframe);
}

PoseGraph VisualSlam::poseGraph() const {
    return pipeline_->poseGraph();
}

std::vector<std::pair<int, int>> VisualSlam::covisibility() const {
    return pipeline_->covisibility();
}

std::vector<TrackedFrame> VisualSlam::frames() const {
    return pipeline_->frames();
}

std::vector<KeyframeView> VisualSlam::keyframes() const {
    return pipeline_->keyframes();
}

std::vector<LandmarkView> VisualSlam::landmarks() const {
    return pipeline_->landmarks();
}

const std::vector<PoseEdge>& VisualSlam::loops() const {
    return pipeline_->loops();
}

std::vector<FeatureView> VisualSlam::features() const {
    return pipeline_->features();
}

const MotionSummary& VisualSlam::motion() const {
    return pipeline_->motion();
}

MapSnapshot VisualSlam::snapshot() const {
    return pipeline_->snapshot();
}

void VisualSlam::save(ByteWriter& out) const {
    pipeline_->save(out);
}

void VisualSlam::load(ByteReader& in) {
    pipeline_->load(in);
}

std::vector<VisualSlam::StageTime> VisualSlam::stageTimes() const {
    return pipeline_->stageTimes();
}

}  // namespace rgbd_graphslam
