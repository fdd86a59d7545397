#include "rgbd_graphslam/synth/sequence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam::synth {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> filesBelow(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        std::ifstream in(entry.path(), std::ios::binary);
        std::ostringstream bytes;
        bytes << in.rdbuf();
        files[fs::relative(entry.path(), folder).string()] = bytes.str();
    }
    return files;
}

class Sequence : public testing::Test {
  protected:
    void SetUp() override {
        setVerbosity(Verbosity::Quiet);
        root_ = fs::path(RGBD_BINARY_DIR) / "synth_test" /
                testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(root_);
        fs::create_directories(root_);
        options_.frames = 3;
        options_.width = 160;
        options_.height = 120;
    }
    void TearDown() override { fs::remove_all(root_); }
    std::string filmed(const std::string& scenario, const std::string& name) {
        const std::string folder = (root_ / name).string();
        film(findScenario(scenario), options_, folder);
        return folder;
    }

    fs::path root_;
    FilmOptions options_;
};

TEST_F(Sequence, HasAllTheFilesOfTheBenchmark) {
    const auto files = filesBelow(filmed("long-run", "robot"));
    for (const char* name :
         {"rgb.txt", "depth.txt", "groundtruth.txt", "accelerometer.txt", "gyroscope.txt",
          "odometry.txt", "camera.ini", "surface.ply", "movers.csv"})
        EXPECT_EQ(files.count(name), 1u) << name;
    EXPECT_EQ(files.size(), 9u + 3u * 3u);
}

TEST_F(Sequence, SameSeedSameBytesOtherSeedOtherBytes) {
    const auto first = filesBelow(filmed("office", "a"));
    const auto again = filesBelow(filmed("office", "b"));
    EXPECT_EQ(first, again);
    options_.seed = 2;
    const auto other = filesBelow(filmed("office", "c"));
    EXPECT_NE(first.at("groundtruth.txt"), other.at("groundtruth.txt"));
    EXPECT_NE(first.at("rgb.txt"), other.at("rgb.txt"));
}

