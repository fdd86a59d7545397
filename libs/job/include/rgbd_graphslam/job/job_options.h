/** Every setting of rgbd-slam. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/fusion/gps_options.h"
#include "rgbd_graphslam/input/live_options.h"
#include "rgbd_graphslam/job/run_options.h"
#include "rgbd_graphslam/laser/laser_options.h"
#include "rgbd_graphslam/mapping/map_options.h"
#include "rgbd_graphslam/semantics/semantic_options.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {

/** The options of a run, its SLAM and its maps; those of the laser for runs without a camera. */
struct JobOptions {
    RunOptions run;
    SlamOptions slam;
    MapOptions maps;
    LaserOptions laser;
    GpsOptions gps;
    LiveOptions live;
    SemanticOptions semantics;

    /** For IniFile::load and toIniText. */
    std::vector<Options*> all();
};

/** The present settings as a commented ini file. */
std::string configText(JobOptions options);

/** Sixteen hexadecimal digits that differ where the settings do (FNV-1a of their text). */
std::string configHash(const JobOptions& options);

}  // namespace rgbd_graphslam
