#include "rgbd_graphslam/slam/local_mapper.h"

#include <gtest/gtest.h>

#include "exact_map.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

class LocalMapperTest : public testing::Test {
  protected:
    /** \param T_cam_world where tracking has put it; what tracking has found are all landmarks */
    int insert(int k, const SE3& T_cam_world, bool tracked = true) {
        SlamMap& map = exact_.map;
        const bool first = map.keyframes().empty();
        const int id = map.addKeyframe(exact_.view(ExactMap::truth(k)), T_cam_world);
        if (!first && tracked) map.addObservations(exact_.allLandmarks(), id);
        mapper_.insert(id);
        return id;
    }
    int insert(int k) { return insert(k, ExactMap::truth(k)); }
    std::size_t points() const { return exact_.points().size(); }

    const SlamOptions options_;
    ExactMap exact_;
    LocalMapper mapper_{options_, exact_.cameras, exact_.map};
};

TEST_F(LocalMapperTest, theFirstKeyframeMakesLandmarksOfItsDepth) {
    insert(0);
    mapper_.applyPendingAdjustment();
    ASSERT_EQ(exact_.map.aliveLandmarks(), points());
    for (const int id : exact_.allLandmarks()) {
        EXPECT_LT((exact_.map.landmark(id).position - exact_.points()[id]).norm(), 1e-4);
    }
}

TEST_F(LocalMapperTest, whatIsTrackedMakesNoSecondLandmark) {
    for (int k = 0; k < 3; ++k) {
        insert(k);
        mapper_.applyPendingAdjustment();
    }
    EXPECT_EQ(exact_.map.aliveLandmarks(), points());
}

TEST_F(LocalMapperTest, doubleLandmarksAreJoined) {
    insert(0);
    mapper_.applyPendingAdjustment();
    const int id = insert(1, ExactMap::truth(1), false);
    mapper_.applyPendingAdjustment();
    EXPECT_GT(exact_.map.aliveLandmarks(), points());
    std::vector<int> landmarks = exact_.map.keyframe(id).landmarks;
    mapper_.joinInto(0, landmarks);
    EXPECT_EQ(exact_.map.aliveLandmarks(), points());
}

TEST_F(LocalMapperTest, adjustmentComesIntoTheMapWhenAsked) {
    insert(0);
    mapper_.applyPendingAdjustment();
    const SE3 off(rotationExp({0.002, 0, 0}), {0.005, 0, 0});
    insert(1, off * ExactMap::truth(1));
    EXPECT_TRUE(mapper_.pending());
    const auto error = [&] { return exact_.map.T_cam_world(1).minus(ExactMap::truth(1)).norm(); };
    EXPECT_GT(error(), 4e-3);
    mapper_.applyPendingAdjustment();
    EXPECT_FALSE(mapper_.pending());
    EXPECT_LT(error(), 1e-3);
    EXPECT_EQ(mapper_.applyPendingAdjustment(), 0);
}

TEST_F(LocalMapperTest, keyframesThatShowNothingNewAreCulled) {
    for (int k = 0; k < 8; ++k) {
        insert(k);
        mapper_.applyPendingAdjustment();
    }
    EXPECT_FALSE(exact_.map.culled().empty());
    EXPECT_FALSE(exact_.map.keyframe(0).culled);
    EXPECT_FALSE(exact_.map.keyframe(7).culled);
}

TEST_F(LocalMapperTest, besideAFixedMapOnlyTheLatestKeyframesStay) {
    SlamOptions options;
    options.mapper.localization_keyframes = 2;
    exact_.add(0);
    exact_.map.freeze();
    LocalMapper mapper(options, exact_.cameras, exact_.map);
    for (int k = 1; k < 6; ++k) {
        const int id = exact_.map.addKeyframe(exact_.view(ExactMap::truth(k)), ExactMap::truth(k));
        exact_.map.addObservations(exact_.allLandmarks(), id);
        mapper.insert(id);
        mapper.applyPendingAdjustment();
    }
    int living = 0;
    for (int k = 1; k < 6; ++k) living += !exact_.map.keyframe(k).culled;
    EXPECT_LE(living, 2);
    EXPECT_FALSE(exact_.map.keyframe(0).culled);
}

}  // namespace
}  // namespace rgbd_graphslam
