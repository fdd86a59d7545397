/** Rawlogs that are cut, mixed up, or hold what no camera films: each ends in the results of what
 *  can be used and one clear line, never in a crash. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

#include "../support/run_program.h"
#include "../support/textured_room.h"
#include "../support/unpacked.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using Film = std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>;

class FaultRawlog : public ::testing::Test {
  protected:
    void write(const std::function<void(RawlogWriter&)>& fill,
               RawlogStorage storage = RawlogStorage::Embedded) const {
        writeRawlog(rawlog(), storage, fill);
    }
    void write(const Film& film) const {
        write([&](RawlogWriter& writer) {
            for (const auto& frame : film) writer.write(*frame);
        });
    }
    std::string rawlog() const { return folder_ / "a.rawlog"; }

    ProgramResult slam() const {
        return runProgram("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + rawlog() +
                                           "' -o '" + folder_ / "out" + "' --no-maps --quiet");
    }
    void expectFine(const std::string& said) const {
        const ProgramResult result = slam();
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_THAT(result.out + result.err, HasSubstr(said));
    }
    void expectRefused(const std::string& reason) const {
        const ProgramResult result = slam();
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("rgbd-slam: error: "));
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_EQ(result.err.find("error: "), result.err.rfind("error: ")) << result.err;
    }
    /** \return observations before the end or the damage; `error` is "" when there is none */
    std::size_t readAll(std::string& error) const {
        std::size_t observations = 0;
        error.clear();
        try {
            RawlogReader reader(rawlog());
            while (reader.next()) ++observations;
        } catch (const Error& e) {
            error = e.what();
        }
        return observations;
    }

    TestFolder folder_;
    const Film film_ = filmRoundTrip(6, 0.02);
};

class FaultCutRawlog : public FaultRawlog, public ::testing::WithParamInterface<RawlogStorage> {};

TEST_P(FaultCutRawlog, atEveryPercentOfItsLength) {
    write(
        [&](RawlogWriter& writer) {
            for (const auto& frame : film_) writer.write(*frame);
        },
        GetParam());
    const std::string whole = readText(rawlog());
    std::string error;
    ASSERT_EQ(readAll(error), film_.size()) << error;
    std::size_t before = 0;
    for (int percent = 0; percent < 100; ++percent) {
        folder_.write("a.rawlog", whole.substr(0, whole.size() * percent / 100));
        const std::size_t observations = readAll(error);
        const bool between_entries = GetParam() == RawlogStorage::Embedded &&
                                     percent * film_.size() % 100 == 0 && observations > 0;
        EXPECT_THAT(error, AnyOf(HasSubstr("cut off or damaged"), HasSubstr("is not a rawlog"),
                                 HasSubstr("is empty"), between_entries ? "" : "never"))
            << percent << " %";
        EXPECT_LT(observations, film_.size());
        EXPECT_GE(observations, before) << percent << " %";
        before = observations;
    }
    EXPECT_GE(before, film_.size() - 1);
}

INSTANTIATE_TEST_SUITE_P(Storages, FaultCutRawlog,
                         ::testing::Values(RawlogStorage::Embedded, RawlogStorage::Small),
                         [](const auto& storage) {
                             return storage.param == RawlogStorage::Small ? "packed" : "plain";
                         });

#ifdef __SANITIZE_ADDRESS__
const std::string little_memory = "";  // the sanitizer itself needs more
#else
const std::string little_memory = "ulimit -d 2000000; ";
#endif

TEST_F(FaultRawlog, stereoPairsWithoutCalibrationAreRefused) {
    write([](RawlogWriter& writer) {
        mrpt::obs::CObservationStereoImages pair;
        pair.timestamp = mrpt::Clock::now();
        for (int i = 0; i < 3; ++i) writer.write(pair);
    });
    const ProgramResult result = slam();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("stereo pair at stamp"));
    EXPECT_THAT(result.err, HasSubstr("calibration is unusable"));
}

