/** Rawlog to TUM folder. */
#pragma once
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** What to export. */
struct ExportOptions {
    /** Only what was recorded within these bounds, in s after the first RGB-D frame; frames
     *  count by their color stamp. */
    double from_s = -std::numeric_limits<double>::infinity();
    double to_s = std::numeric_limits<double>::infinity();
    /** Every n-th frame of that time. */
    int every = 1;
    /** Only the camera with this sensor label; empty: all. */
    std::string sensor_label;
    /** Frames per second, for cameras whose frames have no timestamps: frame i counts as taken at
     *  i / rate_hz. */
    double rate_hz = 30;
    /** Threads that encode images. */
    int threads = 2;
};

/** What was written for one camera. */
struct ExportReport {
    std::size_t frames = 0, imu = 0, odometry = 0, truth = 0;
    /** The camera's sensor label, and its folder below that of the export; empty when it is the
     *  only one. */
    std::string camera, subfolder;
    /** What was left out or made up, a line each. */
    std::vector<std::string> notes;
};

/** Writes rgb/ and depth/ (PNG, or the original file where the rawlog refers to one), rgb.txt,
 *  depth.txt, camera.ini, and where the rawlog has them groundtruth.txt, accelerometer.txt,
 *  gyroscope.txt and odometry.txt. Importing the folder again gives the same pixels, depth, stamps
 *  and readings. The lists are written last: a folder without rgb.txt is an unfinished export. A
 * rawlog of several cameras becomes a sequence for each, in a subfolder named by its sensor label;
 * motion sensors and ground truth go to each. \param folder is made; must be empty if it exists
 *  \throws Error when the rawlog has no frame in the bounds, is damaged, its images differ in size,
 * or `folder` cannot be used */
std::vector<ExportReport> exportTumSequence(const std::string& rawlog_path,
                                            const std::string& folder,
                                            const ExportOptions& options);

}  // namespace rgbd_graphslam
