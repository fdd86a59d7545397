/** What happened to the measurements of live sensors. */
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** One sensor of a live run. */
struct LiveSensorStatistics {
    std::string label, class_name;
    std::size_t received = 0;
    /** Frames given up because tracking was behind. */
    std::size_t dropped = 0;
    /** Measurements that came after a later one of the same sensor, or too late for any frame. */
    std::size_t late = 0;
    /** How often it sent nothing for longer than LiveOptions::silence_s, and for how long at most.
     */
    std::size_t silences = 0;
    double longest_silence_s = 0;
    /** Of its stamps against the computer's monotonic clock. */
    std::size_t clock_jumps = 0;
};

/** A live run so far. */
struct LiveStatistics {
    /** In the order in which they first sent something. */
    std::vector<LiveSensorStatistics> sensors;
    /** Of each image, from its arrival to its pose. Frames that arrived before tracking had caught
     *  up with them are not among them. */
    std::vector<double> latencies_ms;
    /** The same to the end of all that the frame set off, such as a search for loops. */
    std::vector<double> completions_ms;
    std::size_t starting_frames = 0;
    /** Failures of drivers, such as a sensor that is unplugged. */
    std::size_t failures = 0;

    std::size_t dropped() const;
    std::size_t late() const;
};

}  // namespace rgbd_graphslam
