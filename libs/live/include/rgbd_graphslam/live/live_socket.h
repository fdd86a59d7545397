/** The socket in a run's folder, through which a viewer looks on. */
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rgbd_graphslam/live/file_descriptor.h"

namespace rgbd_graphslam {

/** Name of the socket in the run's folder. */
inline constexpr const char* live_socket_name = "live.socket";

/** SLAM's end. One viewer at a time; the next one waits until the first is gone. post() never
 *  blocks: what comes while the viewer is still busy with the last message is dropped, so a viewer
 *  that is slow, stopped or killed costs nothing. All work is done in a thread of its own; it has
 *  the priority of the others, which would have to wait for it should it be put off while it holds
 * a lock of the allocator. */
class LiveServer {
  public:
    /** Makes the socket; one that a killed run has left there is replaced.
     *  \throws Error when the folder allows none */
    explicit LiveServer(const std::string& folder);
    /** Removes the socket. */
    ~LiveServer();
    LiveServer(const LiveServer&) = delete;
    LiveServer& operator=(const LiveServer&) = delete;

    /** Whether somebody listens and has taken the last message. */
    bool ready() const { return ready_.load(std::memory_order_relaxed); }
    /** Whether the viewer has asked for a picture since the last pictureSent(). */
    bool pictureWanted() const { return wanted_.load(std::memory_order_relaxed); }
    void pictureSent();

    /** Sends one message, if ready() still holds.
     *  \param encode gives its bytes; runs in the server's thread, or not at all */
    void post(std::function<std::string()> encode);

  private:
    void serve();
    void acceptViewer();
    void dropViewer();
    void hearViewer();
    void takeMessage();
    void sendSome();

    const std::string path_;
    FileDescriptor listener_, viewer_, wake_;
    std::string pending_;  // bytes still to be sent
    std::size_t sent_ = 0;
    std::atomic<bool> ready_{false}, wanted_{false}, stop_{false};
    std::mutex mutex_;
    std::function<std::string()> message_;
    std::thread thread_;
};

/** The viewer's end. */
class LiveClient {
  public:
    /** Connects to the run that writes to a folder, if there is one. \return whether it did */
    bool connect(const std::string& folder);
    bool connected() const { return static_cast<bool>(socket_); }
    /** Asks for a picture of the next frame: what a viewer has no time to show is not made. */
    void askForPicture();
    /** Whole messages that have arrived, oldest first; never waits. When the run has ended,
     *  connected() becomes false. */
    std::vector<std::string> receive();

  private:
    bool readSome();
    void cutMessages(std::vector<std::string>& messages);

    FileDescriptor socket_;
    std::string buffer_;
};

}  // namespace rgbd_graphslam
