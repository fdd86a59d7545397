#include "rgbd_graphslam/dataset/rawlog_info.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/stereo_frame.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
using mrpt::obs::CObservation3DRangeScan;
namespace {

void addFrame(RawlogInfo& info, const CObservation3DRangeScan& frame) {
    info.last_stamp_s = toSeconds(frame.timestamp);
    if (info.rgbd_frames++ > 0) return;
    info.first_stamp_s = info.last_stamp_s;
    info.camera = cameraOf(frame);
    info.depth_unit_m = frame.rangeUnits;
    info.T_base_cam = cameraOnRobot(frame);
    info.depth_is_registered = frame.doDepthAndIntensityCamerasCoincide();
}

void add(RawlogInfo& info, const CObservation& observation) {
    if (const auto* frame = dynamic_cast<const CObservation3DRangeScan*>(&observation)) {
        addFrame(info, *frame);
    } else if (IS_CLASS(observation, mrpt::obs::CObservationIMU)) {
        ++info.imu;
    } else if (IS_CLASS(observation, mrpt::obs::CObservationOdometry)) {
        ++info.odometry;
    } else if (IS_CLASS(observation, mrpt::obs::CObservationRobotPose)) {
        ++info.robot_poses;
    } else {
        ++info.others;
    }
}

}  // namespace

RawlogInfo inspectRawlog(const std::string& path) {
    RawlogReader reader(path);
    RawlogInfo info;
    try {
        while (const auto observation = reader.next()) add(info, *observation);
    } catch (const Error& e) {
        info.damage = e.what();
    }
    return info;
}

Trajectory truthOf(const std::string& rawlog_path) {
    RawlogReader reader(rawlog_path);
    Trajectory T_world_base;
    SE3 T_base_cam = T_optical_from_mrpt.inverse();
    bool camera_known = false;
    while (const auto observation = reader.next()) {
        if (const auto* pose =
                dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observation.get())) {
            if (pose->sensorLabel != ground_truth_label) continue;
            T_world_base.push_back({toSeconds(pose->timestamp), toSE3(pose->pose.mean)});
        } else if (const auto frame = asRgbdFrame(observation)) {
            if (!camera_known) T_base_cam = cameraOnRobot(*frame);
            camera_known = true;
        }
    }
    for (auto& pose : T_world_base) pose.T_world_cam = pose.T_world_cam * T_base_cam;
    return T_world_base;
}

}  // namespace rgbd_graphslam
