#include "rgbd_graphslam/evaluation/mask_accuracy.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/evaluation/commands.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

/** 100 x 100 pixels, masked in some columns. */
cv::Mat columns(int from, int to) {
    cv::Mat mask = cv::Mat::zeros(100, 100, CV_8UC1);
    mask.colRange(from, to).setTo(255);
    return mask;
}

TEST(MaskScore, isIntersectionOverUnion) {
    MaskScore score;
    score.add(columns(0, 30), columns(0, 20));
    score.add(columns(0, 20), columns(0, 20));
    const MaskAccuracy accuracy = score.result();
    EXPECT_EQ(accuracy.scored, 2u);
    EXPECT_NEAR(accuracy.mean_iou, (2.0 / 3 + 1) / 2, 1e-12);
    EXPECT_NEAR(accuracy.total_iou, 40.0 / 50, 1e-12);
    EXPECT_EQ(accuracy.good, 0.5);
    EXPECT_NEAR(accuracy.falsely_masked, 10.0 / 160, 1e-12);
}

TEST(MaskScore, leavesOutSmallAndSlowMoversButNotWhatIsMaskedInVain) {
    MaskScore score;
    score.add(columns(50, 60), columns(0, 1));
    score.add(columns(0, 0), columns(0, 40), false);
    const MaskAccuracy accuracy = score.result();
    EXPECT_EQ(accuracy.pictures, 2u);
    EXPECT_EQ(accuracy.scored, 0u);
    EXPECT_NEAR(accuracy.falsely_masked, 10.0 / (99 + 60), 1e-12);
}

TEST(MaskScore, refusesMasksOfAnotherSize) {
    EXPECT_THROW(MaskScore().add(cv::Mat::zeros(10, 10, CV_8UC1), columns(0, 1)), Error);
}

class MaskFolders : public testing::Test {
  protected:
    void SetUp() override {
        root_ = fs::path(RGBD_BINARY_DIR) / "masks_test" /
                testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(root_);
        fs::create_directories(root_ / "mask");
        fs::create_directories(root_ / "found");
    }
    void TearDown() override { fs::remove_all(root_); }
    void write(const std::string& name, const cv::Mat& mask) const {
        ASSERT_TRUE(cv::imwrite((root_ / name).string(), mask));
    }
    MaskAccuracy evaluated(const std::vector<MoverBox>& movers = {}) const {
        return evaluateMasks((root_ / "found").string(), (root_ / "mask").string(), movers);
    }

    fs::path root_;
};

TEST_F(MaskFolders, arePairedByStamp) {
    write("mask/1000.000000.png", columns(0, 20));
    write("mask/1000.033333.png", columns(20, 40));
    write("mask/1000.066667.png", columns(40, 60));
    write("found/1000.0340.png", columns(20, 40));
    write("found/1000.0001.png", columns(0, 10));
    const MaskAccuracy accuracy = evaluated();
    EXPECT_EQ(accuracy.pictures, 2u);
    EXPECT_EQ(accuracy.missing, 1u);
    EXPECT_NEAR(accuracy.mean_iou, 0.75, 1e-12);
}

TEST_F(MaskFolders, areScoredWhereAMoverIsFastOrCarried) {
    for (const char* folder : {"mask/", "found/"})
        for (const char* stamp : {"1.png", "2.png", "3.png"})
            write(folder + std::string(stamp), columns(0, 20));
    MoverBox slow, fast, carried;
    slow.stamp_s = 1;
    slow.speed_m_s = 0.1;
    fast.stamp_s = 2;
    fast.speed_m_s = 0.5;
    carried.stamp_s = 3;
    carried.carried = true;
    EXPECT_EQ(evaluated({slow, fast, carried}).scored, 2u);
    EXPECT_EQ(evaluated().scored, 3u);
}

TEST_F(MaskFolders, withoutACommonStampAreAnError) {
    write("mask/1.png", columns(0, 20));
    write("found/2.png", columns(0, 20));
    EXPECT_THROW(evaluated(), Error);
    fs::remove(root_ / "found/2.png");
    EXPECT_THROW(evaluated(), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
