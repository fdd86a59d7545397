#include "rgbd_graphslam/input/frame_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "../../support/textured_room.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/input/rawlog_source.h"

namespace rgbd_graphslam {
namespace {

constexpr int frames = 12;

/** Observations from memory, of which nobody knows how many come. */
class MemorySource final : public ObservationSource {
  public:
    explicit MemorySource(std::vector<mrpt::obs::CObservation::Ptr> observations)
        : observations_(std::move(observations)) {}
    mrpt::obs::CObservation::Ptr next() override {
        return next_ < observations_.size() ? observations_[next_++] : nullptr;
    }
    std::optional<double> progress() const override { return std::nullopt; }
    std::string name() const override { return "memory"; }

  private:
    const std::vector<mrpt::obs::CObservation::Ptr> observations_;
    std::size_t next_ = 0;
};

class StreamOfARawlog : public testing::TestWithParam<int> {
  protected:
    StreamOfARawlog() : rawlog_(folder_ / "a.rawlog") {
        write([](RawlogWriter& writer) {
            for (const auto& frame : filmRoundTrip(frames, 0.02)) {
                writer.write(*frame);
                mrpt::obs::CObservationIMU imu;
                writer.write(imu);
            }
        });
    }
    void write(const std::function<void(RawlogWriter&)>& fill) const {
        writeRawlog(rawlog_, RawlogStorage::Embedded, fill);
    }
    /** Later frames are ready sooner. */
    static Frame slowAtFirst(const std::vector<CameraImage>& images) {
        const RgbdImage& image = images.front().image;
        const double age_s = image.stamp_s - room_start_s;
        std::this_thread::sleep_for(std::chrono::duration<double>(0.01 / (1 + 30 * age_s)));
        Frame frame;
        frame.stamp_s = image.stamp_s;
        return frame;
    }

    TestFolder folder_;
    std::string rawlog_;
};

TEST_P(StreamOfARawlog, keepsTheOrderOfTheFile) {
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    for (int i = 0; i < frames; ++i) {
        const auto frame = stream.next();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->index, static_cast<std::size_t>(i));
        EXPECT_NEAR(frame->prepared.stamp_s, room_start_s + i * room_period_s, 1e-5);
    }
    EXPECT_FALSE(stream.next());
    EXPECT_EQ(stream.expectedFrames(), static_cast<std::size_t>(frames));
}

TEST_P(StreamOfARawlog, readsAnySource) {
    std::vector<mrpt::obs::CObservation::Ptr> observations;
    for (const auto& frame : filmRoundTrip(frames, 0.02)) observations.push_back(frame);
    FrameStream stream(std::make_unique<MemorySource>(observations), {GetParam(), 3});
    stream.start(slowAtFirst);
    for (int i = 0; i < frames; ++i) {
        const auto frame = stream.next();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->observation, observations[i]);
    }
    EXPECT_FALSE(stream.next());
    EXPECT_EQ(stream.expectedFrames(), static_cast<std::size_t>(frames));
}

TEST_P(StreamOfARawlog, readsNoFurtherAheadThanTold) {
    std::atomic<int> prepared{0};
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start([&](const std::vector<CameraImage>& image) {
        ++prepared;
        return slowAtFirst(image);
    });
    stream.next();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_LE(prepared, 1 + 3);  // fetched and frames_ahead
}

TEST_P(StreamOfARawlog, canBeLeftInTheMiddle) {
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    EXPECT_TRUE(stream.next());
}

TEST_P(StreamOfARawlog, preparesNothingOnceStopped) {
    std::atomic<bool> stopped{false};
    std::atomic<int> too_late{0};
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start([&](const std::vector<CameraImage>& image) {
        Frame frame = slowAtFirst(image);
        if (stopped) ++too_late;
        return frame;
    });
    ASSERT_TRUE(stream.next());
    stream.stop();
    stopped = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(too_late, 0);
}

TEST_P(StreamOfARawlog, handsOutWhatComesBeforeTheCut) {
    cutFile(rawlog_, 0.6);
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    int handed_out = 0;
    const auto drain = [&] {
        while (stream.next()) ++handed_out;
    };
    EXPECT_THROW(drain(), Error);
    EXPECT_EQ(handed_out, 7);
}

TEST_P(StreamOfARawlog, frameWithoutDepthIsNamed) {
    write([](RawlogWriter& writer) {
        auto film = filmRoundTrip(3, 0.02);
        film[1]->hasRangeImage = false;
        for (const auto& frame : film) writer.write(*frame);
    });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    EXPECT_TRUE(stream.next());
    try {
        stream.next();
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("1700000000.033333"), std::string::npos) << e.what();
    }
}

TEST_P(StreamOfARawlog, rawlogWithoutFramesIsRefused) {
    write([](RawlogWriter& writer) {
        mrpt::obs::CObservationIMU imu;
        writer.write(imu);
    });
    EXPECT_THROW(FrameStream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3}), Error);
}

