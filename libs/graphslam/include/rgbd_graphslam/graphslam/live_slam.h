/** SLAM on a live stream: frames are pushed as they come, results are reported by callbacks. */
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "rgbd_graphslam/graphslam/graph_slam_session.h"

namespace rgbd_graphslam {

/** Called from the tracking thread, in this order for a frame; any of them may be left empty. They
 *  may read the session. While one runs, tracking waits. */
struct LiveSlamCallbacks {
    /** Every tracked frame, including lost ones. */
    std::function<void(const TrackedFrame&)> on_frame;
    /** A frame that became a keyframe. */
    std::function<void(const TrackedFrame&)> on_keyframe;
    /** A closed loop, from an earlier keyframe to the new one; the poses of past keyframes have
     *  moved. */
    std::function<void(const PoseEdge&)> on_loop;
    /** A frame that could not be used, with the reason; tracking goes on with the next. */
    std::function<void(const std::string&)> on_unusable;
};

/** Tracks pushed frames in a thread of its own:
 *  \code
 *    GraphSlamSession session(options, *first_frame);
 *    LiveSlam slam(session, callbacks);
 *    while (grab(frame)) slam.push(frame);   // from any one thread
 *    slam.finish();
 *  \endcode
 *  Between construction and finish() only the callbacks may use the session. */
class LiveSlam {
  public:
    /** \param session outlives this; it may have been started from a map */
    LiveSlam(GraphSlamSession& session, LiveSlamCallbacks callbacks);
    /** Ends tracking; frames that still wait are dropped. */
    ~LiveSlam();

    /** Never waits: where tracking is behind by more than `max_waiting` frames, the oldest waiting
     *  one is dropped, so that poses stay current.
     *  \return false when a frame was dropped for it */
    bool push(mrpt::obs::CObservation3DRangeScan::Ptr frame);

    /** Tracks the frames that wait and refines the whole map, as GraphSlamSession::finish().
     *  \throws what a callback threw; tracking ended there */
    void finish();

    /** Frames dropped so far because tracking was behind. */
    std::size_t dropped() const;

    /** A tenth of a second at 30 Hz. */
    static constexpr std::size_t max_waiting = 3;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
