/** Gathers, keyframe by keyframe, what tells which way is up. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/depth_stamps.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"
#include "rgbd_graphslam/dataset/sensor_verdict.h"
#include "rgbd_graphslam/mapping/floor.h"
#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/map_options.h"
#include "rgbd_graphslam/mapping/upright.h"

namespace rgbd_graphslam {

/** What every warning says in which up is nothing but a guess. */
inline constexpr const char* guessed_up = "assuming the first camera was level";

/** Fed while the rawlog is read for tracking, it spares reading it again. Of a long run it keeps
 *  every second, every fourth, ... keyframe, so that its memory is bounded. */
class GravityAligner {
  public:
    /** Most keyframes that are kept. */
    static constexpr std::size_t enough_keyframes = 60;

    explicit GravityAligner(const MapOptions& options) : options_(options) {}

    /** Takes what the rawlog holds beside images: accelerometer readings and stamps of depth. */
    void note(const mrpt::obs::CObservation& observation);

    /** Takes the surfaces of a keyframe. Where these are stands in MapInputs, later.
     *  \param number of the keyframe, counted from 0 without gaps */
    void addKeyframe(std::size_t number, const RgbdImage& image, const Camera& camera);

    /** T_up_world: z up, floor at z = 0, first camera above the origin and looking along +x. Up is
     *  where the accelerometer says (specific force, averaged over the run in world axes), made
     *  precise by the level surfaces in sight; else the normal of the floor; else the first
     *  camera's, with a warning; see MapOptions::upright. An accelerometer that contradicts the
     *  tracked motion, or has the surfaces upside down, is left out with a warning.
     *  \param inputs the keyframes that were added, and no others
     *  \param T_base_cam the camera on the robot, whose axes the accelerometer's pose refers to */
    SE3 T_gravity_world(const MapInputs& inputs, const SE3& T_base_cam) const;

    /** The surfaces of each keyframe that is kept, in the world of the inputs; see
     *  T_gravity_world(). */
    std::vector<SurfaceView> surfacesInWorld(const MapInputs& inputs) const;

  private:
    struct SurveyedKeyframe {
        std::size_t number;
        double depth_stamp_s;
        std::vector<SurfacePatch> patches;  // in the axes of the depth image
    };
    std::vector<SpecificForce> forcesInCamera(const SE3& T_base_cam) const;
    std::optional<Eigen::Vector3d> upByAccelerometer(const Trajectory& poses,
                                                     const std::vector<SurfacePatch>& patches,
                                                     const SE3& T_base_cam) const;
    Eigen::Vector3d findUp(const MapInputs& kept, const std::vector<SurfacePatch>& patches,
                           const SE3& T_base_cam) const;
    void leaveOut(const SensorVerdict& verdict, const SE3& T_base_cam) const;

    const MapOptions options_;
    std::optional<RayTable> rays_;
    DepthStamps depth_stamps_;
    /** The accelerometer that comes first, in its own axes. */
    std::optional<std::string> accelerometer_;
    SE3 T_base_accelerometer_;
    std::vector<StampedVector> forces_;
    std::vector<SurveyedKeyframe> keyframes_;
    std::size_t step_ = 1;
};

/** The same from the rawlog of a finished run, in one pass over it.
 *  \throws Error when the rawlog cannot be read or holds none of the keyframes */
SE3 T_gravity_world(const MapInputs& inputs, const MapOptions& options);

}  // namespace rgbd_graphslam