/** Two cameras, the second `late_s` after the first, on the right of it. */
void writeTwoCameras(RawlogWriter& writer, double late_s, double apart_m) {
    for (const auto& frame : filmRoundTrip(frames, 0.02)) {
        frame->sensorLabel = "LEFT";
        writer.write(*frame);
        mrpt::obs::CObservationIMU imu;
        writer.write(imu);
        frame->sensorLabel = "RIGHT";
        frame->sensorPose = frame->sensorPose + mrpt::poses::CPose3D(0, -apart_m, 0, 0, 0, 0);
        frame->timestamp = toMrptTime(toSeconds(frame->timestamp) + late_s);
        writer.write(*frame);
    }
}

TEST_P(StreamOfARawlog, whatTwoCamerasTakeAtOneMomentIsOneFrame) {
    write([](RawlogWriter& writer) { writeTwoCameras(writer, 0.001, 0.2); });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    ASSERT_EQ(stream.rig().cameras.size(), 2u);
    EXPECT_EQ(stream.rig().cameras[1].label, "RIGHT");
    const SE3 T = stream.rig().cameras[0].T_body_cam.inverse() * stream.rig().cameras[1].T_body_cam;
    EXPECT_LT((T.t - Eigen::Vector3d(0.2, 0, 0)).norm(), 1e-9);
    std::atomic<int> images_seen{0};
    stream.start([&](const std::vector<CameraImage>& images) {
        images_seen += static_cast<int>(images.size());
        return slowAtFirst(images);
    });
    std::size_t between = 0;
    for (int i = 0; i < frames; ++i) {
        const auto frame = stream.next();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->index, static_cast<std::size_t>(i));
        EXPECT_EQ(frame->camera, 0);
        ASSERT_EQ(frame->others.size(), 1u) << i;
        EXPECT_EQ(frame->others[0].first, 1);
        between += frame->before.size();
    }
    EXPECT_FALSE(stream.next());
    EXPECT_EQ(images_seen, 2 * frames) << "every observation is looked at";
    EXPECT_EQ(between, static_cast<std::size_t>(frames)) << "and nothing between is lost";
}

TEST_P(StreamOfARawlog, whatTwoCamerasTakeAtDifferentMomentsAreTwoFrames) {
    write([](RawlogWriter& writer) { writeTwoCameras(writer, 0.015, 0.2); });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    for (int i = 0; i < 2 * frames; ++i) {
        const auto frame = stream.next();
        ASSERT_TRUE(frame);
        EXPECT_EQ(frame->camera, i % 2);
        EXPECT_TRUE(frame->others.empty());
    }
    EXPECT_FALSE(stream.next());
}

TEST_P(StreamOfARawlog, oneOfTwoCamerasCanBeChosen) {
    write([](RawlogWriter& writer) { writeTwoCameras(writer, 0.001, 0.2); });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3}, "RIGHT");
    ASSERT_EQ(stream.rig().cameras.size(), 1u);
    EXPECT_EQ(stream.firstFrame().sensorLabel, "RIGHT");
    stream.start(slowAtFirst);
    int count = 0;
    while (const auto frame = stream.next()) count += frame->others.empty();
    EXPECT_EQ(count, frames);
}

TEST_P(StreamOfARawlog, camerasInTheSamePlaceAreNoRig) {
    write([](RawlogWriter& writer) { writeTwoCameras(writer, 0.001, 0); });
    ::testing::internal::CaptureStderr();
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    EXPECT_THAT(::testing::internal::GetCapturedStderr(),
                ::testing::HasSubstr("'LEFT' and 'RIGHT' have the same pose"));
    EXPECT_EQ(stream.rig().cameras.size(), 1u);
    stream.start(slowAtFirst);
    std::size_t count = 0, between = 0;
    while (const auto frame = stream.next()) {
        EXPECT_EQ(frame->index, count++);
        EXPECT_EQ(frame->observation->sensorLabel, "LEFT");
        between += frame->before.size();
    }
    EXPECT_EQ(count, static_cast<std::size_t>(frames));
    EXPECT_EQ(between, static_cast<std::size_t>(frames - 1)) << "before the frames";
    for (const SensorRecord& sensor : stream.sensors()) {
        EXPECT_EQ(sensor.used, sensor.label != "RIGHT") << sensor.label;
    }
}

/** Wheels and gyroscope on their way round, at other moments than the frames. */
void writeWithSensors(RawlogWriter& writer, double turn_rad) {
    const double turn_rad_s = turn_rad / room_period_s;
    const auto film = filmRoundTrip(frames, turn_rad);
    for (int i = -4; i < 4 * frames; ++i) {
        const double at_frame = 0.25 * i;
        const auto time = toMrptTime(room_start_s + at_frame * room_period_s - 0.002);
        mrpt::obs::CObservationIMU imu;
        imu.timestamp = time;
        imu.sensorPose = mrpt::poses::CPose3D(0, 0, 0, M_PI / 2, 0, 0);
        imu.set(mrpt::obs::IMU_WX, 0);
        imu.set(mrpt::obs::IMU_WY, 0);
        imu.set(mrpt::obs::IMU_WZ, turn_rad_s);
        writer.write(imu);
        mrpt::obs::CObservationOdometry odometry;
        odometry.timestamp = time;
        const double angle = turn_rad_s * (at_frame * room_period_s - 0.002);
        odometry.odometry = {3 + 0.5 * std::cos(angle), 0.5 * std::sin(angle), angle};
        writer.write(odometry);
        if (i >= 0 && i % 4 == 0) writer.write(*film[i / 4]);
    }
}