TEST_F(FaultRawlog, damagedLengthsEndInOneLine) {
    write(Film{film_[0]});
    const std::string whole = readText(rawlog());
    for (std::size_t at = 0; at < 400; at += 23) {
        std::string changed = whole;
        changed.replace(at, 4, "\xff\xff\xff\x7f");
        folder_.write("a.rawlog", changed);
        const int status = std::system(
            ("bash -c \"" + little_memory + "'" RGBD_BINARY_DIR "/bin/rawlog2tum' '" + rawlog() +
             "' '" + folder_ / "sequence" + "' --quiet 2>'" + folder_ / "err" + "'\" 2>/dev/null")
                .c_str());
        const std::string err = readText(folder_ / "err");
        if (WEXITSTATUS(status) == 0) continue;  // the bytes were a number, not a length
        EXPECT_THAT(err, HasSubstr("rawlog2tum: error: ")) << "byte " << at;
        EXPECT_EQ(err.find("crashed"), std::string::npos) << "byte " << at;
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        fs::remove_all(folder_ / "sequence");
    }
}

/** While it lives, a block of 1 GB is refused. */
class LittleMemory {
  public:
    LittleMemory() {
#ifndef __SANITIZE_ADDRESS__  // which needs more itself
        getrlimit(RLIMIT_DATA, &before_);
        rlimit little = before_;
        little.rlim_cur = rlim_t{1} << 30;
        setrlimit(RLIMIT_DATA, &little);
#endif
    }
    ~LittleMemory() {
#ifndef __SANITIZE_ADDRESS__
        setrlimit(RLIMIT_DATA, &before_);
#endif
    }
    LittleMemory(const LittleMemory&) = delete;
    LittleMemory& operator=(const LittleMemory&) = delete;

  private:
    rlimit before_;
};

TEST_F(FaultRawlog, textsAndListsTakeNoMoreMemoryThanTheFileHas) {
    mrpt::obs::CObservationRawDAQ voltages;
    voltages.sensorLabel = "a label";
    voltages.AIN_double.assign(20, 1.0);
    mrpt::obs::CObservationComment comment;
    comment.text = "a text";
    write([&](RawlogWriter& writer) {
        writer.write(comment);
        writer.write(voltages);
    });
    const std::string whole = readText(rawlog());
    std::string error;
    ASSERT_EQ(readAll(error), 2u) << error;
    int refused = 0;
    for (std::size_t at = 0; at + 4 <= whole.size(); ++at) {
        std::string changed = whole;
        folder_.write("a.rawlog", changed.replace(at, 4, "\xff\xff\xff\x7f"));
        const LittleMemory while_reading;
        readAll(error);
        EXPECT_THAT(error, Not(AnyOf(HasSubstr("bad_alloc"), HasSubstr("memory"))))
            << "byte " << at;
        refused += !error.empty();
    }
    EXPECT_GT(refused, static_cast<int>(whole.size() / 3));
}

/** Nor when it is refused: MRPT's destructor makes room for more then. */
TEST_F(FaultRawlog, pointsTakeNoMoreMemoryThanTheFileHas) {
    const std::string points("\x34\x12\0\0", 4), too_many("\xff\xff\xff\x0f", 4);
    film_[1]->resizePoints3DVectors(0x1234);
    film_[1]->hasPoints3D = true;
    write(Film{film_[0], film_[1]});
    std::string bytes = readText(rawlog()), error;
    ASSERT_EQ(readAll(error), 2u) << error;
    const std::size_t at = bytes.rfind(points);
    ASSERT_NE(at, std::string::npos);
    folder_.write("a.rawlog", bytes.replace(at, too_many.size(), too_many));
    const LittleMemory while_reading;
    EXPECT_EQ(readAll(error), 1u);
    EXPECT_THAT(error, HasSubstr("more memory than there is"));
}

/** Asked for in one block this is more than any machine of today grants. */
TEST_F(FaultRawlog, aSizeThatNoFrameHas) {
    const std::string rows_and_columns("\xf0\0\0\0\x40\1\0\0", 8);
    const std::string too_many("\xf0\xff\xff\x7f\x40\1\0\0", 8);
    write(film_);
    std::string bytes = readText(rawlog());
    std::size_t at = 0;
    for (int frame = 0; frame < 5; ++frame) at = bytes.find("CObservation3DRangeScan", at + 1);
    at = bytes.find(rows_and_columns, at);
    ASSERT_NE(at, std::string::npos);
    folder_.write("a.rawlog", bytes.replace(at, too_many.size(), too_many));
    std::string error;
    EXPECT_EQ(readAll(error), 4u);
    EXPECT_THAT(error, HasSubstr("damaged at entry 4"));
    EXPECT_THAT(error, HasSubstr("more memory than there is"));
    expectRefused("damaged at entry 4");
    EXPECT_THAT(readText(folder_ / "out/summary.json"), HasSubstr("\"tracked\": 4"));
}

