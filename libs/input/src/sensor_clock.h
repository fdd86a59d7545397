/** Notices when the clock behind a sensor's stamps is set. */
#pragma once
#include <map>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Compares stamps with moments of arrival. A clock that is set forward puts a stamp further ahead
 *  of its arrival than ever before, one that is set back makes stamps go back; a late arrival does
 *  neither. From then on stamps are corrected so that time goes on. Sensors that jump together are
 *  corrected alike. */
class SensorClock {
  public:
    /** Smaller steps are taken as delays. */
    static constexpr double smallest_jump_s = 0.5;

    struct Verdict {
        /** To add to the stamp. */
        double correction_s = 0;
        /** Set where the clock is found to have been set just now, by so much. */
        std::optional<double> jump_s;
        /** A lone stamp of the past, or the first one of a clock set back. */
        bool belated = false;
    };

    /** \param arrival_s by a monotonic clock */
    Verdict note(const std::string& sensor, double stamp_s, double arrival_s);

  private:
    struct Sensor {
        double stamp_s = 0, arrival_s = 0, greatest_lead_s = 0, correction_s = 0;
        bool suspected = false;
    };
    struct Jump {
        double arrival_s = 0, by_s = 0;
    };
    double common(double jump_s, double arrival_s);

    std::map<std::string, Sensor> sensors_;
    std::optional<Jump> last_;
};

}  // namespace rgbd_graphslam
