#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>

#include <opencv2/core.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/label_observation.h"
#include "rgbd_graphslam/dataset/label_set.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace {

TEST(LabelSet, isReadFromAnIni) {
    const LabelSet labels = labelSetFromIni(
        "; classes\n[1]\nname = dining table\ncolor = [10 20 30]\n[300]\nname = cup\n", "x");
    ASSERT_EQ(labels.size(), 2u);
    EXPECT_EQ(labels.at(1).name, "dining table");
    EXPECT_EQ(labels.at(1).rgb, (std::array<std::uint8_t, 3>{10, 20, 30}));
    EXPECT_EQ(nameOf(labels, 300), "cup");
    EXPECT_EQ(nameOf(labels, 2), "class 2");
}

TEST(LabelSet, whatCannotBeUsedIsNamed) {
    for (const char* text :
         {"[0]\nname = a\n", "[chair]\nname = a\n", "[70000]\nname = a\n", "[1]\ncolor = [1 2 3]\n",
          "[1]\nname = a\ncolor = [1 2]\n", "[1]\nname = a\ncolor = [1 2 300]\n"}) {
        EXPECT_THROW(labelSetFromIni(text, "x"), Error) << text;
    }
}

TEST(LabelSet, aCommentKeepsItBesideOtherSections) {
    const LabelSet labels = {{2, {"dining table", {1, 2, 3}}}, {9, {"cup", {250, 0, 7}}}};
    const LabelSet read =
        labelsIn("[source]\n2 = 5 5 5 no\n" + toComment(labels) + "[rest]\n7 = 1 1 1 x\n");
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read.at(2).name, "dining table");
    EXPECT_EQ(read.at(9).rgb, labels.at(9).rgb);
}

TEST(LabelSet, wordsFindTheirValues) {
    const LabelSet labels = {{2, {"person", {}}}, {3, {"dog", {}}}, {4, {"wall", {}}}};
    EXPECT_EQ(labelsNamed(labels, "dog person cat"), (std::set<int>{2, 3}));
    EXPECT_TRUE(labelsNamed(labels, "").empty());
}

TEST(LabelObservation, isPutTogetherAgain) {
    cv::Mat1w labels(4, 5, std::uint16_t{7});
    for (const int high : {0, 1000}) {
        labels(2, 3) = static_cast<std::uint16_t>(255 + high);
        LabelCollector collector;
        for (const auto& observation : makeLabelObservations("RGBD", 12.5, labels)) {
            EXPECT_TRUE(isLabelSensor(observation->sensorLabel));
            EXPECT_EQ(cameraOfLabels(observation->sensorLabel), "RGBD");
            collector.note(*observation);
        }
        const cv::Mat read = collector.of("RGBD", 12.5);
        ASSERT_EQ(read.type(), CV_16UC1);
        EXPECT_EQ(cv::countNonZero(read != labels), 0);
        EXPECT_TRUE(collector.of("RGBD", 12.6).empty());
        EXPECT_TRUE(collector.of("OTHER", 12.5).empty());
    }
    EXPECT_FALSE(isLabelSensor("RGBD"));
}

TEST(LabelObservation, classesAreMasked) {
    cv::Mat1w labels(4, 5, std::uint16_t{1});
    labels(1, 1) = 6;
    mrpt::obs::CObservation3DRangeScan frame;
    maskLabels(frame, labels, {9});
    EXPECT_FALSE(frame.hasConfidenceImage) << "nothing to ignore";
    maskLabels(frame, labels, {6});
    ASSERT_TRUE(frame.hasConfidenceImage);
    const cv::Mat mask = frame.confidenceImage.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
    EXPECT_EQ(mask.at<std::uint8_t>(1, 1), 0);
    EXPECT_EQ(cv::countNonZero(mask), 19);
    labels(3, 3) = 6, labels(1, 1) = 1;
    maskLabels(frame, labels, {6});
    EXPECT_EQ(cv::countNonZero(frame.confidenceImage.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY)), 18)
        << "what was masked before stays so";
}

}  // namespace
}  // namespace rgbd_graphslam
