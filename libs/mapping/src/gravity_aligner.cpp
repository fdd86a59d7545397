#include "rgbd_graphslam/mapping/gravity_aligner.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/accelerometer_check.h"
#include "rgbd_graphslam/dataset/inertial_reading.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/sensor_remedy.h"
#include "rgbd_graphslam/dataset/tracked_motion.h"
#include "rgbd_graphslam/mapping/depth_timing.h"
#include "rgbd_graphslam/mapping/recorded_images.h"

namespace rgbd_graphslam {
namespace {

/** Cameras are mostly held upright. */
Eigen::Vector3d meanCameraTop(const Trajectory& poses) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& pose : poses) sum -= pose.T_world_cam.R.col(1);
    return sum.normalized();
}

/** How far a camera that is held upright may lean. */
constexpr double camera_error = M_PI / 4;

/** How many surfaces face a direction to within 14 degrees. */
std::size_t facing(const std::vector<SurfacePatch>& patches, const Eigen::Vector3d& direction) {
    constexpr double near = 0.97;
    return static_cast<std::size_t>(std::count_if(
        patches.begin(), patches.end(),
        [&](const SurfacePatch& patch) { return patch.normal.dot(direction) > near; }));
}

/** Whether level surfaces face up much more than down: floors and tables are seen more than
 *  ceilings. */
bool seenFromAbove(const std::vector<SurfacePatch>& patches, const Eigen::Vector3d& up) {
    constexpr std::size_t fewest = 200;
    const std::size_t above = facing(patches, up), below = facing(patches, -up);
    return above >= fewest && above > 3 * below;
}

/** A camera that lies on its side by an accelerometer whose axes the motion does not show, while
 *  level surfaces say that it is upright. Walls may look level to a camera that does lie.
 *  \param verdict Undecided, or left alone */
void doubtLying(const std::vector<SurfacePatch>& patches, const Eigen::Vector3d& up,
                const Eigen::Vector3d& camera_top, const std::string& label,
                SensorVerdict& verdict) {
    const double leaning = std::cos(camera_error);
    if (verdict.fault != SensorFault::Undecided || up.dot(camera_top) > leaning) return;
    const auto level = upFromFloor(patches, camera_top, camera_error);
    if (!level || level->dot(up) > leaning) return;
    const std::size_t by_camera = facing(patches, *level), by_sensor = facing(patches, up);
    if (by_camera > 2 * by_sensor) {
        verdict.fault = SensorFault::Unusable;
        verdict.finding = "by it the camera lies on its side, by floor and tables it is upright";
    } else if (by_sensor < 2 * by_camera) {
        sayWarning("accelerometer '" + label +
                   "': by it the camera lies on its side, which the motion neither shows nor rules "
                   "out; if it did not, correct imu_pose in camera.ini");
    }
}

/** Distance between the keyframes kept of a run with so many. */
std::size_t stepFor(std::size_t keyframes) {
    std::size_t step = 1;
    while ((keyframes + step - 1) / step > GravityAligner::enough_keyframes) step *= 2;
    return step;
}

std::vector<SurfacePatch> allPatches(const std::vector<SurfaceView>& views) {
    std::vector<SurfacePatch> patches;
    for (const SurfaceView& view : views) {
        patches.insert(patches.end(), view.patches.begin(), view.patches.end());
    }
    return patches;
}

void tellOfFloor(const std::optional<Floor>& floor) {
    if (!floor) {
        sayWarning("no floor found: no level surface was seen, so z = 0 is at the first camera");
    } else if (floor->share_below > most_below_floor) {
        sayWarning(
            formatted("floor uncertain: %.0f %% of the surfaces seen are below the level "
                      "surface at z = 0; the floor may mirror or give no depth, so heights "
                      "and grid may be wrong",
                      100 * floor->share_below));
    } else {
        sayDetail(formatted("%.1f %% of the surfaces seen are below the floor",
                            100 * floor->share_below));
    }
}

}  // namespace

void GravityAligner::note(const mrpt::obs::CObservation& observation) {
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
    if (!imu) {
        noteDepthStamps(observation, depth_stamps_);
        return;
    }
    const auto force = specificForce(*imu);
    if (!force) return;
    if (!accelerometer_) {
        accelerometer_ = imu->sensorLabel;
        T_base_accelerometer_ = toSE3(imu->sensorPose);
    }
    if (imu->sensorLabel == *accelerometer_) forces_.push_back({toSeconds(imu->timestamp), *force});
}

