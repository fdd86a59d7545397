/** How much of a run's space has been mapped so far, from poses alone. */
#pragma once
#include <cstdint>
#include <unordered_set>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {

/** Counts cells of half a meter before the cameras. Maps grow with the space that was seen rather
 *  than with the number of keyframes, so the memory of a part tells that of the whole. */
class ViewCoverage {
  public:
    /** \param keyframes all that will come */
    ViewCoverage(const Camera& camera, const Trajectory& keyframes);

    void add(const SE3& T_world_cam);

    /** Of what all keyframes see, what those added see; in [0, 1]. */
    double share() const;

  private:
    using Cells = std::unordered_set<std::uint64_t>;
    void look(const SE3& T_world_cam, Cells& cells) const;

    Camera camera_;
    Cells all_, seen_;
};

}  // namespace rgbd_graphslam
