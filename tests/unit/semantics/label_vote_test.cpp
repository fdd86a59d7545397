#include "rgbd_graphslam/semantics/label_vote.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

LabelVote votes(std::initializer_list<int> labels) {
    LabelVote vote;
    for (const int label : labels) vote.add(label, 1);
    return vote;
}

TEST(LabelVote, theMajorityWins) {
    EXPECT_EQ(LabelVote().best(), 0);
    EXPECT_EQ(votes({4}).best(), 4);
    EXPECT_EQ(votes({4, 7, 7}).best(), 7);
    EXPECT_EQ(votes({1, 2, 3, 4, 4, 5, 4}).best(), 4);
}

TEST(LabelVote, oneImageIsTrustedAsFarAsItIsRight) {
    EXPECT_NEAR(votes({3}).confidence(0.8, 10), 0.8, 1e-6);
    EXPECT_NEAR(votes({3}).confidence(0.6, 2), 0.6, 1e-6);
    EXPECT_EQ(LabelVote().confidence(0.8, 10), 0);
}

TEST(LabelVote, agreementMakesSureAndContradictionDoesNot) {
    // Of two images that say 1 and one that says 2: odds (0.8 / (0.2 / 9)) to 1, by Bayes' rule.
    const double odds = 0.8 * 9 / 0.2;
    EXPECT_NEAR(votes({1, 1, 2}).confidence(0.8, 10), odds * odds / (odds * odds + odds + 8), 1e-6);
    EXPECT_GT(votes({1, 1, 1}).confidence(0.8, 10), 0.999);
    EXPECT_NEAR(votes({1, 2}).confidence(0.8, 10), 0.5, 0.1);
}

TEST(LabelVote, sharesCountAsSuch) {
    LabelVote vote;
    vote.add(1, 0.25F);
    vote.add(2, 0.75F);
    EXPECT_EQ(vote.best(), 2);
    EXPECT_FLOAT_EQ(vote.votes(), 1);
}

}  // namespace
}  // namespace rgbd_graphslam
