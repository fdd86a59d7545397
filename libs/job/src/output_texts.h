/** The text files of an output folder. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {

/** A line a frame: stamp, origin, inliers, keyframe id or nothing. */
std::string framesCsv(const std::vector<TrackedFrame>& frames);

/** A line a frame: stamp, and how long tracking it took. */
std::string frameTimesCsv(const std::vector<FrameTime>& times);

/** A line an edge: the two keyframes and how many landmarks both see. */
std::string covisibilityCsv(const std::vector<PoseEdge>& edges);

std::string summaryJson(const SlamJob& job, const JobReport& report);

struct StageFigures {
    double mean = 0, median = 0, p95 = 0, max = 0;
};

/** \param ms not empty */
StageFigures figuresOf(const std::vector<double>& ms);

}  // namespace rgbd_graphslam
