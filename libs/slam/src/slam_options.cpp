#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

void SensorOptions::describe(OptionVisitor& v) {
    v.real("keypoint_sigma_px", keypoint_sigma_px, 0.05, 10, "px",
           "Standard deviation of a keypoint on pyramid level 0");
    v.real("aligned_sigma_px", aligned_sigma_px, 0.05, 10, "px",
           "Standard deviation of a keypoint aligned to its landmark's patch");
    v.real("depth_sigma_a", depth_noise.a, 0, 1, "m",
           "Depth standard deviation a + b (z - c)^2: constant term");
    v.real("depth_sigma_b", depth_noise.b, 0, 1, "1/m", "Depth standard deviation: quadratic term");
    v.real("depth_sigma_c", depth_noise.c, 0, 10, "m",
           "Depth standard deviation: distance of smallest error");
    v.real("disparity_sigma_px", disparity_sigma_px, 0.01, 10, "px",
           "Standard deviation of a disparity of a stereo camera, which has no depth_sigma_*");
}

double SensorOptions::inverseDepthSigma(double depth_m, int camera) const {
    const auto i = static_cast<std::size_t>(camera);
    if (i < disparity_m_px.size() && disparity_m_px[i] > 0) {
        return disparity_sigma_px / disparity_m_px[i];
    }
    return depth_noise.sigma(depth_m) / (depth_m * depth_m);
}

void TrackerOptions::describe(OptionVisitor& v) {
    v.real("motion_window_px", motion_window_px, 1, 200, "px",
           "Search radius around the position predicted by the motion model");
    v.real("wide_window_px", wide_window_px, 1, 400, "px",
           "Search radius of the second attempt, before tracking fails");
    v.real("map_window_px", map_window_px, 1, 100, "px",
           "Search radius for local map landmarks after the first pose estimate");
    v.integer("max_hamming", max_hamming, 1, 256, "bits", "Maximum descriptor distance of a match");
    v.integer("min_inliers", min_inliers, 6, 1000, "landmarks", "Minimum inliers to accept a pose");
    v.integer("max_local_keyframes", max_local_keyframes, 1, 200, "",
              "Number of keyframes in the local map");
    v.flag("align_keypoints", align_keypoints,
           "Refine matched keypoints by aligning the landmark's image patch");
    v.flag("detect_standstill", detect_standstill,
           "Keep the pose of a keyframe while the image shows that the camera has not moved since");
    v.flag("mask_moving", mask_moving,
           "Ignore keypoints on moving objects: surfaces where earlier frames saw free space");
}

void KeyframeOptions::describe(OptionVisitor& v) {
    v.real("max_translation_ratio", max_translation_ratio, 0.001, 10, "",
           "Insert a keyframe beyond this translation from all keyframes of the view, relative to "
           "the median depth");
    v.real("max_rotation_rad", max_rotation_rad, 0.001, 3.2, "rad",
           "Insert a keyframe beyond this rotation from all keyframes of the view");
    v.real("min_tracked_share", min_tracked_share, 0.01, 1, "",
           "Insert a keyframe when fewer than this share of the nearest keyframe's landmarks are "
           "tracked");
    v.real("min_translation_ratio", min_translation_ratio, 0, 10, "",
           "Minimum translation between keyframes, relative to the median depth");
    v.real("min_rotation_rad", min_rotation_rad, 0, 3.2, "rad",
           "Minimum rotation between keyframes, unless the minimum translation is reached");
    v.integer("min_interval_frames", min_interval_frames, 1, 1000, "frames",
              "Minimum number of frames between keyframes");
    v.real("cull_share", cull_share, 0.1, 1.01, "",
           "Cull keyframes with this share of landmarks seen by three others (above 1 = never)");
}

