/** A finished run as the viewer shows it. */
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/frame_entries.h"
#include "rgbd_graphslam/mapping/point_fusion.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Two keyframes, by their place in RunData::keyframes. */
struct KeyframeEdge {
    int from = 0, to = 0;
};

/** A frame as frames.csv has it. */
struct FrameNote {
    double stamp_s = 0;
    bool lost = false;
    int inliers = 0;
};

/** A leaf of the octree. */
struct OctreeCell {
    Eigen::Vector3f center;  // m
    float size_m = 0;
    std::array<std::uint8_t, 3> rgb{};
};

/** Leaves of an octree; what is in neither list is unseen. */
struct OctreeCells {
    std::vector<OctreeCell> occupied, free;
};

/** Cells of the 2-D grid: probability of being free, row by row from the lowest y. */
struct GridMap {
    int width = 0, height = 0;
    double resolution_m = 0, x_min_m = 0, y_min_m = 0;
    std::vector<float> free;
};

/** All that is shown of a run. */
struct RunData {
    /** Output folder; empty when only a cloud was opened. */
    std::string folder;
    std::string rawlog;        // empty when it is gone
    std::string sensor_label;  // of the camera, as MapInputs::sensor_label
    FrameEntries entries;      // as MapInputs::entries
    /** Neither an accelerometer nor a floor has said which way is up. */
    bool up_is_guessed = false;
    Trajectory trajectory, keyframes, keyframes_before_loops;
    /** Numbers of keyframes of earlier sessions; paths are not drawn from one to the next. */
    std::vector<std::size_t> earlier_keyframes;
    /** In the estimate's world, at its stamps; empty where it is not known. */
    Trajectory truth;
    /** Stamps of frames without a pose, rising. */
    std::vector<double> unplaced_s;
    /** Each list by the later of the two keyframes, so that a replay shows a prefix. */
    std::vector<KeyframeEdge> loops, covisibility;
    std::vector<FrameNote> frames;
    std::vector<float> frame_times_ms;  // wall time of tracking each of them
    PointMap points;
    PlyModel mesh;
    OctreeCells octree;
    std::optional<GridMap> grid;
};

/** Reads what is there; only the trajectory must be. Maps that are missing stay empty, damaged ones
 *  are named in a warning. A run that was localized comes with the map that it was localized in.
 *  \param path output folder of rgbd-slam, or a `.ply`
 *  \throws Error when there is no run */
RunData loadRun(const std::string& path);

}  // namespace rgbd_graphslam
