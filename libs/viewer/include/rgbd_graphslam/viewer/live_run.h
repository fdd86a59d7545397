/** A run that is still going on, put together from its messages. */
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rgbd_graphslam/live/live_messages.h"
#include "rgbd_graphslam/live/live_socket.h"
#include "rgbd_graphslam/viewer/run_data.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Follows the run that writes to a folder; waits for it while there is none. */
class LiveRun {
  public:
    /** \param since a result that the folder holds from before is that of another run */
    explicit LiveRun(std::string folder, std::filesystem::file_time_type since =
                                             std::filesystem::file_time_type::clock::now())
        : folder_(std::move(folder)), since_(since) {}

    enum class State { Waiting, Running, Ended };
    /** Takes in what has arrived; never waits. \return whether a picture has come, or the end */
    bool update();
    /** Asks for the next picture, unless one is still to come. */
    void askForPicture();
    State state() const { return state_; }
    /** Whether the run has written its result. */
    bool hasResult() const;

    /** Poses, loops and frames so far; no maps. */
    const RunData& run() const { return run_; }
    /** How often everything may have moved; in between only the trajectory grows. */
    std::size_t revisions() const { return revisions_; }
    /** The last picture. */
    const std::optional<LiveFrame>& lastFrame() const { return frame_; }
    const std::vector<LiveStatistic>& statistics() const { return statistics_; }

    /** Clouds that are new or whose keyframe has moved since the last call, in the world. */
    std::vector<std::pair<std::size_t, Vertices>> takeMovedClouds();

    /** For tests: as if the message had come through the socket. */
    void take(const LiveMessage& message);

  private:
    void takeFrame(const LiveFrame& frame);
    void takeMap(const LiveMap& map);

    struct Cloud {
        Vertices points_cam;
        SE3 T_world_cam;  // as known last
        SE3 T_world_shown;
        bool shown = false;
    };

    std::string folder_;
    std::filesystem::file_time_type since_;
    LiveClient client_;
    bool asked_ = false, picture_is_new_ = false;
    State state_ = State::Waiting;
    RunData run_;
    std::size_t revisions_ = 0;
    std::optional<LiveFrame> frame_;
    std::vector<LiveStatistic> statistics_;
    std::vector<std::optional<Cloud>> clouds_;  // one per keyframe
};

}  // namespace rgbd_graphslam
