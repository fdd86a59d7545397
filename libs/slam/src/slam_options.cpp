#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

void SensorOptions::describe(OptionVisitor& v) {
    v.real("keypoint_sigma_px", keypoint_sigma_px, 0.05, 10, "px",
           "Error of a keypoint's place on pyramid level 0");
    v.real("aligned_sigma_px", aligned_sigma_px, 0.05, 10, "px",
           "The same once the keypoint is aligned with the patch of its landmark");
    v.real("depth_sigma_a", depth_noise.a, 0, 1, "m", "Depth error a + b (z - c)^2: constant part");
    v.real("depth_sigma_b", depth_noise.b, 0, 1, "1/m", "Depth error: growth with distance");
    v.real("depth_sigma_c", depth_noise.c, 0, 10, "m", "Depth error: distance of least error");
}

void TrackerOptions::describe(OptionVisitor& v) {
    v.real("motion_window_px", motion_window_px, 1, 200, "px",
           "Search radius around the place predicted from the last frame");
    v.real("wide_window_px", wide_window_px, 1, 400, "px", "The same before tracking gives up");
    v.real("map_window_px", map_window_px, 1, 100, "px",
           "Search radius for local landmarks once the pose is nearly known");
    v.integer("max_hamming", max_hamming, 1, 256, "bits", "Farthest that descriptors may be apart");
    v.integer("min_inliers", min_inliers, 6, 1000, "landmarks", "Fewest that make a pose believed");
    v.integer("max_local_keyframes", max_local_keyframes, 1, 200, "",
              "Keyframes whose landmarks are searched for");
    v.flag("align_keypoints", align_keypoints,
           "Place matched keypoints by the grey values of their landmarks' patches");
}

void KeyframeOptions::describe(OptionVisitor& v) {
    v.real("max_translation_ratio", max_translation_ratio, 0.001, 10, "",
           "Motion from every keyframe of a view, as a share of the median depth, that makes one");
    v.real("max_rotation_rad", max_rotation_rad, 0.001, 3.2, "rad",
           "Rotation from every keyframe of a view that makes one");
    v.real("min_tracked_share", min_tracked_share, 0.01, 1, "",
           "Share of the landmarks tracked at the nearest keyframe below which one is made");
    v.real("min_translation_ratio", min_translation_ratio, 0, 10, "",
           "Less motion than this, as a share of the median depth, makes no keyframe");
    v.real("min_rotation_rad", min_rotation_rad, 0, 3.2, "rad",
           "Less rotation than this makes no keyframe unless the other limit is reached");
    v.integer("min_interval_frames", min_interval_frames, 1, 1000, "frames",
              "Between two keyframes at least");
    v.real("cull_share", cull_share, 0.1, 1.01, "",
           "Keyframes with this share of landmarks seen by three others go; above 1 none goes");
}

void MapperOptions::describe(OptionVisitor& v) {
    v.integer("window_keyframes", window_keyframes, 1, 100, "",
              "Keyframes that one adjustment moves");
    v.integer("max_fixed_keyframes", max_fixed_keyframes, 0, 100, "",
              "Keyframes that hold an adjustment in place");
    v.integer("iterations", iterations, 1, 100, "", "Steps of one adjustment");
    v.integer(
        "hand_over_frames", hand_over_frames, 1, 100, "frames",
        "After a keyframe, when the adjusted map reaches the tracker (fixed, so that the result "
        "does not depend on timing)");
    v.integer("loop_iterations", loop_iterations, 1, 100, "",
              "Steps of the adjustment of everything after a loop");
    v.integer("loop_hand_over_frames", loop_hand_over_frames, 1, 10000, "frames",
              "After a loop, when that one reaches the tracker");
    v.integer("localising_keyframes", localising_keyframes, 2, 1000000, "keyframes",
              "Of its own that a run with --localize keeps; older ones are forgotten");
    v.flag("triangulate", triangulate, "Landmarks from two views where no depth was read");
    v.flag("local_adjustment", local_adjustment, "Bundle adjustment around each new keyframe");
    v.flag("loop_adjustment", loop_adjustment,
           "Bundle adjustment of everything after a loop, in the background");
    v.flag("final_adjustment", final_adjustment, "Bundle adjustment of everything at the end");
}

void LoopOptions::describe(OptionVisitor& v) {
    v.flag("enabled", enabled, "Look for places seen before");
    v.integer("min_keyframe_gap", min_keyframe_gap, 2, 10000, "keyframes",
              "Nearer keyframes in time are no loop");
    v.integer("candidates", candidates, 1, 50, "", "Places verified for each keyframe");
    v.integer("min_inliers", min_inliers, 6, 1000, "landmarks", "Fewest that confirm a loop");
    v.integer("ransac_iterations", ransac_iterations, 10, 100000, "",
              "Most tries for a loop's motion");
    v.integer("bits_hamming", bits_hamming, 1, 128, "bits",
              "Farthest that place descriptors are apart");
    v.real("max_drift_share", max_drift_share, 0, 1, "m/m",
           "Drift believed possible on the way round a loop; what asks for more is another place "
           "that looks alike");
}

void RecoveryOptions::describe(OptionVisitor& v) {
    v.flag("weak_motion", weak_motion,
           "Follow the camera by the last frame, whole images, odometry or gyroscope");
    v.integer("weak_keyframe_after", weak_keyframe_after, 1, 10000, "frames",
              "Followed so, or seen without a map, before one goes on from there");
    v.integer("new_part_after", new_part_after, 1, 10000, "frames",
              "Lost with enough keypoints before a new part of the map begins");
    v.integer("fewest_keypoints", fewest_keypoints, 50, 10000, "keypoints",
              "With depth, that a frame needs to go on or begin with");
}

}  // namespace rgbd_graphslam
