/** What a replayed rawlog is told. */
#pragma once
#include <mrpt/config/CConfigFileBase.h>

#include <cstdint>
#include <limits>
#include <set>
#include <string>

namespace rgbd_graphslam {

/** The keys of CRawlogReplaySensor. */
struct ReplaySettings {
    static constexpr double never = std::numeric_limits<double>::infinity();

    std::string rawlog;
    std::set<std::string> labels;  // empty = all
    double speed = 1;
    std::size_t repeat = 1;
    bool stamped_now = false;
    double jitter_s = 0, loss = 0, reorder = 0, reorder_s = 0.05;
    std::uint64_t seed = 1;
    double silent_at_s = never, silent_s = 0;
    double unplug_every_s = never, unplugged_s = 1;
    double clock_jump_at_s = never, clock_jump_s = 0;

    /** Whether it sends nothing at a time of the replay. */
    bool silent(double time_s) const;
    bool unplugged(double time_s) const;
};

/** \throws Error naming the key that is unknown, missing or whose value makes no sense */
ReplaySettings replaySettings(const mrpt::config::CConfigFileBase& config,
                              const std::string& section);

}  // namespace rgbd_graphslam
