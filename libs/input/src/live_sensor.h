/** What a live source knows of one sensor. */
#pragma once
#include <optional>

#include "rgbd_graphslam/input/live_options.h"
#include "rgbd_graphslam/input/live_statistics.h"

namespace rgbd_graphslam {

/** Its rate, what is expected of it, and whether it is silent. Times in s of one monotonic clock;
 *  stamps are corrected ones. */
class LiveSensor {
  public:
    LiveSensor(const std::string& label, const std::string& class_name, bool of_camera)
        : is_camera(of_camera) {
        statistics.label = label;
        statistics.class_name = class_name;
    }

    /** A measurement came. \return for how long it had been reported silent */
    std::optional<double> note(double stamp_s, double arrival_s);

    /** Whether a measurement up to a stamp should have come by now or is about to. */
    bool owes(double stamp_s, double now_s) const;

    /** \return for how long, when it is to be reported now */
    std::optional<double> newlySilent(double now_s, const LiveOptions& options);

    LiveSensorStatistics statistics;
    const bool is_camera;
    std::optional<double> handed_out_stamp_s;

  private:
    /** Smoothed over some ten measurements; 0 before the second. */
    double period_s_ = 0;
    double stamp_s_ = 0, arrival_s_ = 0;
    bool silent_ = false;
};

}  // namespace rgbd_graphslam
