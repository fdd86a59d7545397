#include "rgbd_graphslam/input/live_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <chrono>
#include <thread>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/input/rawlog_source.h"

namespace rgbd_graphslam {
namespace {
using namespace std::chrono_literals;
using mrpt::obs::CObservation;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double start_s = 1000;

template <class T>
CObservation::Ptr measurement(const std::string& label, double at_s) {
    const auto observation = T::Create();
    observation->sensorLabel = label;
    observation->timestamp = mrpt::Clock::fromDouble(start_s + at_s);
    return observation;
}

CObservation::Ptr image(double at_s, const std::string& label = "CAM") {
    return measurement<mrpt::obs::CObservation3DRangeScan>(label, at_s);
}

CObservation::Ptr wheels(double at_s) {
    return measurement<mrpt::obs::CObservationOdometry>("WHEELS", at_s);
}

/** A source on made-up times; nothing waits. */
class Live : public testing::Test {
  protected:
    Live() {
        options_.wait_ms = 0;
        setVerbosity(Verbosity::Quiet);
    }
    LiveSource& source() {
        if (!source_) source_ = std::make_unique<LiveSource>(options_, "the sensors of a test");
        return *source_;
    }
    LiveSource::Clock::time_point moment(double at_s) const {
        return begun_ + std::chrono::duration_cast<LiveSource::Clock::duration>(
                            std::chrono::duration<double>(at_s));
    }
    /** Comes 10 ms after its stamp. */
    void push(const CObservation::Ptr& observation) {
        push(observation, toSeconds(observation->timestamp) - start_s + 0.01);
    }
    void push(const CObservation::Ptr& observation, double arrival_s) {
        source().push(observation, moment(arrival_s));
    }
    /** Tracking has begun and waits for frames. */
    void begin() {
        push(image(-1));
        const auto first = source().next();
        source().noteTracked(first->sensorLabel, first->timestamp);
    }
    /** All that there is now, as label and stamp after the start, ms. */
    std::vector<std::string> take() {
        source().close();
        std::vector<std::string> all;
        while (const auto next = source().next()) {
            all.push_back(
                next->sensorLabel + " " +
                std::to_string(std::lround(1e3 * (toSeconds(next->timestamp) - start_s))));
        }
        return all;
    }

