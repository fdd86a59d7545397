#include "rgbd_graphslam/semantics/segmentation_network.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "../../support/small_onnx.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

/** Scores: 0.2 for the background, redness and blueness. */
SemanticOptions colorModel(const std::string& folder) {
    SemanticOptions options;
    options.model = folder + "/colors.onnx";
    writeSmallOnnx(options.model, 32, 24, {0, 0, 0, 1, -1, -1, -1, -1, 1}, {0.2F, 0, 0});
    options.model_width = 32;
    options.model_height = 24;
    return options;
}

cv::Mat halves() {
    cv::Mat3b image(48, 64, cv::Vec3b(0, 0, 250));
    image.colRange(32, 64) = cv::Vec3b(250, 0, 0);
    image.rowRange(40, 48) = cv::Vec3b(90, 90, 90);
    return image;
}

TEST(SegmentationNetwork, labelsImagesOfAnySize) {
    const TestFolder folder;
    const cv::Mat labels =
        SegmentationNetwork(colorModel(std::string(folder / ""))).labelsOf(halves());
    ASSERT_EQ(labels.type(), CV_16UC1);
    ASSERT_EQ(labels.size(), cv::Size(64, 48));
    EXPECT_EQ(labels.at<std::uint16_t>(10, 10), 1) << "red, in RGB";
    EXPECT_EQ(labels.at<std::uint16_t>(10, 50), 2) << "blue";
    EXPECT_EQ(labels.at<std::uint16_t>(45, 10), 0) << "background";
}

TEST(SegmentationNetwork, aModelWithoutBackgroundCountsFromOne) {
    const TestFolder folder;
    SemanticOptions options = colorModel(std::string(folder / ""));
    options.model_has_background = false;
    const cv::Mat labels = SegmentationNetwork(options).labelsOf(halves());
    EXPECT_EQ(labels.at<std::uint16_t>(10, 10), 2);
    EXPECT_EQ(labels.at<std::uint16_t>(45, 10), 1);
}

TEST(SegmentationNetwork, whatIsNoModelIsNamed) {
    const TestFolder folder;
    SemanticOptions options;
    options.model = std::string(folder / "") + "/none.onnx";
    EXPECT_THROW(SegmentationNetwork{options}, Error);
    std::ofstream(options.model) << "this is no model";
    try {
        SegmentationNetwork network(options);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("none.onnx"), std::string::npos);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
