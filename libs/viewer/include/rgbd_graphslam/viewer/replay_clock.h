/** The moment of a run that is shown. */
#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Stands on a moment between a run's first and last stamp, or at its end, where the whole run is
 *  shown; while it plays it goes on as fast as the run was recorded. */
class ReplayClock {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;

    /** The span of another run, at its end. */
    void reset(double first_s, double last_s);
    /** Nothing stands for the whole run, at which a replay stops. */
    void moveTo(std::optional<double> stamp_s);
    /** \param share of the span; from 1 on it is the whole run */
    void moveToShare(double share);
    /** From the beginning when the whole run is shown. */
    void play(bool play, TimePoint now);
    /** \return whether another moment is shown now */
    bool advance(TimePoint now);

    std::optional<double> now() const { return now_s_; }
    bool playing() const { return playing_; }
    /** 0 to 1. */
    double share() const;
    /** Seconds since the first stamp, and of all. */
    std::string text() const;

  private:
    double span_s() const { return last_s_ - first_s_; }

    double first_s_ = 0, last_s_ = 0;
    std::optional<double> now_s_;
    bool playing_ = false;
    TimePoint last_advance_;
};

}  // namespace rgbd_graphslam