    LiveOptions options_;
    std::unique_ptr<LiveSource> source_;
    const LiveSource::Clock::time_point begun_ = LiveSource::Clock::now() - 1h;
    WarningRecord warnings_;
};

TEST_F(Live, putsReadingsBeforeTheImageThatTheyPrecede) {
    push(wheels(0.00), 0.012);
    push(wheels(0.04), 0.041);
    push(image(0.03), 0.042);
    push(wheels(0.02), 0.043);  // overtaken on the way
    EXPECT_THAT(take(), ElementsAre("WHEELS 0", "WHEELS 20", "CAM 30", "WHEELS 40"));
    EXPECT_EQ(source().statistics().late(), 0u);
}

TEST_F(Live, keepsTheNewestImages) {
    options_.max_waiting_frames = 2;
    begin();
    for (int i = 0; i < 5; ++i) push(image(0.03 * i));
    EXPECT_THAT(take(), ElementsAre("CAM 90", "CAM 120"));
    EXPECT_EQ(source().statistics().dropped(), 3u);
    EXPECT_EQ(source().statistics().sensors.at(0).received, 6u);
    EXPECT_THAT(warnings_.warnings(), ElementsAre(HasSubstr("tracking is behind")));
}

TEST_F(Live, dropsNothingUntilTrackingHasCaughtUp) {
    options_.max_waiting_frames = 1;
    for (int i = 0; i < 30; ++i) push(image(0.03 * i));
    EXPECT_EQ(take().size(), 30u);
    EXPECT_EQ(source().statistics().dropped(), 0u);
}

TEST_F(Live, dropsWhatAllCamerasTookAtOneMoment) {
    options_.max_waiting_frames = 1;
    begin();
    for (int i = 0; i < 2; ++i) {
        push(image(0.03 * i, "LEFT"));
        push(image(0.03 * i + 0.001, "RIGHT"));
    }
    EXPECT_THAT(take(), ElementsAre("LEFT 30", "RIGHT 31"));
}

TEST_F(Live, countsWhatComesTooLate) {
    options_.late_s = 0.1;
    push(wheels(0.00));
    push(image(0.2));
    source().next();  // the wheels
    source().next();  // the image
    push(wheels(0.05), 0.3);
    push(wheels(0.15), 0.3);
    push(wheels(0.14), 0.31);
    push(image(0.2), 0.32);  // a second time
    EXPECT_THAT(take(), ElementsAre("WHEELS 140", "WHEELS 150"));
    EXPECT_EQ(source().statistics().late(), 2u);
}

TEST_F(Live, anImageWaitsForReadingsThatAreDue) {
    options_.wait_ms = 300;
    const auto now = LiveSource::Clock::now();
    for (int i = 0; i < 5; ++i) source().push(wheels(0.01 * i), now);
    source().push(image(0.045), now);
    std::thread later([&] {
        std::this_thread::sleep_for(20ms);
        source().push(wheels(0.05));
    });
    std::vector<std::string> labels;
    for (int i = 0; i < 6; ++i) labels.push_back(source().next()->sensorLabel);
    later.join();
    EXPECT_EQ(labels.back(), "CAM");  // due by 0.045 is nothing that is not there
    source().push(image(0.075));      // 0.06 and 0.07 are due
    const auto asked = LiveSource::Clock::now();
    while (source().next()->sensorLabel != "CAM") continue;
    EXPECT_GT(LiveSource::Clock::now() - asked, 1ms);
    EXPECT_LT(LiveSource::Clock::now() - asked, 2s);
}

TEST_F(Live, tellsOfSilenceOnceAndOfTheReturn) {
    options_.max_waiting_frames = 100;
    for (int i = 0; i < 10; ++i) push(image(0.03 * i));
    source().reportSilence(moment(0.9));
    EXPECT_TRUE(warnings_.warnings().empty());
    source().reportSilence(moment(1.2));
    source().reportSilence(moment(1.3));
    EXPECT_THAT(warnings_.warnings(),
                testing::Contains(HasSubstr("'CAM' has sent nothing for 0.9 s")));
    push(image(5));
    const LiveStatistics statistics = source().statistics();
    EXPECT_EQ(statistics.sensors.at(0).silences, 1u);
    EXPECT_NEAR(statistics.sensors.at(0).longest_silence_s, 4.73, 0.01);
}

TEST_F(Live, timeGoesOnWhenAClockIsSet) {
    options_.max_waiting_frames = 100;
    for (int i = 0; i < 30; ++i) {
        const double jump_s = i < 10 ? 0 : i < 20 ? 3600 : -7200;
        push(image(0.03 * i + jump_s), 0.03 * i + 0.01);
    }
    double last_s = -1;
    int images = 0;
    source().close();
    while (const auto next = source().next()) {
        const double at_s = toSeconds(next->timestamp) - start_s;
        EXPECT_GT(at_s, last_s);
        EXPECT_LT(at_s, 1.0);
        last_s = at_s;
        ++images;
    }
    EXPECT_EQ(images, 29);  // the first one after the way back is given up
    EXPECT_EQ(source().statistics().sensors.at(0).clock_jumps, 2u);
}

TEST_F(Live, aDelayIsNoJump) {
    options_.max_waiting_frames = 100;
    for (int i = 0; i < 30; ++i) push(image(0.03 * i), i < 10 ? 0.03 * i : 5 + 0.001 * i);
    EXPECT_EQ(take().size(), 30u);
    EXPECT_EQ(source().statistics().sensors.at(0).clock_jumps, 0u);
}

TEST_F(Live, endsWhenAskedTo) {
    bool wanted = false;
    source().endWhen([&] { return wanted; });
    std::thread later([&] {
        std::this_thread::sleep_for(20ms);
        wanted = true;
    });
    EXPECT_EQ(source().next(), nullptr);
    later.join();
    push(image(0));
    EXPECT_EQ(source().next(), nullptr);
}

TEST_F(Live, measuresFromTheArrivalOfAnImage) {
    const auto now = LiveSource::Clock::now();
    source().push(image(0.0), now - 2s);
    source().push(image(0.1), now);
    for (int i = 0; i < 2; ++i) {
        const auto frame = source().next();
        std::this_thread::sleep_for(5ms);
        source().noteTracked(frame->sensorLabel, frame->timestamp);
    }
    const LiveStatistics statistics = source().statistics();
    EXPECT_EQ(statistics.starting_frames, 2u);  // both came before the first was tracked
    EXPECT_TRUE(statistics.latencies_ms.empty());
    source().push(image(0.2));
    const auto frame = source().next();
    std::this_thread::sleep_for(5ms);
    source().notePose(frame->sensorLabel, frame->timestamp);
    std::this_thread::sleep_for(5ms);
    source().noteTracked(frame->sensorLabel, frame->timestamp);
    const LiveStatistics later = source().statistics();
    ASSERT_EQ(later.latencies_ms.size(), 1u);
    ASSERT_EQ(later.completions_ms.size(), 1u);
    EXPECT_GE(later.latencies_ms[0], 5);
    EXPECT_GE(later.completions_ms[0], later.latencies_ms[0] + 5);
}

TEST_F(Live, recordsWhatWasTracked) {
    const TestFolder folder;
    options_.max_waiting_frames = 3;
    source().recordTo(folder / "a.rawlog");
    begin();
    for (int i = 0; i < 4; ++i) {  // the first one is dropped
        push(wheels(0.03 * i));
        push(image(0.03 * i + 0.01));
    }
    for (int i = 0; i < 6; ++i) {
        const auto next = source().next();
        if (next->sensorLabel == "CAM" && i < 5) {
            source().noteTracked(next->sensorLabel, next->timestamp);
        }
    }
    source().end();
    EXPECT_TRUE(source().finishRecord());
    RawlogSource record(folder / "a.rawlog");
    std::vector<std::string> labels;
    std::string comments;
    while (const auto next = record.next()) {
        const auto comment = std::dynamic_pointer_cast<mrpt::obs::CObservationComment>(next);
        if (comment) {
            comments += comment->text + "\n";
        } else {
            labels.push_back(next->sensorLabel);
        }
    }
    EXPECT_THAT(labels, ElementsAre("CAM", "WHEELS", "WHEELS", "CAM", "WHEELS", "CAM"));
    EXPECT_THAT(comments, HasSubstr("is dropped"));
    EXPECT_EQ(record.surveyFrames(40), LiveSource::survey_frames);
}

TEST_F(Live, goesOnWhereTheRecordCannotBeWritten) {
    source().recordTo("/dev/full/a.rawlog");
    push(image(0));
    const auto frame = source().next();
    source().noteTracked(frame->sensorLabel, frame->timestamp);
    EXPECT_FALSE(source().finishRecord());
    EXPECT_FALSE(warnings_.warnings().empty());
}

}  // namespace
}  // namespace rgbd_graphslam
