/** The state of a VisualSlam and what it does with a frame. */
#pragma once
#include <optional>

#include "fallback_tracker.h"
#include "keyframe_decision.h"
#include "keyframe_edges.h"
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

/** Decides for each frame whether the map shows where it is, takes it in, or goes on without. */
class VisualSlam::Implementation {
  public:
    Implementation(const SlamOptions& slam_options, const Camera& slam_camera)
        : options(slam_options),
          camera(slam_camera),
          builder(options.features, camera),
          map(options.features.scale_factor, options.features.levels),
          tracker(options, camera, map),
          mapper(options, camera, map),
          global_bundle_adjuster(options, camera, map),
          closer(options, camera, map),
          edges(options.sensor, camera, map),
          fallback(options.recovery, tracker),
          relocalizer(options, camera, map, closer, tracker),
          decision(options.keyframes) {}

    /** Starts from a map. \throws Error when it does not fit the options or the camera */
    void restore(MapSnapshot snapshot, MapUse use);
    /** See VisualSlam. */
    void save(ByteWriter& out) const;
    /** See VisualSlam. \throws DamagedBytes */
    void load(ByteReader& in);
    /** \throws Error when the frame is not later than the last one */
    TrackedFrame track(Frame frame);
    /** Writes the local adjustment into the map, if one is under way. */
    void applyPendingAdjustment();
    /** The adjustment of everything as well. */
    void applyPendingAdjustments();
    /** Brings two submaps together where a loop says. */
    void join(const PoseEdge& loop);

    const SlamOptions options;
    const Camera camera;
    const FrameBuilder builder;
    SlamMap map;
    Tracker tracker;
    LocalMapper mapper;
    GlobalBundleAdjuster global_bundle_adjuster;
    LoopCloser closer;
    const KeyframeEdges edges;
    FallbackTracker fallback;
    Relocalizer relocalizer;
    KeyframeDecision decision;
    TrajectoryRecord records;
    MapUncertainty uncertainty;
    int frames_since_keyframe = 0;
    int frames_since_loop = 0;
    /** Of the next keyframe to the last one. */
    Link link = Link::Tracked;
    /** Whether any frame of this run has been located. */
    bool initialized = false;
    mutable StageTimes times;

  private:
    void start(Frame frame, FrameRecord& record);
    std::optional<Prediction> prediction(const Frame& frame) const;
    std::optional<LocatedFrame> trackBelievably(Frame& frame, FrameRecord& record);
    std::optional<LocatedFrame> locate(Frame& frame, FrameRecord& record);
    void acceptTracked(Frame frame, LocatedFrame located, FrameRecord& record);
    void handleTrackingLoss(Frame frame, FrameRecord& record);
    void startSubmap(Frame frame, FrameRecord& record);
    int insertKeyframe(const Frame& frame, const LocatedFrame& located, int submap, int reference,
                       const KeyframeLink& tie);
};

}  // namespace rgbd_graphslam
