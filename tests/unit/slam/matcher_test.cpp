#include "rgbd_graphslam/slam/matcher.h"

#include <gtest/gtest.h>

#include "rgbd_graphslam/slam/place_index.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

Frame twoKeypoints(const Descriptor& near, const Descriptor& far) {
    Frame frame;
    frame.keypoints = {{100, 100, 1, 0, 0}, {104, 100, 1, 0, 0}};
    frame.descriptors = {near, far};
    frame.grid = KeypointGrid(frame.keypoints, 640, 480);
    return frame;
}

TEST(MatchTable, findsTheNearestDescriptorInTheWindowOnly) {
    const Descriptor zero{}, ones{~0ull, 0, 0, 0};
    const Frame frame = twoKeypoints(ones, zero);
    MatchTable table(frame);
    table.search(7, zero, {100, 100, 10, 0, 0}, 64, 0.9f);
    ASSERT_EQ(table.matches().size(), 1u);
    EXPECT_EQ(table.matches()[0], std::make_pair(1, 7));
    MatchTable narrow(frame);
    narrow.search(7, zero, {100, 100, 2, 0, 0}, 63, 0.9f);
    EXPECT_TRUE(narrow.matches().empty());
    MatchTable other_octave(frame);
    other_octave.search(7, zero, {100, 100, 10, 1, 2}, 256, 1);
    EXPECT_TRUE(other_octave.matches().empty());
}

TEST(MatchTable, leavesAmbiguousAndReservedKeypointsAlone) {
    const Descriptor zero{}, one{1, 0, 0, 0};
    const Frame frame = twoKeypoints(zero, one);
    MatchTable ambiguous(frame);
    ambiguous.search(7, Descriptor{2, 0, 0, 0}, {100, 100, 10, 0, 0}, 64, 0.4f);
    EXPECT_TRUE(ambiguous.matches().empty());
    MatchTable reserved(frame);
    reserved.reserve(0);
    reserved.search(7, zero, {100, 100, 10, 0, 0}, 64, 0.9f);
    ASSERT_EQ(reserved.matches().size(), 1u);
    EXPECT_EQ(reserved.matches()[0].first, 1);
}

TEST(MatchTable, nearerPointWinsAContestedKeypoint) {
    const Descriptor zero{}, one{1, 0, 0, 0}, three{7, 0, 0, 0}, far{~0ull, ~0ull, 0, 0};
    const Frame frame = twoKeypoints(zero, far);
    MatchTable table(frame);
    table.search(1, three, {100, 100, 10, 0, 0}, 64, 0.9f);
    table.search(2, one, {100, 100, 10, 0, 0}, 64, 0.9f);
    table.search(3, three, {100, 100, 10, 0, 0}, 64, 0.9f);
    ASSERT_EQ(table.matches().size(), 1u);
    EXPECT_EQ(table.matches()[0].second, 2);
}

TEST(MatchMutually, pairsTwoViewsOfOneWorld) {
    SyntheticWorld world;
    const Camera camera;
    const Frame a = world.view(onCircle(0), 0, camera), b = world.view(onCircle(0.1), 1, camera);
    const auto pairs = matchMutually(a.descriptors, b.descriptors, 64, 0.8f);
    EXPECT_GT(pairs.size(), 200u);
}

TEST(PlaceIndex, votesForTheKeyframesOfThePlace) {
    SyntheticWorld world(40000);
    const Camera camera;
    PlaceIndex index(40);
    constexpr int places = 60;
    for (int k = 0; k < places; ++k) {
        index.insert(k, world.view(onCircle(2 * 3.14159 * k / places), k, camera).descriptors);
    }
    for (const int k : {0, 17, 42}) {
        const auto votes =
            index.query(world.view(onCircle(2 * 3.14159 * k / places), 0, camera).descriptors);
        ASSERT_FALSE(votes.empty());
        const int apart = std::abs(votes[0].keyframe - k);
        EXPECT_LE(std::min(apart, places - apart), 1) << "place " << k;
    }
    SyntheticWorld elsewhere(12000, 99);
    const auto votes = index.query(elsewhere.view(onCircle(0), 0, camera).descriptors);
    EXPECT_TRUE(votes.empty() || votes[0].votes < 15);
}

}  // namespace
}  // namespace rgbd_graphslam
