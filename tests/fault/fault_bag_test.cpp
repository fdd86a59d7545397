/** Real and damaged ROS bags given to rgbd-import. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>

#include "../support/bag_lines.h"
#include "../support/run_program.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string robotLog(const std::string& name) {
    const char* data = std::getenv("RGBD_DATA");
    return std::string(data ? data : RGBD_SOURCE_DIR "/../shared/data") + "/robot-logs/" + name;
}

class FaultBag : public ::testing::Test {
  protected:
    ProgramResult import(const std::string& bag, const std::string& options = "") const {
        return runProgram("rgbd-import",
                          "'" + bag + "' '" + folder_ / "out.rawlog" + "' --quiet " + options);
    }

    void expectRefused(const ProgramResult& result, const std::string& reason) const {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, AllOf(HasSubstr("error: "), HasSubstr(reason)));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        for (const auto& entry : fs::directory_iterator(folder_ / "")) {
            const std::string name = entry.path().filename().string();
            EXPECT_FALSE(name.rfind("out", 0) == 0 || name.rfind(".tmp", 0) == 0) << name;
        }
    }

    TestFolder folder_;
};

template <class Observation>
std::size_t countOf(const std::string& rawlog) {
    std::size_t count = 0;
    RawlogReader reader(rawlog);
    while (const auto observation = reader.next()) {
        if (std::dynamic_pointer_cast<Observation>(observation)) ++count;
    }
    return count;
}

TEST_F(FaultBag, aRobotWithoutCameraIsToldWhatItHas) {
    if (!fs::exists(robotLog("rl_test1.bag"))) GTEST_SKIP() << "no robot logs in $RGBD_DATA";
    const ProgramResult result = import(robotLog("rl_test1.bag"));
    expectRefused(result, "holds no color images; its topics: ");
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("(sensor_msgs/Imu, 11865)"), HasSubstr("(nav_msgs/Odometry, 3952)"),
                      HasSubstr("(sensor_msgs/NavSatFix, 989)"), HasSubstr("--no-camera")));
    expectRefused(import(robotLog("embag_test.bag")), "holds no color images; its topics: ");
}

TEST_F(FaultBag, everyReadingOfARobotWithoutCameraIsKept) {
    if (!fs::exists(robotLog("rl_test1.bag"))) GTEST_SKIP() << "no robot logs in $RGBD_DATA";
    const ProgramResult result = import(robotLog("rl_test1.bag"), "--no-camera");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string rawlog = folder_ / "out.rawlog";
    EXPECT_EQ(countOf<mrpt::obs::CObservationIMU>(rawlog), 11865u);
    EXPECT_EQ(countOf<mrpt::obs::CObservationOdometry>(rawlog), 3952u);
    EXPECT_EQ(countOf<mrpt::obs::CObservationGPS>(rawlog), 989u);
}

TEST_F(FaultBag, filesThatAreNoBags) {
    for (const std::string name : {"a.bag", "a.mcap", "a.db3"}) {
        folder_.write(name, "no bag");
        expectRefused(import(folder_ / name), "a." + fs::path(name).extension().string().substr(1));
        folder_.write(name, "");
        expectRefused(import(folder_ / name), "'");
    }
    folder_.write("a.mcap.zstd", "no bag");
    expectRefused(import(folder_ / "a.mcap.zstd"), "is damaged or cut off");
}

TEST_F(FaultBag, aCutBagIsRefused) {
    if (!fs::exists(robotLog("embag_test.bag"))) GTEST_SKIP() << "no robot logs in $RGBD_DATA";
    folder_.write("cut.bag", readText(robotLog("embag_test.bag")));
    cutFile(folder_ / "cut.bag", 0.7);
    expectRefused(import(folder_ / "cut.bag"), "is damaged or cut off");
}

TEST_F(FaultBag, anUnclosedBagIsReadWithAWarning) {
    if (!canWriteRos1Bags()) GTEST_SKIP() << ros1_needs;
    BagLines lines;
    for (const double stamp_s : {1.0, 2.0, 3.0}) {
        lines.addImage("/c", "c", stamp_s, "bgr8", small_sequence::color(0));
        lines.addImage("/d", "c", stamp_s, "16UC1", small_sequence::depth(0));
    }
    lines.recordRos1(folder_ / "killed.bag");
    unclose(folder_ / "killed.bag", 0.9);
    const ProgramResult result = import(folder_ / "killed.bag");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("is not whole (the recorder did not close the bag"));
}

TEST_F(FaultBag, aBagWithoutTransformsIsImported) {
    if (!canWriteRos1Bags()) GTEST_SKIP() << ros1_needs;
    BagLines lines;
    lines.add("camera_info /camera/color/camera_info color 1.0 32 24 30 30 16 12 0 0 0 0 0");
    lines.addImage("/camera/color/image_raw", "color", 1, "bgr8", small_sequence::color(0));
    lines.addImage("/camera/depth/image_raw", "color", 1, "16UC1", small_sequence::depth(0));
    lines.recordRos1(folder_ / "driver.bag");
    const ProgramResult result = import(folder_ / "driver.bag", "--compact");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, AllOf(HasSubstr("no ground truth"), HasSubstr("1 frames")));
    EXPECT_EQ(import(folder_ / "driver.bag", "--color-topic /nothing").exit_code, 1);
}

TEST_F(FaultBag, noCameraIsForBagsOnly) {
    small_sequence::make(folder_, "s", 2);
    expectRefused(import(folder_ / "s", "--no-camera"), "--no-camera is for ROS bags");
}

}  // namespace
}  // namespace rgbd_graphslam
