/** What VisualSlam does: the one owner of tracking, map, mapping, loops and recovery. */
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "fallback_tracker.h"
#include "keyframe_decision.h"
#include "keyframe_edges.h"
#include "motion_estimator.h"
#include "mover_watch.h"
#include "pose_verdict.h"
#include "relocalizer.h"
#include "rgbd_graphslam/features/frame_builder.h"
#include "rgbd_graphslam/slam/global_bundle_adjuster.h"
#include "rgbd_graphslam/slam/local_mapper.h"
#include "rgbd_graphslam/slam/loop_closer.h"
#include "rgbd_graphslam/slam/stage_times.h"
#include "rgbd_graphslam/slam/tracker.h"
#include "rgbd_graphslam/slam/visual_slam.h"
#include "standstill.h"
#include "trajectory_record.h"

namespace rgbd_graphslam {

/** Decides for each frame whether the map shows where it is, takes it in, or goes on without. The
 *  public functions are VisualSlam's. */
class SlamPipeline {
  public:
    SlamPipeline(const SlamOptions& options, const Rig& rig);
    /** Starts from a map. \throws Error when it does not fit the options or the camera */
    void restore(MapSnapshot snapshot, MapUse use);

    Frame prepare(const std::vector<CameraImage>& images) const;
    TrackedFrame track(Frame frame);
    std::vector<PoseEdge> closeLoops(int keyframe);
    std::vector<PoseEdge> findLoops(int keyframe);
    void correct(const std::vector<SE3>& T_world_keyframe);
    void finish();

    PoseEdge odometryEdge(int keyframe) const { return edges_.odometry(keyframe); }
    PoseGraph poseGraph() const { return edges_.graph(closer_.loops()); }
    std::vector<std::pair<int, int>> covisibility() const { return edges_.covisiblePairs(); }
    std::vector<TrackedFrame> frames() const { return trajectory_.views(map_, uncertainty_); }
    std::vector<KeyframeView> keyframes() const;
    std::vector<LandmarkView> landmarks() const;
    const std::vector<PoseEdge>& loops() const { return closer_.loops(); }
    std::vector<FeatureView> features() const { return tracker_.features(); }
    const MotionSummary& motion() const { return motion_.summary(); }
    MapSnapshot snapshot() const;
    std::vector<VisualSlam::StageTime> stageTimes() const { return times_.all(); }

    void save(ByteWriter& out) const;
    void load(ByteReader& in);

  private:
    static SlamOptions optionsFor(SlamOptions options, const Rig& rig);
    static std::vector<FrameBuilder> buildersFor(const FeatureOptions& features, const Rig& rig);
    Frame build(const std::vector<CameraImage>& images) const;
    void start(Frame frame, FrameRecord& record);
    std::optional<SE3> predictedBySensors(const Frame& frame) const;
    std::optional<Prediction> prediction(const Frame& frame) const;
    std::optional<LocatedFrame> trackBelievably(Frame& frame, FrameRecord& record);
    void holdStill(const Frame& frame, LocatedFrame& located) const;
    void removeMovers(Frame& frame, LocatedFrame& located, FrameRecord& record);
    std::optional<LocatedFrame> locate(Frame& frame, FrameRecord& record);
    void acceptTracked(Frame frame, LocatedFrame located, FrameRecord& record);
    void handleTrackingLoss(Frame frame, FrameRecord& record);
    void startSubmap(Frame frame, FrameRecord& record);
    std::vector<KeyframeTie> tiesOf(const LocatedFrame& located) const;
    int insertKeyframe(const Frame& frame, const LocatedFrame& located, int submap,
                       const std::vector<KeyframeTie>& ties);
    /** Writes the local adjustment into the map, if one is under way. */
    void applyPendingAdjustment();
    /** The adjustment of everything as well. */
    void applyPendingAdjustments();
    /** Brings two submaps together where a loop says. */
    void mergeSubmaps(const PoseEdge& loop);

    const SlamOptions options_;
    const Rig rig_;
    const RigCameras cameras_;
    const std::vector<FrameBuilder> builders_;  // one per camera
    SlamMap map_;
    Tracker tracker_;
    LocalMapper mapper_;
    GlobalBundleAdjuster global_adjuster_;
    LoopCloser closer_;
    const KeyframeEdges edges_;
    FallbackTracker fallback_;
    Relocalizer relocalizer_;
    MoverWatch movers_;
    KeyframeDecision decision_;
    TrajectoryRecord trajectory_;
    MotionEstimator motion_;
    MapUncertainty uncertainty_;
    int frames_since_keyframe_ = 0;
    int frames_since_loop_ = 0;
    /** Of the next keyframe to the last one. */
    Link link_ = Link::Tracked;
    /** Whether any frame of this run has been located. */
    bool initialized_ = false;
    mutable StageTimes times_;
};

}  // namespace rgbd_graphslam
