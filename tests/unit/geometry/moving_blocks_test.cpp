#include "rgbd_graphslam/geometry/moving_blocks.h"

#include <gtest/gtest.h>

#include <numeric>

namespace rgbd_graphslam {
namespace {

constexpr int width = 80, height = 60;

Camera smallCamera() {
    return Intrinsics{width, height, 65, 65, 39.5, 29.5, {}};
}

/** A wall 3 m ahead, and before it a box of 20 x 20 blocks whose left edge is at column `left`;
 *  nothing but the wall where that is negative. */
Sight wall(double stamp_s, int left = -1, float box_m = 2) {
    Sight sight;
    sight.stamp_s = stamp_s;
    sight.depth_m.assign(width * height, 3);
    for (int v = 20; left >= 0 && v < 40; ++v)
        for (int u = left; u < left + 20; ++u) sight.depth_m[v * width + u] = box_m;
    return sight;
}

std::vector<const Sight*> pointersTo(const std::vector<Sight>& sights) {
    std::vector<const Sight*> pointers;
    for (const Sight& sight : sights) pointers.push_back(&sight);
    return pointers;
}

int count(const std::vector<std::uint8_t>& mask) {
    return std::accumulate(mask.begin(), mask.end(), 0);
}

const MovingBlocks blocks(smallCamera(), {});

TEST(MovingBlocks, whatCameIntoFreeSpaceMoves) {
    const std::vector<Sight> others = {wall(0), wall(1), wall(2)};
    const auto mask = blocks.find(wall(4, 30), pointersTo(others));
    EXPECT_EQ(count(mask), 20 * 20);
    EXPECT_EQ(mask[30 * width + 40], 1);
}

TEST(MovingBlocks, whatWentAwayMovesInItsOldSight) {
    const std::vector<Sight> others = {wall(5), wall(6), wall(7)};
    EXPECT_EQ(count(blocks.find(wall(1, 30), pointersTo(others))), 20 * 20);
}

TEST(MovingBlocks, whatStaysDoesNotMove) {
    const std::vector<Sight> others = {wall(0, 30), wall(2, 30), wall(4, 30)};
    EXPECT_EQ(count(blocks.find(wall(6, 30), pointersTo(others))), 0);
}

TEST(MovingBlocks, oneSightAloneProvesNothing) {
    const std::vector<Sight> others = {wall(0)};
    EXPECT_EQ(count(blocks.find(wall(4, 30), pointersTo(others))), 0);
}

TEST(MovingBlocks, whatIsHiddenBehindAMoverStays) {
    const std::vector<Sight> others = {wall(0, 30), wall(0.5, 30), wall(1, 30)};
    EXPECT_EQ(count(blocks.find(wall(4), pointersTo(others))), 0);
}

TEST(MovingBlocks, noiseIsNoMotion) {
    std::vector<Sight> others = {wall(0), wall(2), wall(4)};
    Sight near = wall(6);
    for (std::size_t i = 0; i < near.depth_m.size(); i += 3) near.depth_m[i] -= 0.05f;
    EXPECT_EQ(count(blocks.find(near, pointersTo(others))), 0);
}

/** Half of it goes where nobody looked before: it is of one surface with the other half. */
TEST(MovingBlocks, seedsGrowOverTheirSurfaceButNotIntoTheFixedOne) {
    std::vector<Sight> others = {wall(0), wall(1), wall(2)};
    for (Sight& other : others)
        for (int v = 0; v < height; ++v)
            for (int u = 40; u < width; ++u) other.depth_m[v * width + u] = 0;
    EXPECT_EQ(count(blocks.find(wall(4, 30), pointersTo(others))), 20 * 20);
    // Leaning against the wall, it touches what three sights have found in place.
    others = {wall(0), wall(1), wall(2)};
    Sight touching = wall(4, 30);
    for (int u = 50; u < 60; ++u)
        for (int v = 20; v < 40; ++v) touching.depth_m[v * width + u] = 2.f + 0.1f * (u - 49);
    const int masked = count(blocks.find(touching, pointersTo(others)));
    EXPECT_GE(masked, 20 * 20);
    EXPECT_LE(masked, 30 * 20);
}

/** What an earlier recording looked through may have been put there since. */
TEST(MovingBlocks, laterRecordingsCountMore) {
    std::vector<Sight> earlier = {wall(0), wall(1), wall(2)}, later = earlier;
    for (Sight& sight : later) sight.session = 1;
    Sight moved = wall(4, 30);
    moved.session = 1;
    EXPECT_EQ(count(blocks.find(moved, pointersTo(earlier))), 0);
    moved.session = 0;
    EXPECT_EQ(count(blocks.find(moved, pointersTo(later))), 20 * 20);
}

TEST(MovingBlocks, comparesWithSightsOfTheSamePlaceSpreadOverTime) {
    std::vector<Sight> sights;
    for (int i = 0; i < 20; ++i) sights.push_back(wall(i));
    for (int i = 0; i < 20; i += 2) sights[i].T_world_cam.t.x() = 100;
    const auto found = blocks.overlapping(wall(19), pointersTo(sights), 3);
    ASSERT_EQ(found.size(), 3u);
    for (const Sight* sight : found) {
        EXPECT_EQ(sight->T_world_cam.t.x(), 0);
        EXPECT_NE(sight->stamp_s, 19) << "no comparison with itself";
    }
    EXPECT_LT(found[0]->stamp_s, 6);
    EXPECT_GT(found[2]->stamp_s, 9);
}

}  // namespace
}  // namespace rgbd_graphslam
