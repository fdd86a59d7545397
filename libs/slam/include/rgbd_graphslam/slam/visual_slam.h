/** Visual SLAM on RGB-D frames: tracking, keyframes, local mapping, loops. Knows nothing of
 * rawlogs, files or windows. */
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/rig.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/slam/feature_view.h"
#include "rgbd_graphslam/slam/map_snapshot.h"
#include "rgbd_graphslam/slam/motion_summary.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

class SlamPipeline;

/** How a frame's pose was obtained. */
enum class FrameOrigin {
    /** By landmarks, from the frame before. */
    Tracked,
    /** By landmarks, found anywhere in the map after the way was lost. */
    Recovered,
    /** By the motion since the last frame only: its points, whole images, odometry or gyroscope. */
    DeadReckoned,
    /** Not at all; the pose is the last one known. */
    Lost,
    /** Landmarks are seen, but too few or too far from what the motion allows to be believed. */
    Uncertain,
};

/** "tracked", "recovered", "dead_reckoned", "lost" or "uncertain". */
const char* toString(FrameOrigin origin);

/** The answer to one frame. */
struct TrackedFrame {
    double stamp_s = 0;
    FrameOrigin origin = FrameOrigin::Lost;
    SE3 T_world_cam;
    /** Of the camera's position (m) along and its rotation (rad) about the axes of its optical
     *  frame, in the world that the first keyframe defines; nothing when lost. */
    std::optional<Matrix6d> covariance;
    /** Landmarks that agreed with the pose. */
    int inliers = 0;
    /** Keyframe this frame's pose is stored relative to. */
    int reference_keyframe = 0;
    SE3 T_reference_cam;
    /** Of the map, see KeyframeView::submap. */
    int submap = 0;
    /** Set when the frame became a keyframe: its id, which counts from 0 without gaps. */
    std::optional<int> keyframe;
};

/** What a run does with the map that it starts from. */
enum class MapUse {
    /** The map's keyframes stay where they are; of the run's own only the latest are kept, so that
     *  memory stays flat. */
    Localize,
    /** Frames are located in it and add to it. */
    Extend,
};

/** One keyframe as others see it. */
struct KeyframeView {
    int id = 0;
    double stamp_s = 0;
    SE3 T_world_cam;
    /** Dropped from the map because others see the same; its pose stays a node of the graph. */
    bool culled = false;
    /** Where the camera was lost and met nothing known, a submap begins whose place relative to the
     *  others is unknown until a loop joins them. */
    int submap = 0;
};

/** One landmark as others see it. */
struct LandmarkView {
    Eigen::Vector3d position;  // world, m
    int observations = 0;
};

/** An image and the camera of the rig that took it. */
struct CameraImage {
    int camera = 0;
    RgbdImage image;
};

/** Feed frames in order of time:
 *  \code
 *    VisualSlam slam(options, camera);
 *    for (image : images) {
 *        TrackedFrame tracked = slam.track(slam.prepare(image));
 *        if (tracked.keyframe) slam.closeLoops(*tracked.keyframe);
 *    }
 *    slam.finish();
 *  \endcode
 *  The result depends on the frames and options only, never on timing or thread count. */
class VisualSlam {
  public:
    /** \param rig its first camera is the one whose poses are told; see rigOf() for a single one */
    VisualSlam(const SlamOptions& options, const Rig& rig);
    VisualSlam(const SlamOptions& options, const CameraModel& camera)
        : VisualSlam(options, rigOf(camera)) {}
    /** Starts from a map, lost in it.
     *  \throws Error when the map is of another image pyramid or number of cameras, or is to be
     *          extended by other cameras */
    VisualSlam(const SlamOptions& options, const Rig& rig, MapSnapshot map, MapUse use);
    VisualSlam(const SlamOptions& options, const CameraModel& camera, MapSnapshot map, MapUse use)
        : VisualSlam(options, rigOf(camera), std::move(map), use) {}
    ~VisualSlam();

    /** Features of an image with their depth. Thread-safe: a pipeline calls it ahead of track(). */
    Frame prepare(const RgbdImage& image) const;
    /** Of images that cameras of the rig took at one moment, by rising number of the camera; the
     *  frame's stamp is the first one's. */
    Frame prepare(const std::vector<CameraImage>& images) const;

    /** Pose of the next frame. \throws Error when its stamp is not later than the last one's */
    TrackedFrame track(Frame frame);

    /** The edge from the keyframe before `keyframe` (> 0) to it, measured by what both see. */
    PoseEdge odometryEdge(int keyframe) const;

    /** Finds the places seen before that `keyframe` sees again, optimizes the pose graph with these
     *  loops, and corrects the map. \return the loops found and verified; loops() has those that
     *  the optimized graph upholds */
    std::vector<PoseEdge> closeLoops(int keyframe);

    /** First step of closeLoops(), for those who optimize poseGraph() themselves: loops that are
     *  geometrically verified; they join the graph. correct() must follow when there are any. */
    std::vector<PoseEdge> findLoops(int keyframe);

    /** Present poses of all keyframes and the edges between them: odometry, covisibility, loops. */
    PoseGraph poseGraph() const;

    /** Which keyframes the graph's edges of covisibility connect, the earlier first; much cheaper
     *  than the graph. */
    std::vector<std::pair<int, int>> covisibility() const;

    /** Moves keyframes to new poses, landmarks with them, fuses what the loop brought together.
     *  \param T_world_keyframe one pose a keyframe */
    void correct(const std::vector<SE3>& T_world_keyframe);

    /** Waits for the mapper and refines the whole map once more. */
    void finish();

    /** Every frame so far with its pose as the map knows it now. */
    std::vector<TrackedFrame> frames() const;
    std::vector<KeyframeView> keyframes() const;
    std::vector<LandmarkView> landmarks() const;
    /** Loops closed so far. */
    const std::vector<PoseEdge>& loops() const;
    /** Of the last frame; none when it is lost. */
    std::vector<FeatureView> features() const;

    /** What is known of inertial sensor and wheels so far. */
    const MotionSummary& motion() const;

    /** The map for another run; finish() first. */
    MapSnapshot snapshot() const;

    /** All that the poses to come depend on, so that a process that load()s it goes on to the same
     *  bits; stage times do not. Not between findLoops() and correct(). Costs some 0.1 ms a living
     *  keyframe. */
    void save(ByteWriter& out) const;
    /** For a SLAM that has seen no frame, made with the options and the camera of the saved one.
     *  \throws DamagedBytes */
    void load(ByteReader& in);

    struct StageTime {
        std::string stage;
        std::vector<double> cpu_ms, wall_ms;  // one per call
    };
    std::vector<StageTime> stageTimes() const;

  private:
    std::unique_ptr<SlamPipeline> pipeline_;
};

}  // namespace rgbd_graphslam
