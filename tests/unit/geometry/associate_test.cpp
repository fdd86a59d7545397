#include "rgbd_graphslam/geometry/associate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace rgbd_graphslam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(Associate, closestPairsAreTakenFirstAndEachEntryOnce) {
    // 0.010 is nearest to both; 0.000 has to take what is left, which is too far.
    EXPECT_THAT(associate({0.000, 0.012}, {0.010, 0.021}, 0.02), ElementsAre(Pair(1, 0)));
    EXPECT_THAT(associate({0.000, 0.012}, {0.010, 0.019}, 0.02),
                ElementsAre(Pair(0, 1), Pair(1, 0)));
}

TEST(Associate, limitIsExclusive) {
    EXPECT_THAT(associate({0.0}, {0.5}, 0.5), IsEmpty());
    EXPECT_THAT(associate({0.0}, {0.5}, 0.500001), ElementsAre(Pair(0, 0)));
}

TEST(Associate, equalDifferencesGoToTheEarlierSoThatChainsPairCompletely) {
    EXPECT_THAT(associate({0, 2, 4}, {1, 3, 5}, 1.5),
                ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2)));
}

TEST(Associate, offsetIsAddedToTheSecondList) {
    EXPECT_THAT(associate({10, 11}, {0, 1}, 0.1, 10), ElementsAre(Pair(0, 0), Pair(1, 1)));
}

TEST(Associate, unsortedStampsComeOutInTimeOrderAndNanFindsNoPartner) {
    EXPECT_THAT(associate({3, std::nan(""), 1}, {1, 3, std::nan("")}, 0.1),
                ElementsAre(Pair(2, 0), Pair(0, 1)));
}

TEST(Associate, repeatedStampsAreDistinctEntries) {
    EXPECT_THAT(associate({1, 1}, {1, 1}, 0.1), ElementsAre(Pair(0, 0), Pair(1, 1)));
}

}  // namespace
}  // namespace rgbd_graphslam
