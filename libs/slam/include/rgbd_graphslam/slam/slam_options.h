/** Settings of tracking, mapping and loop closing. */
#pragma once
#include <vector>

#include "rgbd_graphslam/core/options.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/features/feature_options.h"
#include "rgbd_graphslam/geometry/depth_noise.h"

namespace rgbd_graphslam {

/** Section `[SensorOptions]`. */
struct SensorOptions : Options {
    double keypoint_sigma_px = 0.8;
    double aligned_sigma_px = 0.4;
    /** Larger close by than the sensor's own noise: registration and color and depth taken at
     *  different moments displace depth too (doc/design-decisions.md). */
    DepthNoise depth_noise{0.005, 0.0019, 0.4};
    double disparity_sigma_px = 0.25;
    /** Depth times disparity (m px) of each stereo camera, 0 of other cameras, by its number in the
     *  rig; the rig tells, not a setting. */
    std::vector<double> disparity_m_px;

    /** Standard deviation (1/m) of the inverse of a depth that a camera has measured. */
    double inverseDepthSigma(double depth_m, int camera) const;

    const char* section() const override { return "SensorOptions"; }
    const char* about() const override { return "Sensor noise model"; }
    void describe(OptionVisitor& v) override;
};

/** Section `[TrackerOptions]`. */
struct TrackerOptions : Options {
    double motion_window_px = 15;
    double wide_window_px = 40;
    double map_window_px = 5;
    int max_hamming = 64;
    int min_inliers = 25;
    int max_local_keyframes = 20;
    bool align_keypoints = true;
    bool detect_standstill = true;
    bool mask_moving = false;

    const char* section() const override { return "TrackerOptions"; }
    const char* about() const override { return "Tracking of every frame against the local map"; }
    void describe(OptionVisitor& v) override;
};

/** Section `[KeyframeOptions]`. */
struct KeyframeOptions : Options {
    double max_translation_ratio = 0.10;
    double max_rotation_rad = 0.20;
    double min_tracked_share = 0.75;
    double min_translation_ratio = 0.015;
    double min_rotation_rad = 0.03;
    int min_interval_frames = 2;
    double cull_share = 0.9;

    const char* section() const override { return "KeyframeOptions"; }
    const char* about() const override { return "Keyframe insertion and culling"; }
    void describe(OptionVisitor& v) override;
};

/** Section `[MapperOptions]`. */
struct MapperOptions : Options {
    int window_keyframes = 10;
    int max_fixed_keyframes = 10;
    int iterations = 6;
    int adjustment_delay_frames = 3;
    int loop_iterations = 5;
    int loop_adjustment_delay_frames = 60;
    int localization_keyframes = 300;
    bool triangulate = true;
    bool local_adjustment = true;
    bool loop_adjustment = true;
    bool final_adjustment = true;

    const char* section() const override { return "MapperOptions"; }
    const char* about() const override { return "Local mapping and bundle adjustment"; }
    void describe(OptionVisitor& v) override;
};

/** Section `[LoopOptions]`. */
struct LoopOptions : Options {
    bool enabled = true;
    int min_keyframe_gap = 20;
    int candidates = 3;
    int min_inliers = 40;
    int ransac_iterations = 300;
    int bits_hamming = 40;
    double max_drift_share = 0.02;

    const char* section() const override { return "LoopOptions"; }
    const char* about() const override { return "Loop closure"; }
    void describe(OptionVisitor& v) override;
};

/** Section `[RecoveryOptions]`. */
struct RecoveryOptions : Options {
    bool dead_reckoning = true;
    int dead_reckoned_keyframe_after = 5;
    int new_submap_after = 20;
    int fewest_keypoints = 100;

    const char* section() const override { return "RecoveryOptions"; }
    const char* about() const override { return "Recovery when the map is not seen"; }
    void describe(OptionVisitor& v) override;
};

/** Section `[MotionOptions]`. */
struct MotionOptions : Options {
    bool use_imu = true;
    bool use_wheels = true;
    double gravity_m_s2 = 9.81;
    double imu_time_offset_s = 0;
    double least_gyro_noise = 1e-4;
    double least_accelerometer_noise = 2e-3;
    double gyro_walk = 3e-5;
    double accelerometer_walk = 6e-4;

    const char* section() const override { return "MotionOptions"; }
    const char* about() const override { return "Inertial sensors and wheels"; }
    void describe(OptionVisitor& v) override;
};

/** Everything VisualSlam can be told. */
struct SlamOptions {
    FeatureOptions features;
    SensorOptions sensor;
    TrackerOptions tracker;
    KeyframeOptions keyframes;
    MapperOptions mapper;
    LoopOptions loops;
    RecoveryOptions recovery;
    MotionOptions motion;
    PoseGraphOptions pose_graph;

    /** For IniFile::load and toIniText. */
    std::vector<Options*> all() {
        return {&features, &sensor,   &tracker, &keyframes, &mapper,
                &loops,    &recovery, &motion,  &pose_graph};
    }
};

}  // namespace rgbd_graphslam
