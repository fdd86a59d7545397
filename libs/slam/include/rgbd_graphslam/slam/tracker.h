/** Pose of each new frame against the map. */
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "rgbd_graphslam/estimation/pose_solver.h"
#include "rgbd_graphslam/slam/feature_view.h"
#include "rgbd_graphslam/slam/slam_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** A frame whose pose is known. */
struct LocatedFrame {
    SE3 T_cam_world;
    /** One per keypoint: the landmark it shows, or no_landmark. */
    std::vector<int> landmarks;
    int inliers = 0;
    /** Landmarks of the local map that the pose puts into the image. */
    int expected = 0;
    /** Inverse covariance of the pose's left perturbation (m, rad in the camera frame) by the
     *  inliers, as if their errors were independent; zero where the pose comes from elsewhere. */
    Matrix6d information = Matrix6d::Zero();
};

/** Where a frame is expected to be. */
struct ExpectedPose {
    SE3 T_cam_world;
    /** Standard deviations of its position and rotation. */
    double sigma_m = 0, sigma_rad = 0;
};

/** Frame-to-frame prediction, then the local map. Keeps the last frame; all that it remembers is
 *  tied to a keyframe, so that it moves with the map. */
class Tracker {
  public:
    /** All arguments must outlive the tracker. */
    Tracker(const SlamOptions& options, const RigCameras& cameras, SlamMap& map);

    /** \param frame keypoints move to the exact places of the landmarks that they show
     *  \param predicted T_cam_world; nothing: the camera moves on as it did
     *  \return nothing when fewer than `min_inliers` landmarks agree with any pose */
    std::optional<LocatedFrame> track(Frame& frame,
                                      const std::optional<SE3>& predicted = std::nullopt);

    /** Pose by the points of the last frame alone, for where the map is not seen.
     *  \param predicted T_cam_world
     *  \return landmarks as far as the last frame had them; nothing when fewer than `min_inliers`
     *          points agree */
    std::optional<LocatedFrame> followLast(const Frame& frame, const SE3& predicted) const;

    /** Searches the landmarks around a pose and refines it; for a frame placed by other means.
     *  \param frame as for track()
     *  \param landmarks known already, one per keypoint
     *  \param kernel Geman and McClure's for a pose that is good already */
    std::optional<LocatedFrame> trackLocalMap(Frame& frame, const SE3& T_cam_world,
                                              const std::vector<int>& landmarks,
                                              KernelShape kernel = KernelShape::Huber);

    /** Solves for the pose of a located frame again, after landmarks were removed from it.
     *  \return whether at least `min_inliers` agree; the pose is unchanged if not */
    bool solveAgain(const Frame& frame, LocatedFrame& located) const;

    /** Searches the landmarks of some keyframes around a pose that dead reckoning tells, in windows
     *  as wide as it is uncertain, aligns the points by RANSAC and goes on as trackLocalMap().
     *  \return nothing when too few agree, or when the windows would be too wide to tell much */
    std::optional<LocatedFrame> trackAround(Frame& frame, const ExpectedPose& expected,
                                            const std::vector<int>& keyframes);

    /** Tells where the last frame was, after track() or other means.
     *  \param reference_keyframe that the pose is tied to
     *  \param keep_motion false forgets the velocity (after a jump) */
    void setLast(Frame frame, LocatedFrame located, int reference_keyframe, bool keep_motion);

    /** Keypoints of the last frame, and where it missed landmarks of the frame before it. */
    std::vector<FeatureView> features() const;

    /** What coming frames depend on. */
    void save(ByteWriter& out) const;
    /** The map must be loaded. \throws DamagedBytes */
    void load(ByteReader& in);

    bool hasLast() const { return last_.has_value(); }
    void forget() { last_.reset(); }

  private:
    struct Last {
        Frame frame;
        std::vector<int> landmarks;
        int reference_keyframe = 0;
        SE3 T_cam_reference;
    };
    SE3 lastPose() const;
    void addMissed(std::vector<FeatureView>& features) const;
    std::vector<int> matchLast(const Frame& frame, const SE3& predicted, double window_px,
                               PoseSolution& solution) const;
    std::vector<int> localLandmarks(const std::vector<int>& matched);
    std::vector<int> landmarksOf(const std::vector<int>& keyframes);
    int searchLocalLandmarks(const Frame& frame, const SE3& T_cam_world,
                             std::vector<int>& landmarks);
    std::vector<std::pair<int, int>> matchAround(const Frame& frame, const ExpectedPose& expected,
                                                 const std::vector<int>& keyframes);
    std::optional<SE3> alignAround(const Frame& frame, const ExpectedPose& expected,
                                   const std::vector<int>& keyframes, std::vector<int>& landmarks);

    const SlamOptions& options_;
    const RigCameras& cameras_;
    SlamMap& map_;
    std::optional<Last> last_;
    std::vector<int> landmarks_before_;  // of the frame before the last one
    SE3 motion_;                         // T_cam_lastcam of the last two frames
    std::vector<int> visited_;           // one a landmark: search in which it was met last
    int search_ = 0;
};

/** Matches of a frame's keypoints with the landmarks they show. */
std::vector<PointMatch> matchesOf(const Frame& frame, const std::vector<int>& landmarks,
                                  const SlamMap& map, const SensorOptions& sensor);

}  // namespace rgbd_graphslam