TEST_P(StreamOfARawlog, framesCarryWhatWheelsAndGyroscopeSay) {
    constexpr double turn_rad = 0.02;
    write([](RawlogWriter& writer) { writeWithSensors(writer, turn_rad); });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    std::vector<DeadReckoning> reckoned;
    while (const auto frame = stream.next()) reckoned.push_back(frame->prepared.reckoning);
    ASSERT_EQ(reckoned.size(), static_cast<std::size_t>(frames));
    const SE3 T_base_cam = T_optical_from_mrpt.inverse();
    for (int i = 1; i < frames; ++i) {
        const SE3 truth =
            (roundTrip(0, turn_rad) * T_base_cam).inverse() * (roundTrip(i, turn_rad) * T_base_cam);
        ASSERT_TRUE(reckoned[i].T_odometry_cam && reckoned[i].R_gyroscope_cam) << i;
        const SE3 wheels = reckoned[0].T_odometry_cam->inverse() * *reckoned[i].T_odometry_cam;
        EXPECT_LT(wheels.minus(truth).norm(), 1e-4) << i;
        const Eigen::Matrix3d turned =
            reckoned[0].R_gyroscope_cam->transpose() * *reckoned[i].R_gyroscope_cam;
        EXPECT_LT((turned - truth.R).norm(), 1e-6) << i;
    }
}

TEST_P(StreamOfARawlog, wheelsThatAreImpossiblyFastTellNothing) {
    write([](RawlogWriter& writer) {
        const auto film = filmRoundTrip(frames, 0);
        for (int i = 0; i < frames; ++i) {
            mrpt::obs::CObservationOdometry odometry;
            odometry.timestamp = toMrptTime(room_start_s + i * room_period_s - 0.002);
            odometry.odometry = {20.0 * i, 0, 0};  // in mm, by mistake
            writer.write(odometry);
            writer.write(*film[i]);
        }
    });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    stream.next();
    while (const auto frame = stream.next()) {
        EXPECT_FALSE(frame->prepared.reckoning.T_odometry_cam) << frame->index;
    }
}

TEST_P(StreamOfARawlog, aJumpOfTheWheelsIsNoMotion) {
    write([](RawlogWriter& writer) {
        const auto film = filmRoundTrip(frames, 0);
        for (int i = 0; i < frames; ++i) {
            mrpt::obs::CObservationOdometry odometry;
            odometry.timestamp = toMrptTime(room_start_s + i * room_period_s);
            odometry.odometry = {0.01 * i + (i > 1 ? 100 : 0), 0, 0};
            writer.write(odometry);
            writer.write(*film[i]);
        }
    });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    std::vector<DeadReckoning> reckoned;
    while (const auto frame = stream.next()) reckoned.push_back(frame->prepared.reckoning);
    EXPECT_FALSE(reckoned[2].T_odometry_cam);
    ASSERT_TRUE(reckoned[1].T_odometry_cam && reckoned[3].T_odometry_cam);
    const SE3 moved = reckoned[1].T_odometry_cam->inverse() * *reckoned[3].T_odometry_cam;
    EXPECT_NEAR(moved.t.norm(), 0.01, 1e-9);
}

TEST_P(StreamOfARawlog, ratesThatWereNotMeasuredAreNotZero) {
    write([](RawlogWriter& writer) {
        const auto film = filmRoundTrip(frames, 0);
        for (int i = 0; i < frames; ++i) {
            mrpt::obs::CObservationIMU imu;
            imu.timestamp = toMrptTime(room_start_s + i * room_period_s);
            imu.set(mrpt::obs::IMU_X_ACC, 9.81);
            if (i % 2) {
                for (const auto axis : {mrpt::obs::IMU_WX, mrpt::obs::IMU_WY, mrpt::obs::IMU_WZ}) {
                    imu.set(axis, std::nan(""));
                }
            }
            writer.write(imu);
            writer.write(*film[i]);
        }
    });
    FrameStream stream(std::make_unique<RawlogSource>(rawlog_), {GetParam(), 3});
    stream.start(slowAtFirst);
    while (const auto frame = stream.next()) {
        EXPECT_FALSE(frame->prepared.reckoning.R_gyroscope_cam) << frame->index;
    }
}

INSTANTIATE_TEST_SUITE_P(Threads, StreamOfARawlog, testing::Values(1, 2, 5));

}  // namespace
}  // namespace rgbd_graphslam
