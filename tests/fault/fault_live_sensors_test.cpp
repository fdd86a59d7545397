/** Live runs over replayed sensors, and the runs over their records. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "../support/run_program.h"
#include "rgbd_graphslam/live/live_socket.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;
using testing::Not;

std::string bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class LiveSensorsRun : public ::testing::Test {
  protected:
    void writeIni(const std::string& settings) const {
        std::ofstream(ini_) << "[global]\ntime_between_launches = 0\n[REPLAY]\n"
                               "driver = CRawlogReplaySensor\nprocess_rate = 1000\n"
                               "rawlog = " RGBD_SOURCE_DIR "/rawlogs/office_sample.rawlog\n"
                            << settings;
    }
    ProgramResult live(const std::string& settings, const std::string& arguments) const {
        writeIni(settings);
        return runProgram("rgbd-slam", "--live '" + ini_ + "' -o '" + out_ + "' " + arguments);
    }
    /** Runs over the record, which must give the same files. */
    void expectRepeats(const std::string& arguments, const std::vector<std::string>& files) const {
        const std::string again = folder_ / "again";
        const ProgramResult result =
            runProgram("rgbd-slam", "'" + record_ + "' -o '" + again + "' --quiet " + arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        for (const std::string& file : files) {
            const std::string expected = bytesOf(out_ + "/" + file);
            EXPECT_FALSE(expected.empty()) << file;
            EXPECT_TRUE(bytesOf(again + "/" + file) == expected) << file;
        }
    }
    /** What summary.json says of the camera. */
    nlohmann::json camera() const {
        const nlohmann::json all = summary();
        for (const auto& sensor : all["live"]["sensors"]) {
            if (sensor["label"] == "RGBD") return sensor;
        }
        return {};
    }
    nlohmann::json summary() const {
        return nlohmann::json::parse(bytesOf(out_ + "/summary.json"));
    }

    TestFolder folder_;
    const std::string ini_ = folder_ / "sensors.ini", out_ = folder_ / "out",
                      record_ = folder_ / "record.rawlog";
    /** However slow the machine is, no frame is dropped. */
    const std::string patient_ = " --set LiveOptions.max_waiting_frames=1000";
    const std::vector<std::string> poses_ = {"trajectory.txt", "keyframes.txt", "graph.graph",
                                             "frames.csv"};
};

TEST_F(LiveSensorsRun, itsRecordGivesTheSameBytes) {
    const ProgramResult result = live("speed = 4\n", "--record '" + record_ + "'" + patient_);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("latency"));
    const auto live = summary()["live"];
    EXPECT_EQ(live["dropped"], 0);
    EXPECT_EQ(camera()["received"], summary()["frames"]);
    EXPECT_GT(live["latency_ms"]["p50"], 0);
    std::vector<std::string> files = poses_;
    files.insert(files.end(), {"points.ply", "octree.bt", "grid.png", "map.simplemap"});
    expectRepeats("", files);
}

TEST_F(LiveSensorsRun, whatWasDroppedLateOrLostIsSoInItsRecord) {
    const ProgramResult result =
        live("speed = 30\nrepeat = 4\nloss = 0.05\njitter_ms = 20\nreorder = 0.1\n",
             "--no-maps --record '" + record_ + "' --set LiveOptions.max_waiting_frames=1");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto live = summary()["live"];
    EXPECT_GT(live["dropped"], 0);
    EXPECT_GT(live["late"], 0);
    expectRepeats("--no-maps", poses_);
}

TEST_F(LiveSensorsRun, survivesASilentSensor) {
    const ProgramResult result =
        live("silent_at_s = 2\nsilent_s = 1.5\n", "--no-maps --duration 6" + patient_);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("has sent nothing for"));
    EXPECT_THAT(result.err, HasSubstr("is back after 1."));
    EXPECT_EQ(camera()["silences"], 1);
    EXPECT_GT(summary()["frames"], 20);
}

TEST_F(LiveSensorsRun, survivesASensorThatIsUnplugged) {
    const ProgramResult result =
        live("unplug_every_s = 2\nunplugged_s = 0.4\n", "--no-maps --duration 6" + patient_);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("sensor [REPLAY] failed: unplugged"));
    EXPECT_THAT(result.err, HasSubstr("sensor [REPLAY] runs again after"));
    EXPECT_GE(summary()["live"]["failures"], 2);
}

TEST_F(LiveSensorsRun, survivesAClockThatIsSet) {
    const ProgramResult result =
        live("clock_jump_at_s = 2\nclock_jump_s = -3600\n",
             "--no-maps --duration 5 --record '" + record_ + "'" + patient_);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("was set by -3600.0 s"));
    EXPECT_EQ(summary()["out_of_order"], 0);
    EXPECT_EQ(camera()["clock_jumps"], 1);
    EXPECT_GT(summary()["frames"], 30);
    EXPECT_EQ(summary()["lost"], 0);
    expectRepeats("--no-maps", poses_);
}

TEST_F(LiveSensorsRun, endsAfterFramesOrTime) {
    EXPECT_EQ(live("speed = 4\n", "--no-maps --max-frames 20" + patient_).exit_code, 0);
    EXPECT_EQ(summary()["frames"], 20);
    EXPECT_EQ(live("speed = 4\nrepeat = 1000\n", "--no-maps --duration 1.5" + patient_).exit_code,
              0);
    EXPECT_GT(summary()["frames"], 20);
    EXPECT_LT(summary()["frames"], 60);
}

TEST_F(LiveSensorsRun, endsByCtrlC) {
    writeIni("repeat = 1000\n");
    const std::string pid = folder_ / "pid";
    std::thread user([&] {
        for (int i = 0; i < 600; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            if (std::filesystem::exists(out_ + "/" + live_socket_name) || i == 599) break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        ::kill(std::stoi(bytesOf(pid)), SIGINT);
    });
    const int status =
        std::system(("sh -c 'echo $$ >" + pid +
                     "; exec \"" RGBD_BINARY_DIR "/bin/rgbd-slam\" --no-maps --quiet --live " +
                     ini_ + " -o " + out_ + " >/dev/null'")
                        .c_str());
    user.join();
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(summary()["interrupted"], false);
    EXPECT_GT(summary()["frames"], 5);
}

TEST_F(LiveSensorsRun, oneLineTellsWhatIsWrong) {
    const auto complaint = [&](const std::string& settings, const std::string& arguments = "") {
        const ProgramResult result = live(settings, arguments);
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr("rgbd-slam: error: "));
        return result.err;
    };
    EXPECT_THAT(complaint("sped = 2\n"),
                HasSubstr(ini_ + ": section [REPLAY]: unknown key 'sped'; its keys are"));
    EXPECT_THAT(complaint("loss = 2\n"), HasSubstr("give loss a number from 0 to 1"));
    EXPECT_THAT(complaint("[B]\nprocess_rate = 1\n"), HasSubstr("section [B]: no driver; add"));
    EXPECT_THAT(complaint("", "some.rawlog"), HasSubstr("leave one of them out"));
    const ProgramResult none = runProgram("rgbd-slam", "--live none.ini -o '" + out_ + "'");
    EXPECT_EQ(none.exit_code, 1);
    EXPECT_THAT(none.err, HasSubstr("none.ini"));
    EXPECT_THAT(complaint("labels = NOBODY\nspeed = 50\n"), HasSubstr("has no RGB-D frame"));
}

}  // namespace
}  // namespace rgbd_graphslam
