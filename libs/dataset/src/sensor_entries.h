/** Rawlog entries other than frames. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {

/** In order of time. */
using SensorEntries = std::vector<mrpt::obs::CObservation::Ptr>;

/** Ground truth, IMU and odometry of a sequence; counted in `report`. */
SensorEntries sensorEntries(const RgbdSequence& sequence, const CameraSetup& setup,
                            ImportReport& report);

/** Writes such entries between the images of an import. */
class SensorFeed {
  public:
    explicit SensorFeed(SensorEntries entries) : entries_(std::move(entries)) {}

    /** The earlier of the first entry and the first image. */
    mrpt::Clock::time_point firstTime(mrpt::Clock::time_point first_image) const {
        return entries_.empty() ? first_image : std::min(first_image, entries_.front()->timestamp);
    }
    void writeUntil(mrpt::Clock::time_point time, RawlogWriter& writer) {
        for (; next_ < entries_.size() && entries_[next_]->timestamp <= time; ++next_) {
            writer.write(*entries_[next_]);
        }
    }
    void writeRest(RawlogWriter& writer) { writeUntil(mrpt::Clock::time_point::max(), writer); }

  private:
    SensorEntries entries_;
    std::size_t next_ = 0;
};

}  // namespace rgbd_graphslam
