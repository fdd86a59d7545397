/** Viewers that look on, sleep or die do not change what rgbd-slam writes. */
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "../support/run_program.h"
#include "rgbd_graphslam/live/live_messages.h"
#include "rgbd_graphslam/live/live_socket.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class FaultLive : public ::testing::Test {
  protected:
    /** Runs the sample while `look_on` runs in this process. */
    ProgramResult slam(const std::string& name, const std::function<void()>& look_on = {}) {
        out_ = folder_ / name;
        fs::create_directories(out_);
        std::thread viewer;
        if (look_on) viewer = std::thread(look_on);
        const ProgramResult result =
            runProgram("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" RGBD_SOURCE_DIR
                                    "/rawlogs/office_sample.rawlog' --no-maps --quiet -o '" +
                                        out_ + "'");
        if (viewer.joinable()) viewer.join();
        return result;
    }
    bool connectSoon(LiveClient& client) const {
        for (int i = 0; i < 2000 && !client.connected(); ++i) {
            if (client.connect(out_)) return true;
            std::this_thread::sleep_for(2ms);
        }
        return client.connected();
    }
    /** Kills a child without warning after its first message. */
    void killViewerInTheMidst() const {
        const pid_t child = ::fork();
        if (child == 0) {
            LiveClient client;
            connectSoon(client);
            client.askForPicture();
            while (client.connected() && client.receive().empty()) std::this_thread::sleep_for(1ms);
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status));
    }

    TestFolder folder_;
    std::string out_;
};

TEST_F(FaultLive, theResultIsTheSameWhoeverLooksOn) {
    ASSERT_EQ(slam("alone").exit_code, 0);
    const std::string alone = bytesOf(out_ + "/trajectory.txt");
    ASSERT_FALSE(alone.empty());

    std::size_t frames = 0, pictures = 0, maps = 0, features = 0;
    const ProgramResult watched = slam("watched", [&] {
        LiveClient client;
        ASSERT_TRUE(connectSoon(client));
        std::size_t asked = 0;
        while (client.connected()) {
            if (asked < 3 && asked == pictures) {
                client.askForPicture();
                ++asked;
            }
            for (const std::string& bytes : client.receive()) {
                const LiveMessage message = decode(bytes);
                const auto* frame = std::get_if<LiveFrame>(&message);
                ++(frame ? frames : maps);
                if (frame) features += frame->features.size();
                if (frame && frame->is_picture) ++pictures;
            }
            std::this_thread::sleep_for(1ms);
        }
    });
    EXPECT_EQ(watched.exit_code, 0);
    EXPECT_EQ(bytesOf(out_ + "/trajectory.txt"), alone);
    EXPECT_GE(pictures, 1u);
    EXPECT_LE(pictures, 3u);  // no more than it has asked for
    EXPECT_GE(maps, 1u);
    EXPECT_GT(frames, pictures);  // keyframes come unasked
    EXPECT_GT(features, 100 * pictures);
    EXPECT_FALSE(fs::exists(out_ + "/" + live_socket_name));

    EXPECT_EQ(slam("killed", [&] { killViewerInTheMidst(); }).exit_code, 0);
    EXPECT_EQ(bytesOf(out_ + "/trajectory.txt"), alone);

    LiveClient sleeper;
    EXPECT_EQ(slam("asleep", [&] { EXPECT_TRUE(connectSoon(sleeper)); }).exit_code, 0);
    EXPECT_EQ(bytesOf(out_ + "/trajectory.txt"), alone);
}

}  // namespace
}  // namespace rgbd_graphslam
