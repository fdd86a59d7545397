/** IMU and odometry in other units, axes or sign are named and left out, and the map is upright. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "../support/synthetic_film.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

using Change = std::function<Eigen::Vector3d(Eigen::Vector3d)>;

Eigen::Vector3d unchanged(Eigen::Vector3d v) {
    return v;
}

Change times(double factor) {
    return [factor](Eigen::Vector3d v) { return Eigen::Vector3d(factor * v); };
}

/** x, y, z become y, z, x. */
Eigen::Vector3d rotated(Eigen::Vector3d v) {
    return {v.y(), v.z(), v.x()};
}

class FaultSensors : public ::testing::Test {
  protected:
    void film(const std::string& scenario, const std::string& settings) {
        source_ = filmOf(scenario, settings);
        fs::create_directory(folder_ / "film");
        for (const auto& entry : fs::directory_iterator(source_)) {
            fs::create_symlink(entry.path(),
                               folder_ / ("film/" + entry.path().filename().string()));
        }
    }

    /** A sensor's list with other readings. */
    void change(const std::string& list, const Change& to, double delay_s = 0) const {
        std::ifstream in(source_ + "/" + list);
        fs::remove(folder_ / ("film/" + list));
        std::ofstream out(folder_ / ("film/" + list));
        out.precision(12);
        for (std::string line; std::getline(in, line);) {
            std::istringstream words(line);
            double stamp_s = 0;
            Eigen::Vector3d v;
            if (!(words >> stamp_s >> v.x() >> v.y() >> v.z())) continue;
            v = to(v);
            out << std::fixed << stamp_s + delay_s << ' ' << v.x() << ' ' << v.y() << ' ' << v.z()
                << '\n';
        }
    }

    /** A hand before both lenses, for some frames. */
    void cover(std::size_t first, std::size_t last) const {
        for (const std::string kind : {"rgb", "depth"}) {
            const fs::path images = folder_ / ("film/" + kind);
            fs::remove(images);
            fs::create_directory(images);
            std::set<fs::path> files;
            for (const auto& file : fs::directory_iterator(source_ + "/" + kind)) {
                files.insert(file.path());
            }
            std::size_t index = 0;
            for (const fs::path& file : files) {
                const bool covered = index >= first && index <= last;
                ++index;
                if (covered) {
                    cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
                    image.setTo(0);
                    cv::imwrite((images / file.filename()).string(), image);
                } else {
                    fs::create_symlink(file, images / file.filename());
                }
            }
        }
    }

    void import(const std::string& options = "") const {
        const ProgramResult imported =
            runProgram("rgbd-import", "-q '" + (folder_ / "film") + "' '" + (folder_ / "a.rawlog") +
                                          "' " + options);
        EXPECT_EQ(imported.exit_code, 0) << imported.err;
    }

    std::string slamArguments(const std::string& out) const {
        return "-q --no-maps '" RGBD_SOURCE_DIR "/ini/default.ini' '" + (folder_ / "a.rawlog") +
               "' -o '" + (folder_ / out) + "'";
    }

    /** What SLAM says of what was imported. */
    std::string problems(const std::string& import_options = "") const {
        import(import_options);
        const ProgramResult run = runProgram("rgbd-slam", slamArguments("out"));
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return run.err;
    }

    void expectUpright() const {
        for (const StampedPose& pose : readTumTrajectory(folder_ / "out/trajectory.txt")) {
            ASSERT_LT(pose.T_world_cam.R(2, 1), -0.5) << "the camera's y axis must point down";
        }
    }

    void expectToldInSummary(const std::string& text) const {
        EXPECT_THAT(readText(folder_ / "out/summary.json"), HasSubstr(text));
        EXPECT_THAT(readText(folder_ / "out/report.html"), HasSubstr(text));
    }

    TestFolder folder_;
    std::string source_;
};

const std::string hand = "--size 320x240 --frames 180";

class FaultImu : public FaultSensors {
  protected:
    FaultImu() { film("office", hand); }
};

TEST_F(FaultImu, healthyOneIsNotDoubted) {
    EXPECT_EQ(problems(), "");
    expectUpright();
}

TEST_F(FaultImu, negatedAccelerometerAndGyroscopeInDegrees) {
    change("accelerometer.txt", times(-1));
    change("gyroscope.txt", times(57.29578));
    const std::string told = problems();
    EXPECT_THAT(told, HasSubstr("accelerometer 'IMU' contradicts"));
    EXPECT_THAT(told, HasSubstr("--imu-accel-unit=-1"));
    EXPECT_THAT(told, HasSubstr("gyroscope 'IMU' contradicts"));
    EXPECT_THAT(told, HasSubstr("--imu-gyro-unit deg/s"));
    expectUpright();
    expectToldInSummary("--imu-gyro-unit deg/s");
    EXPECT_EQ(problems("--imu-accel-unit=-1 --imu-gyro-unit deg/s"), "");
}

