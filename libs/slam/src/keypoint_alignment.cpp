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
    ReferenceViews(const SE3& T_cam_world, const RigCameras& cameras, const SlamMap& map)
        : T_cam_world_(T_cam_world), cameras_(cameras), map_(map) {}

    /** Of a landmark's patch to the frame, where a keypoint shows it. */
    PatchMotion motionOf(const Landmark& landmark, const Keypoint& keypoint) {
        const LandmarkPatch& reference = *landmark.patch;
        const View& view = viewFrom(landmark.first_keyframe, reference.camera, keypoint.camera);
        const double reference_px =
            (view.T_reference_world * landmark.position).z() * map_.scaleOf(reference.octave);
        const double frame_px =
            (view.T_frame_world * landmark.position).z() * map_.scaleOf(keypoint.octave);
        const double scale = frame_px / reference_px * view.focal_ratio;
        return {static_cast<float>(scale), view.roll_rad};
    }

  private:
    /** One camera of the keyframe and one of the frame. */
    struct View {
        SE3 T_reference_world, T_frame_world;
        double focal_ratio = 1;
        float roll_rad = 0;
    };

    const View& viewFrom(int keyframe, int reference, int seen_by) {
        const int key = (keyframe * cameras_.count() + reference) * cameras_.count() + seen_by;
        const auto [place, is_new] = views_.try_emplace(key);
        View& view = place->second;
        if (is_new) {
            view.T_reference_world = cameras_[reference].fromBody(map_.T_cam_world(keyframe));
            view.T_frame_world = cameras_[seen_by].fromBody(T_cam_world_);
            view.focal_ratio = cameras_[reference].camera().pixelsPerRadian().x() /
                               cameras_[seen_by].camera().pixelsPerRadian().x();
            view.roll_rad = rollOf(view.T_frame_world.R * view.T_reference_world.R.transpose());
        }
        return view;
    }

    const SE3& T_cam_world_;
    const RigCameras& cameras_;
    const SlamMap& map_;
    std::unordered_map<int, View> views_;
};

/** \param shift as the sensor sees it, full-size px */
void move(Keypoint& keypoint, const cv::Point2f& shift, const CameraModel& camera) {
    Eigen::Vector2d place(keypoint.u, keypoint.v);
    const Eigen::Vector2d step(shift.x, shift.y);
    if (camera.hasDistortion()) {
        place = camera.rectify(camera.unrectify(place) + step);
    } else {
        place += step;
    }
    keypoint.u = static_cast<float>(place.x());
    keypoint.v = static_cast<float>(place.y());
}

}  // namespace

void alignKeypoints(Frame& frame, const std::vector<int>& landmarks, const SE3& T_cam_world,
                    const RigCameras& cameras, const SlamMap& map) {
    if (frame.patches.empty()) return;
    ReferenceViews views(T_cam_world, cameras, map);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        Keypoint& keypoint = frame.keypoints[i];
        keypoint.aligned = false;
        if (landmarks[i] == no_landmark) continue;
        const Landmark& landmark = map.landmark(landmarks[i]);
        if (!landmark.patch) continue;
        const PatchMotion motion = views.motionOf(landmark, keypoint);
        const auto offset = alignPatch(landmark.patch->patch, motion, frame.patches[i]);
        if (!offset) continue;
        move(keypoint, *offset * static_cast<float>(map.scaleOf(keypoint.octave)),
             cameras.sensor(keypoint.camera));
        frame.patches[i].corner += *offset;
        keypoint.aligned = true;
    }
    frame.grid = cameras.gridOf(frame.keypoints);
}

}  // namespace rgbd_graphslam
