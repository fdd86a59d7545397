/** Search for landmarks around the places where the cameras should see them. */
#pragma once
#include <utility>
#include <vector>

#include "rgbd_graphslam/slam/matcher.h"
#include "rgbd_graphslam/slam/rig_cameras.h"
#include "rgbd_graphslam/slam/slam_map.h"

namespace rgbd_graphslam {

/** A landmark as a camera would see it. */
struct ProjectedLandmark {
    int id = no_landmark;
    int camera = 0;
    double depth_m = 0;
    Eigen::Vector2d pixel;
    Eigen::Vector3d to_camera;  // from the landmark to the body, world, m
    double distance_m = 0;
};

/** How closely a keypoint must resemble a landmark, and how near its place it must be. */
struct SearchLimits {
    double window_px = 5;     // on pyramid level 0; grows with the landmark's level
    double uncertain_px = 0;  // added on every level
    int max_hamming = 64;
    float ratio = 1;  // see MatchTable::search
};

class ProjectedSearch {
  public:
    /** All arguments must outlive the search. */
    ProjectedSearch(const Frame& frame, const SE3& T_cam_world, const RigCameras& cameras,
                    const SlamMap& map);

    /** Takes a keypoint out of the search. */
    void reserve(int keypoint) { table_.reserve(keypoint); }

    /** Calls visit(ProjectedLandmark) for the cameras that have the landmark in their image until
     * one returns true. */
    template <class Visit>
    void visitViews(int landmark, Visit&& visit) const {
        const Eigen::Vector3d& position = map_.landmark(landmark).position;
        const Eigen::Vector3d to_camera = camera_position_ - position;
        cameras_.visitViews(T_cam_world_ * position,
                            [&](int camera, const Eigen::Vector2d& pixel, double depth_m) {
                                return visit(ProjectedLandmark{landmark, camera, depth_m, pixel,
                                                               to_camera, to_camera.norm()});
                            });
    }

    /** Pyramid level on which a landmark is expected, not clamped. */
    int octave(const ProjectedLandmark& landmark) const;
    /** Whether that level, or the next one to it, is in the pyramid. */
    bool isInPyramid(int octave) const { return octave >= -1 && octave <= map_.levels(); }

    /** Looks for a landmark on its level and the neighboring ones.
     *  \return whether it has a keypoint now */
    bool search(const ProjectedLandmark& landmark, int octave, const SearchLimits& limits);

    /** Found so far: (keypoint, landmark) by rising keypoint. */
    std::vector<std::pair<int, int>> matches() const { return table_.matches(); }

  private:
    const SE3& T_cam_world_;
    const RigCameras& cameras_;
    const SlamMap& map_;
    const Eigen::Vector3d camera_position_;
    MatchTable table_;
};

}  // namespace rgbd_graphslam
