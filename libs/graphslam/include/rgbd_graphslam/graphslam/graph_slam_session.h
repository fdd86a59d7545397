/** RGB-D SLAM through MRPT's graph-SLAM engine. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <functional>
#include <memory>
#include <string>

#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/slam/slam_options.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** One run of mrpt::graphslam::CGraphSlamEngine with our deciders and optimizer. To embed it: make
 *  a session, call step() for each observation, ask slam() for poses and map.
 *
 *  The engine is built with the process's standard streams turned to /dev/null for a few
 *  milliseconds, because its constructor waits for a key and talks; make sessions before starting
 *  threads that print. */
class GraphSlamSession {
  public:
    /** \param rig cameras with their poses on the robot, see rigCameraOf() */
    GraphSlamSession(const SlamOptions& options, const Rig& rig);
    /** Of one camera. \param first_frame gives its calibration and its pose on the robot */
    GraphSlamSession(const SlamOptions& options,
                     const mrpt::obs::CObservation3DRangeScan& first_frame);
    /** Starts from a map, lost in it.
     *  \throws Error when it does not fit the options or the cameras */
    GraphSlamSession(const SlamOptions& options, const Rig& rig, MapSnapshot map, MapUse use);
    ~GraphSlamSession();

    /** Features of a frame. Thread-safe, so that it can run ahead of step(). */
    Frame prepare(const RgbdImage& image) const;
    /** Of images that cameras of the rig took at one moment, by rising number. */
    Frame prepare(const std::vector<CameraImage>& images) const;

    /** Tracks the next frame, grows the graph, closes loops.
     *  \param prepared what prepare() made of the observation
     *  \throws Error when its stamp is not later than the last one's */
    TrackedFrame step(const mrpt::obs::CObservation3DRangeScan::Ptr& observation, Frame prepared);

    /** step() that prepares the frame itself. \throws Error for unusable images, naming the frame
     */
    TrackedFrame step(const mrpt::obs::CObservation3DRangeScan::Ptr& observation);

    /** Calls this within each step() as soon as the pose is known, before loops are searched.
     *  \param take may be empty */
    void onPose(std::function<void(const TrackedFrame&)> take);

    /** Refines the whole map once more. */
    void finish();

    /** All that the steps to come depend on, see VisualSlam::save(). */
    void save(ByteWriter& out) const;
    /** For a session that has made no step, with the options and the first frame of the saved one.
     *  \throws DamagedBytes */
    void load(ByteReader& in);

    const VisualSlam& slam() const;
    /** Pose of the first color camera's optical frame on the robot's base. */
    const SE3& T_base_cam() const;

    /** Writes the graph in MRPT's text format (that of TORO): robot poses at the keyframes,
     *  odometry and loop edges with their information. \param T_out_world put before every pose
     *  \throws Error naming the path when it cannot be written */
    void writeGraph(const std::string& path, const SE3& T_out_world) const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
