#include "rgbd_graphslam/mapping/level_survey.h"

#include <mrpt/obs/CObservationIMU.h>

#include <algorithm>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/mapping/keyframe_reader.h"

namespace rgbd_graphslam {
namespace {

std::optional<Eigen::Vector3d> specificForce(const mrpt::obs::CObservationIMU& imu) {
    using namespace mrpt::obs;
    if (!imu.has(IMU_X_ACC) || !imu.has(IMU_Y_ACC) || !imu.has(IMU_Z_ACC)) return std::nullopt;
    return Eigen::Vector3d(imu.get(IMU_X_ACC), imu.get(IMU_Y_ACC), imu.get(IMU_Z_ACC));
}

/** Cameras are mostly held upright. */
Eigen::Vector3d meanCameraTop(const Trajectory& poses) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& pose : poses) sum -= pose.T_world_cam.R.col(1);
    return sum.normalized();
}

/** Distance between the keyframes kept of a run with so many. */
std::size_t stepFor(std::size_t keyframes) {
    std::size_t step = 1;
    while ((keyframes + step - 1) / step > LevelSurvey::enough_keyframes) step *= 2;
    return step;
}

}  // namespace

void LevelSurvey::note(const mrpt::obs::CObservation& observation) {
    if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation)) {
        const auto force = specificForce(*imu);
        if (!force) return;
        forces_in_base_.push_back({toSeconds(imu->timestamp), toSE3(imu->sensorPose).R * *force});
    } else {
        noteDepthStamps(observation, depth_stamps_);
    }
}

void LevelSurvey::addKeyframe(std::size_t number, const RgbdImage& image, const Camera& camera) {
    if (number % step_ != 0) return;
    if (!rays_) rays_.emplace(camera);
    keyframes_.push_back(
        {number, depthStamp(depth_stamps_, image.stamp_s),
         surfacePatches(cleanDepth(image, camera, options_), *rays_, options_.max_range_m)});
    step_ = stepFor(number + 1);
    const auto skipped = [&](const SurveyedKeyframe& k) { return k.number % step_ != 0; };
    keyframes_.erase(std::remove_if(keyframes_.begin(), keyframes_.end(), skipped),
                     keyframes_.end());
}

SE3 LevelSurvey::uprightFromWorld(const MapInputs& inputs, const SE3& T_base_cam) const {
    const MapInputs kept = withoutApart(inputs);
    const auto patches = patchesInWorld(inputs);
    const Eigen::Vector3d up = findUp(kept, patches, forcesInCamera(T_base_cam));
    const auto floor = floorHeight(patches, up);
    if (!floor) sayWarning("no level surface was seen: the first camera is taken to be at z = 0");
    const SE3& T_first = kept.keyframes.front().T_world_cam;
    return uprightFrame(up, floor.value_or(up.dot(T_first.t)), T_first);
}

std::vector<SurfacePatch> LevelSurvey::patchesInWorld(const MapInputs& inputs) const {
    std::vector<SurfacePatch> patches;
    for (const SurveyedKeyframe& keyframe : keyframes_) {
        const int number = static_cast<int>(keyframe.number);
        if (std::binary_search(inputs.apart.begin(), inputs.apart.end(), number)) continue;
        const SE3 T_world_cam =
            depthPose(inputs.keyframes[keyframe.number], keyframe.depth_stamp_s, inputs.trajectory);
        for (const SurfacePatch& patch : keyframe.patches) {
            patches.push_back({T_world_cam * patch.position, T_world_cam.R * patch.normal});
        }
    }
    return patches;
}

std::vector<SpecificForce> LevelSurvey::forcesInCamera(const SE3& T_base_cam) const {
    std::vector<SpecificForce> forces;
    for (const SpecificForce& force : forces_in_base_) {
        forces.push_back({force.stamp_s, T_base_cam.R.transpose() * force.in_camera});
    }
    return forces;
}

/** A Kinect's accelerometer is some 4 degrees off (TUM fr1/xyz against its ground truth), a floor
 *  well below one: so gravity says which surfaces are level, and these say what level is. */
Eigen::Vector3d LevelSurvey::findUp(const MapInputs& kept, const std::vector<SurfacePatch>& patches,
                                    const std::vector<SpecificForce>& forces) const {
    constexpr double accelerometer_error = 8 * M_PI / 180, camera_error = M_PI / 4;
    const Trajectory& poses = kept.trajectory.empty() ? kept.keyframes : kept.trajectory;
    if (options_.upright == "gravity") {
        if (const auto up = upFromAccelerometer(forces, poses)) {
            return upFromFloor(patches, *up, accelerometer_error).value_or(*up);
        }
        sayInfo("no usable accelerometer in the rawlog: up is taken from the floor");
    }
    if (options_.upright != "none") {
        const auto up = upFromFloor(patches, meanCameraTop(kept.keyframes), camera_error);
        if (up) return *up;
    }
    const bool was_asked_for = options_.upright == "none";
    sayWarning(
        std::string(was_asked_for ? "upright = none" : "no accelerometer and no floor found") +
        ": " + guessed_up + ", so the map may be tilted and the floor's height is arbitrary");
    return -kept.keyframes.front().T_world_cam.R.col(1);
}

SE3 uprightFromWorld(const MapInputs& inputs, const MapOptions& options) {
    checkInputs(inputs);
    LevelSurvey survey(options);
    SE3 T_base_cam;
    const std::size_t step = stepFor(inputs.keyframes.size());
    Trajectory some;
    for (std::size_t k = 0; k < inputs.keyframes.size(); k += step) {
        some.push_back(inputs.keyframes[k]);
    }
    forEachKeyframe(
        inputs.rawlog, some, "finding the floor",
        [&](const Keyframe3D& keyframe) {
            T_base_cam = keyframe.T_base_cam;
            survey.addKeyframe(step * keyframe.index, keyframe.image, keyframe.camera);
        },
        [&](const mrpt::obs::CObservation& observation) { survey.note(observation); });
    return survey.uprightFromWorld(inputs, T_base_cam);
}

}  // namespace rgbd_graphslam