TEST_F(FaultImu, accelerometerInGAndGyroscopeLate) {
    change("accelerometer.txt", times(1 / 9.81));
    change("gyroscope.txt", unchanged, 0.1);
    const std::string told = problems();
    EXPECT_THAT(told, HasSubstr("--imu-accel-unit g"));
    EXPECT_THAT(told, HasSubstr("its stamps are 1"));
    EXPECT_THAT(told, HasSubstr("ms too late"));
    expectUpright();
}

TEST_F(FaultImu, axesTurnedForBoth) {
    change("accelerometer.txt", rotated);
    change("gyroscope.txt", rotated);
    const std::string told = problems();
    EXPECT_THAT(told, HasSubstr("accelerometer 'IMU' contradicts"));
    EXPECT_THAT(told, HasSubstr("gyroscope 'IMU' contradicts"));
    EXPECT_THAT(told, HasSubstr("imu_pose = ["));
    expectUpright();
}

class FaultOdometry : public FaultSensors {
  protected:
    FaultOdometry() { film("corridor-loop", "--size 320x240 --frames 240"); }
};

TEST_F(FaultOdometry, healthyOneIsNotDoubted) {
    EXPECT_THAT(problems(), Not(HasSubstr("contradicts")));
}

TEST_F(FaultOdometry, inMillimetersAndDegrees) {
    change("odometry.txt", [](Eigen::Vector3d v) {
        return Eigen::Vector3d(1000 * v.x(), 1000 * v.y(), v.z() * 180 / M_PI);
    });
    const std::string told = problems();
    EXPECT_THAT(told, HasSubstr("odometry 'ODOMETRY' contradicts"));
    EXPECT_THAT(told, HasSubstr("--odometry-unit mm"));
    expectUpright();
    EXPECT_THAT(problems("--odometry-unit mm --odometry-heading-unit deg"),
                Not(HasSubstr("contradicts")));
}

/** 2,687 m of way were reported where the robot drove 4 m. */
TEST_F(FaultOdometry, inMillimetersDoesNotCarryACoveredCameraAway) {
    change("odometry.txt",
           [](Eigen::Vector3d v) { return Eigen::Vector3d(1000 * v.x(), 1000 * v.y(), v.z()); });
    cover(170, 190);
    problems();
    double way_m = 0;
    const Trajectory trajectory = readTumTrajectory(folder_ / "out/trajectory.txt");
    for (std::size_t i = 1; i < trajectory.size(); ++i) {
        way_m += (trajectory[i].T_world_cam.t - trajectory[i - 1].T_world_cam.t).norm();
    }
    EXPECT_LT(way_m, 10);
}

/** What was found of the sensors before the end is kept. */
TEST_F(FaultOdometry, resumedRunLeavesOutTheSameSensors) {
    change("odometry.txt",
           [](Eigen::Vector3d v) { return Eigen::Vector3d(-3 * v.x(), -3 * v.y(), v.z()); });
    cover(170, 190);
    import();
    const std::string often = " --set RunOptions.checkpoint_keyframes=1";
    ASSERT_EQ(runProgram("rgbd-slam", slamArguments("whole") + often).exit_code, 0);
    const std::string program = "'" RGBD_BINARY_DIR "/bin/rgbd-slam' ";
    std::string state;
    for (double delay_s = 1; state.empty() && delay_s < 20; delay_s += 0.3) {
        const std::string killed = program + slamArguments("parts") + often +
                                   " >/dev/null 2>&1 & sleep " + std::to_string(delay_s) +
                                   "; kill -KILL $!; wait $!";
        ASSERT_NE(std::system(killed.c_str()), -1);
        if (fs::exists(folder_ / "parts/checkpoint"))
            state = readText(folder_ / "parts/checkpoint");
    }
    ASSERT_FALSE(state.empty());
    const ProgramResult resumed =
        runProgram("rgbd-slam", "-q --resume '" + (folder_ / "parts") + "'");
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(readText(folder_ / "parts/trajectory.txt"),
              readText(folder_ / "whole/trajectory.txt"));
    EXPECT_THAT(readText(folder_ / "parts/summary.json"), HasSubstr("odometry 'ODOMETRY'"));
}

TEST_F(FaultOdometry, negated) {
    change("odometry.txt",
           [](Eigen::Vector3d v) { return Eigen::Vector3d(-v.x(), -v.y(), v.z()); });
    EXPECT_THAT(problems(), HasSubstr("x and y are negated"));
}

}  // namespace
}  // namespace rgbd_graphslam
