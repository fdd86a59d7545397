#include "rgbd_graphslam/sensors/live_sensors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <chrono>
#include <map>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;

constexpr double start_s = 1000;

/** Replays wheels and more wheels: two sensors at 100 Hz for 0.5 s. */
class Replay : public testing::Test {
  protected:
    Replay() : rawlog_(folder_ / "a.rawlog") {
        setVerbosity(Verbosity::Quiet);
        writeRawlog(rawlog_, RawlogStorage::Embedded, [](RawlogWriter& writer) {
            for (int i = 0; i < 50; ++i) {
                for (const char* label : {"A", "B"}) {
                    mrpt::obs::CObservationOdometry reading;
                    reading.sensorLabel = label;
                    reading.timestamp = mrpt::Clock::fromDouble(start_s + 0.01 * i);
                    reading.odometry.x(i);
                    writer.write(reading);
                }
            }
        });
        options_.wait_ms = 0;
        options_.late_s = 0.02;
    }
    /** \return readings of each label */
    std::map<std::string, int> run(const std::string& settings) {
        source_ = std::make_shared<LiveSource>(options_, "sensors");
        const auto begun = std::chrono::steady_clock::now();
        const LiveSensors sensors(file(settings), source_);
        std::map<std::string, int> count;
        last_s_ = 0;
        while (const auto observation = source_->next()) {
            ++count[observation->sensorLabel];
            last_s_ = toSeconds(observation->timestamp) - start_s;
        }
        took_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        return count;
    }
    SensorFile file(const std::string& settings) const {
        return parseSensorFile(
            "[REPLAY]\ndriver = CRawlogReplaySensor\nprocess_rate = 1000\n"
            "rawlog = " +
                rawlog_ + "\n" + settings,
            "a.ini");
    }
    std::string problemOf(const SensorFile& file) const {
        try {
            const LiveSensors sensors(file, std::make_shared<LiveSource>(options_, "sensors"));
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    }

    TestFolder folder_;
    const std::string rawlog_;
    LiveOptions options_;
    std::shared_ptr<LiveSource> source_;
    double took_s_ = 0, last_s_ = 0;
    WarningRecord warnings_;
};

TEST_F(Replay, takesAsLongAsTheRecording) {
    const auto count = run("");
    EXPECT_EQ(count.at("A"), 50);
    EXPECT_EQ(count.at("B"), 50);
    EXPECT_GT(took_s_, 0.45);
    EXPECT_NEAR(last_s_, 0.49, 1e-6);
}

TEST_F(Replay, takesLessAtSpeed) {
    EXPECT_EQ(run("speed = 5\n").at("A"), 50);
    EXPECT_GT(took_s_, 0.09);
    EXPECT_LT(took_s_, 0.45);
}

TEST_F(Replay, leavesOutOtherLabels) {
    EXPECT_EQ(run("labels = B, C\nspeed = 10\n").count("A"), 0u);
}

TEST_F(Replay, repeats) {
    EXPECT_EQ(run("repeat = 3\nspeed = 10\n").at("B"), 150);
    EXPECT_GT(last_s_, 1.4);
}

TEST_F(Replay, losesAShare) {
    const int count = run("loss = 0.5\nspeed = 10\n").at("A");
    EXPECT_GT(count, 10);
    EXPECT_LT(count, 40);
}

TEST_F(Replay, delayedReadingsAreSortedInOrCountedAsLate) {
    const auto count = run("reorder = 0.2\nreorder_ms = 60\n");
    const LiveStatistics statistics = source_->statistics();
    EXPECT_GT(statistics.late(), 5u);
    EXPECT_EQ(count.at("A") + count.at("B") + statistics.late(), 100u);
}

TEST_F(Replay, survivesBeingUnplugged) {
    const auto count = run("unplug_every_s = 0.295\nunplugged_s = 0.15\n");
    EXPECT_EQ(count.at("A"), 30);  // it is started again after the end
    EXPECT_GE(source_->statistics().failures, 1u);
    EXPECT_THAT(warnings_.warnings(), testing::Contains(HasSubstr("[REPLAY] failed: unplugged")));
}

TEST_F(Replay, stampsNow) {
    run("stamps = now\nspeed = 10\n");
    EXPECT_NEAR(last_s_ + start_s, toSeconds(mrpt::Clock::now()), 5);
}

TEST_F(Replay, namesWhatIsWrongWithASensor) {
    EXPECT_THAT(problemOf(file("sped = 2\n")),
                HasSubstr("a.ini: section [REPLAY]: unknown key 'sped'; its keys are "));
    EXPECT_THAT(problemOf(file("speed = much\n")),
                HasSubstr("speed = 'much' makes no sense; give speed a number from 0.01 to 100"));
    EXPECT_THAT(problemOf(file("stamps = old\n")), HasSubstr("give 'recorded' or 'now'"));
    const auto with_driver = [](const std::string& driver) {
        return parseSensorFile("[S]\nprocess_rate = 5\ndriver = " + driver + "\n", "b.ini");
    };
    EXPECT_THAT(problemOf(with_driver("CNothing")),
                HasSubstr("b.ini: section [S]: driver = 'CNothing' is unknown; name a sensor"));
    EXPECT_THAT(problemOf(with_driver("CRawlogReplaySensor")), HasSubstr("[S]: no rawlog"));
    EXPECT_THAT(problemOf(with_driver("CKinect")), HasSubstr("cannot be used"));
    EXPECT_THAT(problemOf(with_driver("CRawlogReplaySensor\nrawlog = none")),
                HasSubstr("the sensor does not start: there is no rawlog 'none'"));
}

/** Its destructor throws where there is no device. */
TEST_F(Replay, aCameraThatIsNotThereIsToldOf) {
    const std::string problem =
        problemOf(parseSensorFile("[CAM]\nprocess_rate = 30\ndriver = COpenNI2Sensor\n", "b.ini"));
    EXPECT_THAT(problem, HasSubstr("b.ini: section [CAM]"));
    EXPECT_THAT(problem, HasSubstr("check that it is plugged in"));
}

}  // namespace
}  // namespace rgbd_graphslam