TEST_F(Sequence, WithoutNoiseDepthIsTheTruthAndStampsAgree) {
    options_.noise = false;
    const std::string folder = filmed("no-structure", "exact");
    EXPECT_EQ(colorStamp(options_, 2), depthStamp(options_, 2));
    const Trajectory truth = readTumTrajectory(folder + "/groundtruth.txt");
    const StampedPose* pose = nullptr;
    for (const StampedPose& candidate : truth)
        if (std::abs(candidate.stamp_s - colorStamp(options_, 0)) < 1e-6) pose = &candidate;
    ASSERT_NE(pose, nullptr);
    const cv::Mat depth = cv::imread(folder + "/depth/1000.000000.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_16UC1);
    const CameraModel camera = synthCamera(160, 120);
    double worst = 0;
    for (int v = 0; v < 120; ++v)
        for (int u = 0; u < 160; ++u) {
            const Eigen::Vector3d point =
                pose->T_world_cam * camera.unproject(u, v, depth.at<std::uint16_t>(v, u) / 5000.0);
            worst = std::max(worst, std::abs(point.x()));  // the wall is the plane x = 0
        }
    EXPECT_LT(worst, 1e-3);
}

TEST_F(Sequence, StampsOfDepthAreUpToSixteenMillisecondsOff) {
    double largest = 0;
    for (int i = 0; i < 300; ++i)
        largest = std::max(largest, std::abs(depthStamp(options_, i) - colorStamp(options_, i)));
    EXPECT_GT(largest, 0.012);
    EXPECT_LE(largest, 0.016);
}

TEST_F(Sequence, EveryOtherFrameIsTheSameFrame) {
    options_.frames = 4;
    const auto all = filesBelow(filmed("no-structure", "all"));
    options_.every = 2;
    const auto some = filesBelow(filmed("no-structure", "some"));
    EXPECT_EQ(some.size(), all.size() - 6);
    for (const auto& [name, bytes] : some) {
        if (name.find(".png") == std::string::npos) continue;
        EXPECT_EQ(all.at(name), bytes) << name;
    }
}

TEST_F(Sequence, TruthCoversAllFramesAtAHundredHertz) {
    const Trajectory truth = readTumTrajectory(filmed("office", "truth") + "/groundtruth.txt");
    EXPECT_LT(truth.front().stamp_s, depthStamp(options_, 0));
    EXPECT_GT(truth.back().stamp_s, colorStamp(options_, 2));
    for (std::size_t i = 1; i < truth.size(); ++i)
        ASSERT_NEAR(truth[i].stamp_s - truth[i - 1].stamp_s, 0.01, 2e-6);
}

TEST_F(Sequence, RegistrationErrorShiftsDepth) {
    options_.noise = false;
    const std::string exact = filmed("office", "exact");
    options_.registration_error_px = 3;
    const std::string shifted = filmed("office", "shifted");
    const std::string name = "/depth/1000.000000.png";
    const cv::Mat a = cv::imread(exact + name, cv::IMREAD_UNCHANGED),
                  b = cv::imread(shifted + name, cv::IMREAD_UNCHANGED);
    const cv::Mat overlap_a = a.colRange(0, 157), overlap_b = b.colRange(3, 160);
    cv::Mat difference;
    cv::absdiff(overlap_a, overlap_b, difference);
    EXPECT_LT(cv::countNonZero(difference > 5), 0.01 * difference.total());
}

TEST_F(Sequence, SurfaceHoldsWhatIsSeen) {
    const std::string ply = filesBelow(filmed("low-texture", "surface")).at("surface.ply");
    EXPECT_EQ(ply.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
    int vertices = 0, faces = 0;
    std::istringstream header(ply);
    for (std::string line; std::getline(header, line) && line != "end_header";) {
        std::sscanf(line.c_str(), "element vertex %d", &vertices);
        std::sscanf(line.c_str(), "element face %d", &faces);
    }
    EXPECT_GT(faces, 100);
    const std::size_t body = ply.find("end_header\n") + 11;
    EXPECT_EQ(ply.size(), body + 12u * vertices + 13u * faces);
}

/** The first picture of a folder of a sequence. */
cv::Mat firstOf(const std::string& folder, const char* kind) {
    std::vector<std::string> paths;
    for (const auto& entry : fs::directory_iterator(folder + "/" + kind))
        paths.push_back(entry.path().string());
    return cv::imread(*std::min_element(paths.begin(), paths.end()), cv::IMREAD_UNCHANGED);
}

TEST_F(Sequence, MaskIsWhereTheFilmWithoutMoversDiffers) {
    options_.noise = false;
    options_.labels = true;
    const std::string with = filmed("crowd", "with");
    options_.movers = false;
    const std::string without = filmed("crowd", "without");
    EXPECT_EQ(filesBelow(with).at("groundtruth.txt"), filesBelow(without).at("groundtruth.txt"));
    const cv::Mat mask = firstOf(with, "movers"), label = firstOf(with, "label");
    ASSERT_EQ(mask.type(), CV_8UC1);
    EXPECT_GT(cv::countNonZero(mask), 0.1 * mask.total());
    EXPECT_EQ(cv::countNonZero(firstOf(without, "movers")), 0);
    EXPECT_EQ(cv::countNonZero((label == static_cast<int>(Label::Person)) != (mask == 255)), 0);
    const cv::Mat differs = firstOf(with, "depth") != firstOf(without, "depth");
    EXPECT_EQ(cv::countNonZero(differs & (mask == 0)), 0);
    EXPECT_GT(cv::countNonZero(differs & mask), 0.99 * cv::countNonZero(mask));
}

TEST_F(Sequence, MaskOfALensIsWhereItHidesTheScene) {
    options_.noise = false;
    const std::string with = filmed("dirty-lens", "with");
    options_.movers = false;
    const std::string without = filmed("dirty-lens", "without");
    const cv::Mat mask = firstOf(with, "movers");
    EXPECT_GT(cv::countNonZero(mask), 0.03 * mask.total());
    EXPECT_LT(cv::countNonZero(mask), 0.5 * mask.total());
    cv::Mat difference;
    cv::absdiff(firstOf(with, "rgb"), firstOf(without, "rgb"), difference);
    EXPECT_GT(cv::mean(difference, mask)[0], 5 * cv::mean(difference, mask == 0)[0]);
    EXPECT_EQ(filesBelow(with).at("depth/1000.000000.png"),
              filesBelow(without).at("depth/1000.000000.png"));
}

TEST_F(Sequence, LabelsNameWhatIsSeen) {
    options_.labels = true;
    const std::string folder = filmed("low-texture", "labels");
    const cv::Mat label = firstOf(folder, "label");
    ASSERT_EQ(label.type(), CV_8UC1);
    for (const Label each : {Label::Wall, Label::Floor, Label::Pillar})
        EXPECT_GT(cv::countNonZero(label == static_cast<int>(each)), 0);
    EXPECT_EQ(cv::countNonZero(label == 0), 0);
    const std::string ini = filesBelow(folder).at("labels.ini");
    EXPECT_NE(ini.find("[1]\nname = wall\ncolor = ["), std::string::npos);
}

TEST_F(Sequence, MoversFileTellsTheirBoxes) {
    const std::string movers = filesBelow(filmed("pushed-cart", "cart")).at("movers.csv");
    EXPECT_EQ(std::count(movers.begin(), movers.end(), '\n'), 1 + 3 * 6);
    EXPECT_NE(movers.find(",cart,0,0.0000,"), std::string::npos);
    const std::string none = filesBelow(filmed("office", "none")).at("movers.csv");
    EXPECT_EQ(std::count(none.begin(), none.end(), '\n'), 1);
}

TEST_F(Sequence, AFolderThatIsNotEmptyIsAnError) {
    const std::string folder = filmed("office", "full");
    EXPECT_THROW(film(findScenario("office"), options_, folder), Error);
}

TEST_F(Sequence, ASessionThatIsNotThereIsAnError) {
    options_.session = 2;
    EXPECT_THROW(filmed("office", "x"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam::synth
