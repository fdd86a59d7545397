/** Relative poses of keyframes as the map measures them. */
#pragma once
#include <utility>
#include <vector>

#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** Makes edges between keyframes, with the information of the landmarks that both ends see. */
class KeyframeEdges {
  public:
    /** All arguments must outlive the edges. */
    KeyframeEdges(const SensorOptions& sensor, const RigCameras& cameras, const SlamMap& map)
        : sensor_(sensor), cameras_(cameras), map_(map) {}

    /** From the keyframe before `keyframe` (> 0) to it; next to no information where the camera
     *  lost its way between them. */
    PoseEdge odometry(int keyframe) const;

    /** Present poses of all keyframes with the edges of odometry and covisibility, and these loops
     *  after them. */
    PoseGraph graph(const std::vector<PoseEdge>& loops) const;

    /** The ends of the graph's edges of covisibility, without what measuring them costs. */
    std::vector<std::pair<int, int>> covisiblePairs() const;

  private:
    bool follows(int keyframe) const;
    std::vector<Covisibility> fartherThanLast(int keyframe) const;
    std::vector<PoseEdge> covisibility(const PoseEdge& odometry) const;
    std::vector<PoseEdge> edgesTo(int keyframe) const;
    std::vector<int> sharedLandmarks(int keyframe, int other) const;
    Matrix6d informationOf(int keyframe, const std::vector<int>& landmarks) const;

    const SensorOptions& sensor_;
    const RigCameras& cameras_;
    const SlamMap& map_;
};

}  // namespace rgbd_graphslam
