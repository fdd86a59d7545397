/** A point seen from a keyframe, as a factor. */
#pragma once
#include "rgbd_graphslam/estimation/factor.h"
#include "rgbd_graphslam/estimation/reprojection.h"

namespace rgbd_graphslam {

/** Constrains the keyframe's pose and the point. The hand-written solvers evaluate observations
 *  through PointView without going through this class. */
class PointObservation final : public Factor {
  public:
    /** \param camera must outlive the factor */
    PointObservation(const MountedCamera& camera, int keyframe, int point,
                     const Measurement& measurement)
        : camera_(&camera), keyframe_(keyframe), point_(point), measurement_(measurement) {}

    std::vector<StateKey> states() const override { return {poseKey(keyframe_), pointKey(point_)}; }
    int residualSize() const override { return 3; }
    RobustKernel kernel() const override { return {KernelShape::Huber, chi2Limit(measurement_)}; }
    bool linearize(const StateBlocks& states, Linearization& out) const override;

  private:
    const MountedCamera* camera_;
    int keyframe_, point_;
    Measurement measurement_;
};

}  // namespace rgbd_graphslam
