#include "rgbd_graphslam/dataset/tum_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstdlib>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/associate.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

std::string complaintAbout(const TestFolder& folder) {
    try {
        readTumSequence(folder / "s");
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(TumSequence, listsAreReadWithTheirSensors) {
    const TestFolder folder;
    folder.write("s/rgb.txt", "# color\n1305031102.175304 rgb/a b.png\r\n\n2 rgb/c.png # second\n");
    folder.write("s/depth.txt", "1.5\tdepth/a.png\n");
    folder.write("s/groundtruth.txt", "1 0.1 0.2 0.3 0 0 0 1\n");
    folder.write("s/accelerometer.txt", "# t ax ay az\n1 -0.478957 8.010560 -4.166928\n");
    folder.write("s/gyroscope.txt", "1,0.1,0.2,0.3\n");
    folder.write("s/odometry.txt", "1 0.5 -0.5 3.1\n2 0.6 -0.5 -3.1\n");
    const RgbdSequence sequence = readTumSequence(folder / "s");
    ASSERT_EQ(sequence.color.size(), 2u);
    EXPECT_EQ(sequence.color[0].stamp_s, 1305031102.175304);
    EXPECT_EQ(sequence.color[0].file, "rgb/a b.png");
    EXPECT_EQ(sequence.color[1].file, "rgb/c.png");
    EXPECT_EQ(sequence.depth.at(0).file, "depth/a.png");
    EXPECT_EQ(sequence.truth.size(), 1u);
    EXPECT_EQ(sequence.acceleration.at(0).value, Eigen::Vector3d(-0.478957, 8.01056, -4.166928));
    EXPECT_EQ(sequence.angular_velocity.at(0).value, Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_EQ(sequence.odometry.at(1).value, Eigen::Vector3d(0.6, -0.5, -3.1));
}

TEST(TumSequence, scansAreReadWithTheirScanner) {
    const TestFolder folder;
    folder.write("s/rgb.txt", "1 a.png\n");
    folder.write("s/depth.txt", "1 b.png\n");
    folder.write("s/scans.txt",
                 "# aperture_deg = 180\n# max_range_m = 20\n# sensor_pose = [0.2 0 0.3 90 0 0]\n"
                 "1 0.5 0 2.25\n1.5 1 1 1\n");
    const auto others = readTumSequence(folder / "s").others;
    ASSERT_EQ(others.size(), 2u);
    const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(others[0]);
    ASSERT_TRUE(scan);
    EXPECT_NEAR(scan->aperture, M_PI, 1e-6);
    EXPECT_NEAR(scan->sensorPose.yaw(), M_PI / 2, 1e-6);
    EXPECT_NEAR(scan->sensorPose.z(), 0.3, 1e-6);
    EXPECT_EQ(scan->getScanRange(2), 2.25f);
    EXPECT_TRUE(scan->getScanRangeValidity(0));
    EXPECT_FALSE(scan->getScanRangeValidity(1));
    folder.write("s/scans.txt", "# aperture_deg = 180\n# max_range_m = 20\n1 1 1 1\n2 1 1\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("scans.txt:4: not as many ranges"));
    folder.write("s/scans.txt", "1 1 1 1\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("lacks '# aperture_deg = DEGREES'"));
}

TEST(TumSequence, mistakesAreNamedWithFileAndLine) {
    const TestFolder folder;
    EXPECT_THAT(complaintAbout(folder), HasSubstr("there is no folder"));
    folder.write("s/depth.txt", "1 a.png\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("has no rgb.txt"));
    folder.write("s/rgb.txt", "# only comments\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("lists no image"));
    folder.write("s/rgb.txt", "1 a.png\nb.png 2\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("rgb.txt:2: 'b.png' is not a number"));
    folder.write("s/rgb.txt", "nan a.png\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("rgb.txt:1: 'nan' is not a number"));
    folder.write("s/rgb.txt", "1\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("rgb.txt:1: no file name"));
    folder.write("s/rgb.txt", "1 a.png\n");
    folder.write("s/accelerometer.txt", "# a\n1 2 3\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("accelerometer.txt:2: too few values"));
    folder.write("s/accelerometer.txt", "1 2 3 4 5\n");
    EXPECT_THAT(complaintAbout(folder), HasSubstr("accelerometer.txt:1: too many values"));
}

TEST(TumSequence, disorderOfStampsIsCounted) {
    const StampOrder order = stampOrder({{1, ""}, {2, ""}, {1.5, ""}, {2, ""}, {3, ""}, {0, ""}});
    EXPECT_EQ(order.backwards, 2u);
    EXPECT_EQ(order.repeated, 1u);
}

/** "stamp file stamp file" lines. */
std::vector<std::pair<double, double>> publishedPairs(const std::string& path) {
    std::vector<std::pair<double, double>> pairs;
    std::ifstream in(path);
    double color = 0, depth = 0;
    for (std::string color_file, depth_file; in >> color >> color_file >> depth >> depth_file;) {
        pairs.emplace_back(color, depth);
    }
    return pairs;
}

TEST(TumSequence, pairsOfFr1DeskAreThePublishedOnes) {
    const char* data = std::getenv("RGBD_DATA");
    const std::string folder =
        std::string(data ? data : RGBD_SOURCE_DIR "/../shared/data") + "/trajectories/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    const RgbdSequence sequence = readTumSequence(folder + "fr1_desk_lists");
    std::vector<double> color, depth;
    for (const auto& image : sequence.color) color.push_back(image.stamp_s);
    for (const auto& image : sequence.depth) depth.push_back(image.stamp_s);
    std::vector<std::pair<double, double>> pairs;
    for (const auto& [i, j] : associate(color, depth, 0.02)) pairs.emplace_back(color[i], depth[j]);
    EXPECT_EQ(pairs, publishedPairs(folder + "associations_reference/fr1_desk.txt"));
}

}  // namespace
}  // namespace rgbd_graphslam