/** libjpeg ends the process, this test's too, where nobody takes its errors. */
TEST_F(FaultRawlog, damagedJpegHeaders) {
    constexpr std::size_t header_bytes = 620;
    write([&](RawlogWriter& writer) { writer.write(*film_[0]); }, RawlogStorage::Small);
    const std::string whole = unpacked(rawlog());
    const std::size_t jpeg = whole.find(std::string("\xff\xd8\xff\xe0\0\x10JFIF", 10));
    ASSERT_NE(jpeg, std::string::npos);
    int refused = 0;
    for (std::size_t at = jpeg; at < jpeg + header_bytes; at += 5) {
        std::string changed = whole, error;
        folder_.write("a.rawlog", changed.replace(at, 2, "\xff\x7f"));
        readAll(error);
        refused += !error.empty();
    }
    EXPECT_GT(refused, 20);
}

TEST_F(FaultRawlog, swappedFrames) {
    Film film = film_;
    std::swap(film[2], film[3]);
    write(film);
    expectFine("5 tracked");
    expectFine("is not later than the one before");
}

TEST_F(FaultRawlog, stampsBackwards) {
    write(Film(film_.rbegin(), film_.rend()));
    expectFine("left out      5 frames");
}

TEST_F(FaultRawlog, anHoursGap) {
    for (std::size_t i = 3; i < film_.size(); ++i) {
        film_[i]->timestamp = toMrptTime(room_start_s + 3600 + double(i) * room_period_s);
    }
    write(film_);
    expectFine("6 tracked");
}

TEST_F(FaultRawlog, framesWithoutTimestamps) {
    for (const auto& frame : film_) frame->timestamp = INVALID_TIMESTAMP;
    write(film_);
    expectRefused("frame 0 of the rawlog has no timestamp");
}

/** Files that an import with --compact copies as they are. */
TEST_F(FaultRawlog, colorFilesThatAreGrayDeepOrTransparent) {
    std::vector<std::string> files;
    for (std::size_t i = 0; i < film_.size(); ++i) {
        cv::Mat pixels = film_[i]->intensityImage.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
        if (i % 3 == 0) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2GRAY);
        if (i % 3 == 1) pixels.convertTo(pixels, CV_16U, 257);
        if (i % 3 == 2) cv::cvtColor(pixels, pixels, cv::COLOR_BGR2BGRA);
        files.push_back(folder_ / (std::to_string(i) + ".png"));
        cv::imwrite(files.back(), pixels);
    }
    write(
        [&](RawlogWriter& writer) {
            for (std::size_t i = 0; i < film_.size(); ++i) writer.writeFrame(*film_[i], files[i]);
        },
        RawlogStorage::Compact);
    expectFine("6 tracked");
    EXPECT_TRUE(fs::exists(folder_ / "out/keyframes.jpg"));
}

TEST_F(FaultRawlog, otherSensorsBetween) {
    write([&](RawlogWriter& writer) {
        for (const auto& frame : film_) {
            mrpt::obs::CObservation2DRangeScan laser;
            mrpt::obs::CObservationGPS gps;
            mrpt::obs::CObservationIMU imu;
            for (mrpt::obs::CObservation* other :
                 std::initializer_list<mrpt::obs::CObservation*>{&laser, &gps, &imu}) {
                other->timestamp = frame->timestamp;
                writer.write(*other);
            }
            writer.write(*frame);
        }
    });
    expectFine("6 tracked");
}

TEST_F(FaultRawlog, noFrames) {
    write([&](RawlogWriter& writer) {
        mrpt::obs::CObservationIMU imu;
        writer.write(imu);
    });
    expectRefused("has no RGB-D frame");
}

TEST_F(FaultRawlog, oneFrame) {
    write(Film{film_[0]});
    expectFine("1 tracked");
    EXPECT_TRUE(fs::exists(folder_ / "out/map.sparse"));
}

TEST_F(FaultRawlog, blackImages) {
    for (const auto& frame : film_) setColor(*frame, cv::Mat::zeros(240, 320, CV_8UC3));
    write(film_);
    expectRefused("none of the 6 frames");
}

TEST_F(FaultRawlog, noDepthReadings) {
    for (const auto& frame : film_) setDepth(*frame, cv::Mat::zeros(240, 320, CV_16UC1));
    write(film_);
    expectRefused("none of the 6 frames");
}

TEST_F(FaultRawlog, aBlackFrameBetween) {
    setColor(*film_[3], cv::Mat::zeros(240, 320, CV_8UC3));
    write(film_);
    expectFine("1 lost");
}

