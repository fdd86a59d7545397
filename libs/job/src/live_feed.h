/** Lets a viewer look on while SLAM runs. */
#pragma once
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "rgbd_graphslam/graphslam/graph_slam_session.h"
#include "rgbd_graphslam/input/frame_stream.h"
#include "rgbd_graphslam/live/live_messages.h"
#include "rgbd_graphslam/live/live_socket.h"

namespace rgbd_graphslam {

/** Copies what a viewer shows: keyframes for its map, and a picture of the present frame whenever
 * it has asked for one. SLAM does not depend on any of it. */
class LiveFeed {
  public:
    /** \param folder of the run, which gets the socket; where it cannot be made nobody looks on */
    explicit LiveFeed(const std::string& folder);

    /** After each frame. \param frame_ms wall time that tracking it took */
    void note(const StreamedFrame& frame, const TrackedFrame& tracked, double frame_ms,
              const GraphSlamSession& session);

  private:
    using Clock = std::chrono::steady_clock;

    void addStatistic(const TrackedFrame& tracked, double frame_ms);
    void sendPicture(const StreamedFrame& frame, const TrackedFrame& tracked,
                     const GraphSlamSession& session);
    void send(const StreamedFrame& frame, LiveFrame message);
    void sendMap(const GraphSlamSession& session);

    std::unique_ptr<LiveServer> server_;
    std::vector<LiveStatistic> statistics_;  // not yet sent
    Clock::time_point next_picture_, next_keyframe_, next_map_;
};

}  // namespace rgbd_graphslam
