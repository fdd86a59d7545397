#include "rgbd_graphslam/dataset/depth_statistics.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace rgbd_graphslam {
namespace {

/** A room with readings spread evenly between two distances. */
DepthHistogram room(double nearest_m, double farthest_m, double units) {
    cv::Mat1w depth(240, 320);
    cv::RNG random(7);
    random.fill(depth, cv::RNG::UNIFORM, nearest_m * units, farthest_m * units);
    depth.rowRange(0, 24).setTo(0);
    DepthHistogram histogram;
    histogram.add(depth);
    return histogram;
}

TEST(DepthStatistics, quartilesAreInMeters) {
    const DepthSummary summary = summarize(room(1, 3, 5000), 1.0 / 5000);
    EXPECT_NEAR(summary.lower_quartile_m, 1.5, 0.05);
    EXPECT_NEAR(summary.median_m, 2, 0.05);
    EXPECT_NEAR(summary.upper_quartile_m, 2.5, 0.05);
    EXPECT_NEAR(summary.far_m, 2.9, 0.05);
    EXPECT_NEAR(summary.coverage, 0.9, 1e-9);
    EXPECT_EQ(summary.share_too_near, 0);
    EXPECT_EQ(summary.share_beyond, 0);
}

TEST(DepthStatistics, nothingIsConcludedFromNothing) {
    DepthHistogram empty;
    empty.add(cv::Mat1w(24, 32, std::uint16_t{0}));
    EXPECT_EQ(empty.quantile(0.5), 0);
    EXPECT_EQ(summarize(empty, 0.001).median_m, 0);
    EXPECT_EQ(toText(summarize(empty, 0.001)), "no pixel has a reading");
    EXPECT_FALSE(plausibleDepthUnits(empty, 5000, true));
    EXPECT_FALSE(betterMaxDepth(summarize(empty, 0.001)));
}

TEST(DepthStatistics, millimetersReadAsTumsUnitsAreFound) {
    EXPECT_EQ(plausibleDepthUnits(room(0.8, 4, 1000), 5000, true), 1000);
    EXPECT_EQ(plausibleDepthUnits(room(0.5, 1.4, 1000), 5000, true), 1000);
    EXPECT_FALSE(plausibleDepthUnits(room(0.8, 4, 1000), 1000, true));
    EXPECT_FALSE(plausibleDepthUnits(room(0.5, 1.4, 1000), 1000, true)) << "a table-top";
    EXPECT_FALSE(plausibleDepthUnits(room(0.5, 4, 5000), 5000, true));
}

TEST(DepthStatistics, statedUnitsAreDoubtedOnlyWhenTheyCannotBeRight) {
    EXPECT_FALSE(plausibleDepthUnits(room(0.2, 0.4, 5000), 5000, false)) << "a close-up";
    EXPECT_EQ(plausibleDepthUnits(room(0.4, 1.2, 1000), 5000, false), 1000) << "median 0.16 m";
    EXPECT_EQ(plausibleDepthUnits(room(1, 3, 10000), 1000, false), 5000) << "median 20 m";
    EXPECT_EQ(plausibleDepthUnits(room(1, 3, 100), 5000, false), 100);
    EXPECT_FALSE(plausibleDepthUnits(room(4, 25, 1000), 1000, false)) << "a street";
}

TEST(DepthStatistics, aStreetNeedsAGreaterMaximum) {
    EXPECT_FALSE(betterMaxDepth(summarize(room(1, 18, 500), 1.0 / 500)));
    EXPECT_NEAR(*betterMaxDepth(summarize(room(5, 80, 500), 1.0 / 500)), 77, 1.1);
}

}  // namespace
}  // namespace rgbd_graphslam