TEST_F(FaultRawlog, truthThatIsNoNumber) {
    write([&](RawlogWriter& writer) {
        for (const auto& frame : film_) {
            mrpt::obs::CObservationRobotPose truth;
            truth.sensorLabel = ground_truth_label;
            truth.timestamp = frame->timestamp;
            truth.pose.mean.x(std::numeric_limits<double>::quiet_NaN());
            writer.write(truth);
            writer.write(*frame);
        }
    });
    const ProgramResult result = slam();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
}

TEST_F(FaultRawlog, sensorPoseThatIsNoNumber) {
    for (const auto& frame : film_) {
        frame->sensorPose.x(std::numeric_limits<double>::quiet_NaN());
    }
    write(film_);
    expectRefused("sensor pose");
}

TEST_F(FaultRawlog, calibrationThatIsNone) {
    for (const auto& frame : film_) {
        frame->cameraParamsIntensity.setIntrinsicParamsFromValues(0, 0, 0, 0);
    }
    write(film_);
    expectRefused("calibration");
}

TEST_F(FaultRawlog, lensThatCannotBeUndone) {
    for (const double k1 : {-3.0, std::numeric_limits<double>::quiet_NaN()}) {
        for (const auto& frame : film_) {
            frame->cameraParamsIntensity.setDistortionPlumbBob(k1, 0, 0, 0, 0);
        }
        write(film_);
        expectRefused("lens distortion that cannot be undone");
    }
}

TEST_F(FaultRawlog, lensThatCannotBeUndoneInALaterFrame) {
    film_[4]->cameraParamsIntensity.setDistortionPlumbBob(-3, 0, 0, 0, 0);
    write(film_);
    expectRefused("lens distortion that cannot be undone");
    EXPECT_THAT(readText(folder_ / "out/summary.json"), HasSubstr("\"tracked\": 4"));
}

/** Tables are made for the size that the calibration names, before any image is looked at. */
TEST_F(FaultRawlog, calibrationOfAnImpossibleSize) {
    for (const auto& frame : film_) frame->cameraParamsIntensity.nrows = 0x7fffffff;
    write(film_);
    expectRefused("images of an impossible size");
}

TEST_F(FaultRawlog, flagThatIsNeitherYesNorNo) {
    for (bool* flag :
         {&film_[0]->hasIntensityImage, &film_[1]->hasRangeImage, &film_[2]->range_is_depth}) {
        std::memset(static_cast<void*>(flag), 19, 1);
    }
    for (int frame = 0; frame < 3; ++frame) EXPECT_THROW(toRgbdImage(film_[frame]), Error) << frame;
}

TEST_F(FaultRawlog, depthUnitThatIsNone) {
    for (const auto& frame : film_) frame->rangeUnits = 0;
    write(film_);
    expectRefused("depth unit");
}

/** \return three frames of that size, gray squares 1 m away */
Film filmOfSize(int width, int height) {
    CameraSetup setup;
    setup.camera =
        Intrinsics{width, height, 0.8 * width, 0.8 * width, width / 2.0, height / 2.0, {}};
    cv::Mat squares(24, 32, CV_8UC3), color;
    cv::RNG(1).fill(squares, cv::RNG::UNIFORM, 0, 256);
    cv::resize(squares, color, {width, height}, 0, 0, cv::INTER_NEAREST);
    Film film;
    for (int i = 0; i < 3; ++i) {
        film.push_back(makeRgbdObservation(setup, room_start_s + i));
        setColor(*film.back(), color);
        setDepth(*film.back(), cv::Mat(height, width, CV_16UC1, cv::Scalar(5000)));
    }
    return film;
}

TEST_F(FaultRawlog, onePixelImages) {
    write(filmOfSize(1, 1));
    expectRefused("none of the 3 frames");
}

TEST_F(FaultRawlog, veryLargeImages) {
    write(filmOfSize(4096, 3072));
    expectFine("3 tracked");
}

TEST_F(FaultRawlog, nameThatIsNoUtf8) {
    write(film_);
    fs::rename(rawlog(), folder_ / "\xe4.rawlog");
    const ProgramResult result = runProgram(
        "rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" + folder_ / "\xe4.rawlog" +
                         "' -o '" + folder_ / "out" + "' --no-maps --quiet");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(readText(folder_ / "out/summary.json"), HasSubstr("\"tracked\": 6"));
}

}  // namespace
}  // namespace rgbd_graphslam
