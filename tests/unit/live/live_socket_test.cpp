#include "rgbd_graphslam/live/live_socket.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;

class LiveSocket : public testing::Test {
  protected:
    LiveSocket() { fs::create_directories(folder_); }
    ~LiveSocket() override { fs::remove_all(root_); }

    /** \return whether it became true within ten seconds */
    static bool soon(const std::function<bool()>& condition) {
        for (int i = 0; i < 2000; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(5ms);
        }
        return false;
    }
    static std::vector<std::string> receiveSoon(LiveClient& client) {
        std::vector<std::string> messages;
        soon([&] {
            for (auto& message : client.receive()) messages.push_back(std::move(message));
            return !messages.empty() || !client.connected();
        });
        return messages;
    }

    fs::path root_ = fs::path(testing::TempDir()) / ("rgbd-live-" + std::to_string(getpid()));
    // Longer than the address of a socket may be.
    std::string folder_ = (root_ / std::string(120, 'f')).string();
};

TEST_F(LiveSocket, messagesArriveWholeAndInOrder) {
    LiveServer server(folder_);
    LiveClient client;
    ASSERT_TRUE(client.connect(folder_));
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{3000000}}) {
        ASSERT_TRUE(soon([&] { return server.ready(); }));
        server.post([=] { return std::string(size, 'x'); });
        const auto messages = receiveSoon(client);
        ASSERT_EQ(messages.size(), 1U);
        EXPECT_EQ(messages[0], std::string(size, 'x'));
    }
}

TEST_F(LiveSocket, nobodyListensMeansNothingIsMade) {
    LiveServer server(folder_);
    EXPECT_FALSE(server.ready());
    std::atomic<int> made{0};
    for (int i = 0; i < 100; ++i) {
        server.post([&] { return std::to_string(++made); });
    }
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(made, 0);
}

TEST_F(LiveSocket, aViewerThatDoesNotReadCostsNeitherTimeNorMemory) {
    LiveServer server(folder_);
    LiveClient sleeper;
    ASSERT_TRUE(sleeper.connect(folder_));
    ASSERT_TRUE(soon([&] { return server.ready(); }));
    std::atomic<int> made{0};
    const auto big = [&] {
        ++made;
        return std::string(8 << 20, 'x');
    };
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 100000; ++i) server.post(big);
    EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
    EXPECT_TRUE(soon([&] { return made == 1; }));
    std::this_thread::sleep_for(50ms);
    for (int i = 0; i < 1000; ++i) server.post(big);
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(made, 1);  // the first fills the socket, all others are dropped unmade
    EXPECT_EQ(receiveSoon(sleeper).size(), 1U);  // and it arrives once the viewer wakes up
}

TEST_F(LiveSocket, viewersComeAndGo) {
    LiveServer server(folder_);
    for (int i = 0; i < 5; ++i) {
        LiveClient client;
        ASSERT_TRUE(client.connect(folder_));
        ASSERT_TRUE(soon([&] { return server.ready(); }));
        if (i % 2 == 0) {  // gone in the midst of a message
            server.post([] { return std::string(8 << 20, 'x'); });
        } else {
            server.post([] { return std::string("hello"); });
            EXPECT_EQ(receiveSoon(client), std::vector<std::string>{"hello"});
        }
    }
    EXPECT_TRUE(soon([&] { return !server.ready(); }));
}

TEST_F(LiveSocket, aPictureIsWantedOnceForEachThatWasAskedFor) {
    LiveServer server(folder_);
    {
        LiveClient client;
        ASSERT_TRUE(client.connect(folder_));
        ASSERT_TRUE(soon([&] { return server.ready(); }));
        EXPECT_FALSE(server.pictureWanted());
        client.askForPicture();
        ASSERT_TRUE(soon([&] { return server.pictureWanted(); }));
        server.pictureSent();
        EXPECT_FALSE(server.pictureWanted());
        EXPECT_TRUE(server.ready());
        client.askForPicture();
        ASSERT_TRUE(soon([&] { return server.pictureWanted(); }));
    }
    LiveClient next;  // has not asked for what the one before it wanted
    ASSERT_TRUE(soon([&] { return !server.ready(); }));
    ASSERT_TRUE(next.connect(folder_));
    ASSERT_TRUE(soon([&] { return server.ready(); }));
    EXPECT_FALSE(server.pictureWanted());
}

TEST_F(LiveSocket, aMessageThatCannotBeMadeIsLeftOut) {
    LiveServer server(folder_);
    LiveClient client;
    ASSERT_TRUE(client.connect(folder_));
    ASSERT_TRUE(soon([&] { return server.ready(); }));
    server.post([]() -> std::string { throw Error("no image"); });
    ASSERT_TRUE(soon([&] { return server.ready(); }));
    server.post([] { return std::string("next"); });
    EXPECT_EQ(receiveSoon(client), std::vector<std::string>{"next"});
}

TEST_F(LiveSocket, theEndIsNoticedAndTheSocketRemoved) {
    LiveClient client;
    EXPECT_FALSE(client.connect(folder_));
    {
        LiveServer server(folder_);
        ASSERT_TRUE(client.connect(folder_));
    }
    EXPECT_TRUE(soon([&] {
        client.receive();
        return !client.connected();
    }));
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(LiveSocket, whatAKilledRunLeftIsReplaced) {
    std::ofstream(folder_ + "/" + live_socket_name) << "left over";
    LiveServer server(folder_);
    LiveClient client;
    EXPECT_TRUE(client.connect(folder_));
}

TEST_F(LiveSocket, aFolderThatIsNoneIsAnError) {
    EXPECT_THROW(LiveServer(folder_ + "/nothing"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
