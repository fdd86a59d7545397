/** The frames of a rawlog, tracked one after the other. */
#pragma once
#include <optional>

#include "checkpoint.h"
#include "interruption.h"
#include "live_feed.h"
#include "run_state.h"

namespace rgbd_graphslam {

/** Goes on until the rawlog ends or is damaged, a limit is reached or somebody interrupts, and lets
 *  a viewer look on. */
class TrackingLoop {
  public:
    /** \param run must outlive it */
    explicit TrackingLoop(RunState& run);
    ~TrackingLoop();

    /** \param checkpoints gets one whenever it is due */
    void track(CheckpointWriter& checkpoints);
    bool interrupted() const { return interruption_.requested(); }

  private:
    void trackOne(StreamedFrame& frame);
    bool takesItsTurn(const StreamedFrame& frame);
    std::optional<StreamedFrame> nextFrame();
    bool finished() const;
    void checkLimits();
    std::string progressNote() const;

    RunState& run_;
    const StreamedFrame* tracked_ = nullptr;  // at present
    LiveFeed live_feed_;
    Interruption interruption_;
};

}  // namespace rgbd_graphslam
