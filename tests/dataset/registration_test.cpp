/** On real recordings registered depth raises no alarm, and depth shifted by 20 pixels does. */
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/registration_check.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;

class ClipRegistration : public ::testing::TestWithParam<const char*> {};

cv::Mat shifted(const cv::Mat& depth, int dx, int dy) {
    cv::Mat1d motion = cv::Mat1d::eye(2, 3);
    motion(0, 2) = dx;
    motion(1, 2) = dy;
    cv::Mat result;
    cv::warpAffine(depth, result, motion, depth.size(), cv::INTER_NEAREST);
    return result;
}

TEST_P(ClipRegistration, isJudgedRightly) {
    const char* data = std::getenv("RGBD_DATA");
    const fs::path folder = fs::path(data ? data : RGBD_SOURCE_DIR "/../shared/data") / GetParam();
    if (!fs::exists(folder)) GTEST_SKIP() << "no data in " << folder;
    const auto sequence = readSequence(folder, SequenceLayout::Tum, 30);
    const std::size_t frames = std::min(sequence.color.size(), sequence.depth.size());
    RegistrationCheck as_it_is, right, up;
    for (std::size_t i = 0; i < frames; i += 1 + frames / 20) {
        const auto color = readColorImage(folder / sequence.color[i].file);
        const auto depth = readDepthImage(folder / sequence.depth[i].file);
        as_it_is.add(color.pixels, depth.pixels);
        right.add(color.pixels, shifted(depth.pixels, 20, 0));
        up.add(color.pixels, shifted(depth.pixels, 0, -20));
    }
    EXPECT_FALSE(as_it_is.misalignment());
    ASSERT_TRUE(right.misalignment());
    EXPECT_LT((*right.misalignment() - Eigen::Vector2d(20, 0)).norm(), 8);
    ASSERT_TRUE(up.misalignment());
    EXPECT_LT((*up.misalignment() - Eigen::Vector2d(0, -20)).norm(), 8);
}

INSTANTIATE_TEST_SUITE_P(All, ClipRegistration,
                         ::testing::Values("tum-fr1-desk-9", "tum-fr1-xyz-4", "tum-fr2-pioneer-50",
                                           "kitchen-300", "icl-livingroom-110",
                                           "realsense-desk-250", "arm-box-50"));

}  // namespace
}  // namespace rgbd_graphslam