void MapperOptions::describe(OptionVisitor& v) {
    v.integer("window_keyframes", window_keyframes, 1, 100, "",
              "Keyframes optimized by local bundle adjustment");
    v.integer("max_fixed_keyframes", max_fixed_keyframes, 0, 100, "",
              "Fixed keyframes that anchor local bundle adjustment");
    v.integer("iterations", iterations, 1, 100, "", "Iterations of local bundle adjustment");
    v.renamed("hand_over_frames", "adjustment_delay_frames");
    v.integer(
        "adjustment_delay_frames", adjustment_delay_frames, 1, 100, "frames",
        "Frames after a keyframe at which the adjusted map is applied (fixed, so that results do "
        "not depend on timing)");
    v.integer("loop_iterations", loop_iterations, 1, 100, "",
              "Iterations of global bundle adjustment after a loop");
    v.renamed("loop_hand_over_frames", "loop_adjustment_delay_frames");
    v.integer("loop_adjustment_delay_frames", loop_adjustment_delay_frames, 1, 10000, "frames",
              "Frames after a loop at which the globally adjusted map is applied");
    v.renamed("localising_keyframes", "localization_keyframes");
    v.integer("localization_keyframes", localization_keyframes, 2, 1000000, "keyframes",
              "Temporary keyframes a --localize run keeps; older ones are discarded");
    v.flag("triangulate", triangulate, "Triangulate landmarks without depth from two views");
    v.flag("local_adjustment", local_adjustment,
           "Run local bundle adjustment at each new keyframe");
    v.flag("loop_adjustment", loop_adjustment,
           "Run global bundle adjustment in the background after a loop");
    v.flag("final_adjustment", final_adjustment, "Run global bundle adjustment at the end");
}

void LoopOptions::describe(OptionVisitor& v) {
    v.flag("enabled", enabled, "Detect and close loops");
    v.integer("min_keyframe_gap", min_keyframe_gap, 2, 10000, "keyframes",
              "Minimum keyframe distance in time for a loop candidate");
    v.integer("candidates", candidates, 1, 50, "", "Loop candidates verified per keyframe");
    v.integer("min_inliers", min_inliers, 6, 1000, "landmarks", "Minimum inliers to accept a loop");
    v.integer("ransac_iterations", ransac_iterations, 10, 100000, "",
              "Maximum RANSAC iterations of loop verification");
    v.integer("bits_hamming", bits_hamming, 1, 128, "bits",
              "Maximum descriptor distance in place recognition");
    v.real(
        "max_drift_share", max_drift_share, 0, 1, "m/m",
        "Largest drift (m per m travelled) a loop may correct; loops implying more are rejected as "
        "perceptual aliasing");
}

void RecoveryOptions::describe(OptionVisitor& v) {
    v.renamed("weak_motion", "dead_reckoning");
    v.flag("dead_reckoning", dead_reckoning,
           "When the map is not seen, follow the camera by the last frame, dense alignment, "
           "odometry or gyroscope");
    v.renamed("weak_keyframe_after", "dead_reckoned_keyframe_after");
    v.integer("dead_reckoned_keyframe_after", dead_reckoned_keyframe_after, 1, 10000, "frames",
              "Consecutive dead-reckoned frames after which a keyframe is inserted anyway");
    v.renamed("new_part_after", "new_submap_after");
    v.integer("new_submap_after", new_submap_after, 1, 10000, "frames",
              "Consecutive lost frames after which a new submap is started");
    v.integer("fewest_keypoints", fewest_keypoints, 50, 10000, "keypoints",
              "Minimum keypoints with depth to insert such a keyframe or start a submap");
}

void MotionOptions::describe(OptionVisitor& v) {
    v.flag("use_imu", use_imu,
           "Estimate velocity, biases and gravity from the IMU, predict frames by it and cross "
           "stretches without vision");
    v.flag("use_wheels", use_wheels, "Let wheel odometry support the IMU in such stretches");
    v.real("gravity_m_s2", gravity_m_s2, 9.7, 9.9, "m/s^2", "Strength of gravity");
    v.real("imu_time_offset_s", imu_time_offset_s, -1, 1, "s",
           "Added to the stamps of the IMU");
    v.real("least_gyro_noise", least_gyro_noise, 1e-6, 1, "rad/s/sqrt(Hz)",
           "Smallest density of the gyroscope's noise, which is measured from its readings");
    v.real("least_accelerometer_noise", least_accelerometer_noise, 1e-5, 10, "m/s^2/sqrt(Hz)",
           "The same of the accelerometer");
    v.real("gyro_walk", gyro_walk, 1e-9, 1, "rad/s^2/sqrt(Hz)",
           "Random walk of the gyroscope's bias");
    v.real("accelerometer_walk", accelerometer_walk, 1e-8, 10, "m/s^3/sqrt(Hz)",
           "Random walk of the accelerometer's bias");
}

}  // namespace rgbd_graphslam
