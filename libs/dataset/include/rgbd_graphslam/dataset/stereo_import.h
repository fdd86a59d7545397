/** Stereo folder to rawlog. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/stereo_sequence.h"

namespace rgbd_graphslam {

/** Sensor label of the pairs that are written. */
inline constexpr const char* stereo_label = "STEREO";

/** What an import of stereo pairs found and wrote. */
struct StereoReport {
    ImageTally left, right;
    /** Pairs written, and left out because an image of theirs is damaged. */
    std::size_t pairs = 0, damaged = 0;
    std::size_t imu = 0, odometry = 0, truth = 0;
    double first_stamp_s = 0, last_stamp_s = 0, longest_gap_s = 0;
    double seconds = 0;
    std::vector<std::string> notes;
};

/** A few lines for the user. */
std::string toText(const StereoReport& report);

/** Writes pairs (stamped by the left image) as `CObservationStereoImages` with both calibrations,
 *  IMU, odometry and ground truth to a rawlog, in order of time. Gray images stay gray; 16 bits
 *  become 8. Implausible calibrations and IMUs are warned of. Shows progress.
 *  \param options those of depth are not heeded
 *  \throws Error when nothing can be paired, more than half would be lost, the images do not have
 *          the calibration's size, an image is damaged (unless skip_damaged), the calibration is
 *          doubtful and options.strict is set, or the rawlog cannot be written */
StereoReport importStereo(const StereoSequence& sequence, const std::string& rawlog_path,
                          const ImportOptions& options);

}  // namespace rgbd_graphslam
