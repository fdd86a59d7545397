#include "keypoint_alignment.h"

#include <cmath>
#include <unordered_map>

#include "rgbd_graphslam/estimation/reprojection.h"

namespace rgbd_graphslam {
namespace {

/** About the optical axis, of images of one camera in two poses. */
float rollOf(const Eigen::Matrix3d& R) {
    return static_cast<float>(std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1)));
}

/** Keyframes that first saw landmarks, as one frame relates to them. */
class ReferenceViews {
  public:
    ReferenceViews(const SE3& T_cam_world, const SlamMap& map)
        : T_cam_world_(T_cam_world), map_(map) {}

    /** Of a landmark's patch to the frame, where it is seen on pyramid level `octave`. */
    PatchMotion motionOf(const Landmark& landmark, int octave) {
        const View& view = viewFrom(landmark.first_keyframe);
        const double reference_px =
            (view.T_cam_world * landmark.position).z() * map_.scaleOf(landmark.patch->octave);
        const double frame_px = (T_cam_world_ * landmark.position).z() * map_.scaleOf(octave);
        return {static_cast<float>(frame_px / reference_px), view.roll_rad};
    }

  private:
    struct View {
        SE3 T_cam_world;
        float roll_rad = 0;
    };

    const View& viewFrom(int keyframe) {
        const auto [place, is_new] = views_.try_emplace(keyframe);
        if (is_new) {
            const SE3 pose = map_.T_cam_world(keyframe);
            place->second = {pose, rollOf(T_cam_world_.R * pose.R.transpose())};
        }
        return place->second;
    }

    const SE3& T_cam_world_;
    const SlamMap& map_;
    std::unordered_map<int, View> views_;
};

/** \param shift as the sensor sees it, full-size px */
void move(Keypoint& keypoint, const cv::Point2f& shift, const Camera& camera) {
    Eigen::Vector2d place(keypoint.u, keypoint.v);
    const Eigen::Vector2d step(shift.x, shift.y);
    if (camera.hasDistortion()) {
        place = camera.undistort(camera.distort(place) + step);
    } else {
        place += step;
    }
    keypoint.u = static_cast<float>(place.x());
    keypoint.v = static_cast<float>(place.y());
}

}  // namespace

void alignKeypoints(Frame& frame, const std::vector<int>& landmarks, const SE3& T_cam_world,
                    const Camera& camera, const SlamMap& map) {
    if (frame.patches.empty()) return;
    ReferenceViews views(T_cam_world, map);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        Keypoint& keypoint = frame.keypoints[i];
        keypoint.aligned = false;
        if (landmarks[i] == no_landmark) continue;
        const Landmark& landmark = map.landmark(landmarks[i]);
        if (!landmark.patch) continue;
        const PatchMotion motion = views.motionOf(landmark, keypoint.octave);
        const auto offset = alignPatch(landmark.patch->patch, motion, frame.patches[i]);
        if (!offset) continue;
        move(keypoint, *offset * static_cast<float>(map.scaleOf(keypoint.octave)), camera);
        frame.patches[i].corner += *offset;
        keypoint.aligned = true;
    }
    frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
}

}  // namespace rgbd_graphslam
