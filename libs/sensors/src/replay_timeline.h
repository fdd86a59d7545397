/** When each observation of a rawlog is due. */
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "replay_settings.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"

namespace rgbd_graphslam {

/** Reads a rawlog a little ahead of the replay and applies delays and losses. Times in s since the
 *  first stamp of the rawlog. */
class ReplayTimeline {
  public:
    /** \throws Error when the rawlog cannot be read */
    explicit ReplayTimeline(const ReplaySettings& settings);

    /** Reads what is due until a time.
     *  \throws Error where the rawlog is cut off or damaged; it ends there */
    void readUntil(double time_s);

    /** The next observation that is due at a time, with its images, and the stamp of the replay;
     *  nullptr when there is none. */
    mrpt::obs::CObservation::Ptr take(double time_s);

    /** Nothing when all has been taken. */
    std::optional<double> nextDue() const;

  private:
    mrpt::obs::CObservation::Ptr read();
    void place(const mrpt::obs::CObservation::Ptr& observation);
    double random();

    const ReplaySettings settings_;
    std::unique_ptr<RawlogReader> reader_;
    std::size_t passes_left_;
    std::optional<double> first_s_;
    double last_s_ = 0, read_until_s_ = 0, pass_begins_s_ = 0;
    bool at_end_ = false;
    std::uint64_t state_;
    std::multimap<double, mrpt::obs::CObservation::Ptr> due_;
};

}  // namespace rgbd_graphslam
