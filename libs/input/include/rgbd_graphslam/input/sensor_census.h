/** Which sensors a recording has, and what becomes of each. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Of MRPT, without its namespace. */
std::string classNameOf(const mrpt::obs::CObservation& observation);

/** The observations of one class with one label. */
struct SensorRecord {
    std::string label, class_name;
    std::size_t count = 0;
    bool used = false;

    /** Whether its images are tracked: an RGB-D or stereo camera. */
    bool isCamera() const {
        return class_name == "CObservation3DRangeScan" || class_name == "CObservationStereoImages";
    }
};

/** Counts the observations of each sensor. */
class SensorCensus {
  public:
    /** \param used whether anything reads this observation */
    void note(const mrpt::obs::CObservation& observation, bool used);
    /** Marks a sensor as not used after all. */
    void leaveOut(const std::string& label);
    /** In the order in which they first came. */
    const std::vector<SensorRecord>& sensors() const { return sensors_; }

  private:
    std::vector<SensorRecord> sensors_;
};

/** "'FRONT' (CObservation3DRangeScan, 300), 'LASER' (CObservation2DRangeScan, 120)" of those that
 *  are used, or of those that are not, comments apart; "none" where there are none. */
std::string sensorsText(const std::vector<SensorRecord>& sensors, bool used);

/** "'FRONT' (300 frames, used) and 'REAR' (299 frames)"; empty with fewer than two cameras.
 */
std::string severalCamerasText(const std::vector<SensorRecord>& sensors);

}  // namespace rgbd_graphslam