void GravityAligner::addKeyframe(std::size_t number, const RgbdImage& image, const Camera& camera) {
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

SE3 GravityAligner::T_gravity_world(const MapInputs& inputs, const SE3& T_base_cam) const {
    const MapInputs kept = withoutDisconnected(inputs);
    const auto views = surfacesInWorld(inputs);
    const Eigen::Vector3d up = findUp(kept, allPatches(views), T_base_cam);
    const auto floor = findFloor(views, up);
    tellOfFloor(floor);
    const SE3& T_first = kept.keyframes.front().T_world_cam;
    return uprightFrame(up, floor ? floor->height_m : up.dot(T_first.t), T_first);
}

std::vector<SurfaceView> GravityAligner::surfacesInWorld(const MapInputs& inputs) const {
    std::vector<SurfaceView> all;
    for (const SurveyedKeyframe& keyframe : keyframes_) {
        const int number = static_cast<int>(keyframe.number);
        if (std::binary_search(inputs.disconnected.begin(), inputs.disconnected.end(), number))
            continue;
        const SE3 T_world_cam =
            depthPose(inputs.keyframes[keyframe.number], keyframe.depth_stamp_s, inputs.trajectory);
        std::vector<SurfacePatch>& patches = all.emplace_back().patches;
        all.back().eye = T_world_cam.t;
        for (const SurfacePatch& patch : keyframe.patches) {
            patches.push_back({T_world_cam * patch.position, T_world_cam.R * patch.normal});
        }
    }
    return all;
}

std::vector<SpecificForce> GravityAligner::forcesInCamera(const SE3& T_base_cam) const {
    std::vector<SpecificForce> forces;
    for (const auto& [stamp_s, force] : forces_) {
        const Eigen::Vector3d in_base = T_base_accelerometer_.R * force;
        forces.push_back({stamp_s, T_base_cam.R.transpose() * in_base});
    }
    return forces;
}

void GravityAligner::leaveOut(const SensorVerdict& verdict, const SE3& T_base_cam) const {
    const SE3 T_base_sensor = T_base_cam * T_optical_from_mrpt;
    sayWarning(wrongSensorText("accelerometer", *accelerometer_, verdict,
                               imuRemedy(verdict, {T_base_sensor, T_base_accelerometer_}, false)));
}

/** \return nothing when the accelerometer is of no use */
std::optional<Eigen::Vector3d> GravityAligner::upByAccelerometer(
    const Trajectory& poses, const std::vector<SurfacePatch>& patches,
    const SE3& T_base_cam) const {
    if (!accelerometer_) return std::nullopt;
    SensorVerdict verdict = checkAccelerometer(
        forces_, movedAlong(stretchesOf(poses), T_base_cam.inverse() * T_base_accelerometer_));
    const auto up = upFromAccelerometer(forcesInCamera(T_base_cam), poses);
    const bool upside_down = up && up->dot(meanCameraTop(poses)) < -std::cos(camera_error);
    if (upside_down && verdict.fault == SensorFault::Undecided && seenFromAbove(patches, -*up)) {
        verdict.fault = SensorFault::Sign;
        verdict.axes = -Eigen::Matrix3d::Identity();
        verdict.finding = "by it the camera is upside down, and so are floor and tables: negated?";
    }
    if (up && !upside_down)
        doubtLying(patches, *up, meanCameraTop(poses), *accelerometer_, verdict);
    if (verdict.wrong()) {
        leaveOut(verdict, T_base_cam);
        return std::nullopt;
    }
    if (upside_down && verdict.fault == SensorFault::Undecided) {
        sayWarning("accelerometer '" + *accelerometer_ +
                   "': by it the camera is upside down, which the motion neither shows nor rules "
                   "out; if it was not, import with --imu-accel-unit=-1");
    }
    return up;
}

/** A Kinect's accelerometer is some 4 degrees off (TUM fr1/xyz against its ground truth), a floor
 *  well below one: so gravity says which surfaces are level, and these say what level is. */
Eigen::Vector3d GravityAligner::findUp(const MapInputs& kept,
                                       const std::vector<SurfacePatch>& patches,
                                       const SE3& T_base_cam) const {
    constexpr double accelerometer_error = 8 * M_PI / 180;
    const Trajectory& poses = kept.trajectory.empty() ? kept.keyframes : kept.trajectory;
    if (options_.upright == "gravity") {
        if (const auto up = upByAccelerometer(poses, patches, T_base_cam)) {
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

SE3 T_gravity_world(const MapInputs& inputs, const MapOptions& options) {
    checkInputs(inputs);
    GravityAligner survey(options);
    SE3 T_base_cam;
    const std::size_t step = stepFor(inputs.keyframes.size());
    Trajectory some;
    for (std::size_t k = 0; k < inputs.keyframes.size(); k += step) {
        some.push_back(inputs.keyframes[k]);
    }
    const RecordedImages images({inputs.rawlog, inputs.sensor_label, inputs.entries});
    images.forEach(
        some, "finding the floor",
        [&](const Keyframe3D& keyframe) {
            T_base_cam = keyframe.T_base_cam;
            survey.addKeyframe(step * keyframe.index, keyframe.image, keyframe.camera);
        },
        [&](const mrpt::obs::CObservation& observation) { survey.note(observation); });
    return survey.T_gravity_world(inputs, T_base_cam);
}

}  // namespace rgbd_graphslam
