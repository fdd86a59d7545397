#include "rgbd_graphslam/evaluation/consistency.h"

#include <gmock/gmock.h>

#include "../../support/made_trajectories.h"
#include "../../support/random_inputs.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr double sigma_m = 0.01, sigma_rad = 0.004;

/** Sum of twelve uniforms. */
double gauss(RandomInputs& random) {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
    return sum;
}

/** Poses in another world, with errors of sigma_m and sigma_rad in their own axes.
 *  \param claimed what they are said to be, as a factor */
std::vector<ClaimedPose> claimsOf(const Trajectory& truth, double claimed) {
    RandomInputs random(3);
    std::vector<ClaimedPose> claims;
    for (const StampedPose& pose : truth) {
        ClaimedPose claim;
        claim.stamp_s = pose.stamp_s;
        claim.believed = true;
        Vector6d error;
        for (int i = 0; i < 6; ++i) error[i] = (i < 3 ? sigma_m : sigma_rad) * gauss(random);
        const SE3 off(rotationExp(error.tail<3>()), error.head<3>());
        claim.T_world_cam = someMotion() * pose.T_world_cam * off;
        claim.sigma.head<3>().setConstant(claimed * sigma_m);
        claim.sigma.tail<3>().setConstant(claimed * sigma_rad);
        claims.push_back(claim);
    }
    return claims;
}

TEST(Consistency, trueClaimsAreConfirmed) {
    const auto result = evaluateConsistency(claimsOf(circle(2001), 1), circle(2001));
    EXPECT_EQ(result.believed, 2001u);
    EXPECT_NEAR(result.nees, 6, 0.4);
    EXPECT_NEAR(result.nees_in_band, 0.95, 0.02);
    EXPECT_GT(result.within_3_sigma, 0.97);
    EXPECT_LT(result.worst_m, 6 * sigma_m);
}

TEST(Consistency, claimsThatAreTooSmallOrTooLargeStandOut) {
    const auto small = evaluateConsistency(claimsOf(circle(), 0.25), circle());
    EXPECT_GT(small.nees, 60);
    EXPECT_LT(small.within_3_sigma, 0.2);
    const auto large = evaluateConsistency(claimsOf(circle(), 5), circle());
    EXPECT_LT(large.nees, 0.5);
    EXPECT_LT(large.nees_in_band, 0.2);
}

TEST(Consistency, aJumpCountsOnlyWhereBothFramesAreBelieved) {
    auto claims = claimsOf(circle(), 1);
    claims[50].T_world_cam.t.x() += 1;
    EXPECT_NEAR(evaluateConsistency(claims, circle()).largest_jump_m, 1, 0.1);
    EXPECT_GT(evaluateConsistency(claims, circle()).worst_m, 0.9);
    claims[50].believed = false;
    EXPECT_LT(evaluateConsistency(claims, circle()).largest_jump_m, 0.1);
    EXPECT_LT(evaluateConsistency(claims, circle()).worst_m, 0.1);
}

TEST(Consistency, aCameraThatStandsStillHasErrorsToo) {
    Trajectory still = circle();
    for (StampedPose& pose : still) pose.T_world_cam = SE3();
    const auto result = evaluateConsistency(claimsOf(still, 1), still);
    EXPECT_NEAR(result.nees, 6, 1);
    EXPECT_LT(result.worst_rad, 6 * sigma_rad);
}

TEST(Consistency, refusesWhatHasNoTruth) {
    EXPECT_THROW(evaluateConsistency(claimsOf(circle(), 1), delayed(circle(), 100)), Error);
}

const char* const titles =
    "stamp_s,origin,inliers,keyframe,part,std_x_m,std_y_m,std_z_m,std_rot_x_rad,std_rot_y_rad,"
    "std_rot_z_rad\n";

TEST(Consistency, readsARunsFolder) {
    const TestFolder run;
    run.write("trajectory.txt", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
    run.write("frames.csv", std::string(titles) + "1,tracked,99,0,0,0.1,0.2,0.3,0.4,0.5,0.6\n" +
                                "1.5,lost,0,,,,,,,,\n" +
                                "2,uncertain,30,,0,0.1,0.2,0.3,0.4,0.5,0.6\n");
    const auto claims = readClaimedPoses(run / "");
    ASSERT_EQ(claims.size(), 2u);
    EXPECT_TRUE(claims[0].believed);
    EXPECT_FALSE(claims[1].believed);
    EXPECT_EQ(claims[1].T_world_cam.t.x(), 1);
    EXPECT_EQ(claims[1].sigma[5], 0.6);
}

/** The truth errs, too: half of the claimed standard deviation is the run's, the rest the truth's.
 */
TEST(Consistency, errorsOfTheTruthAreNoErrorsOfTheRun) {
    const Trajectory truth = circle(2001);
    const auto claims = claimsOf(truth, 0.5);
    const double rest = std::sqrt(0.75);
    const auto without = evaluateConsistency(claims, truth);
    const auto with = evaluateConsistency(claims, truth, {rest * sigma_m, rest * sigma_rad});
    EXPECT_NEAR(without.nees, 24, 2);
    EXPECT_NEAR(with.nees, 6, 0.4);
}

TEST(Consistency, namesTheLineThatIsDamaged) {
    const TestFolder run;
    run.write("trajectory.txt", "1 0 0 0 0 0 0 1\n");
    for (const char* line :
         {"1,tracked,99,0,0,0.1,0.2,0.3,x,0.5,0.6\n", "1,tracked,99,0,0,0.1,0.2,0.3,-1,0.5,0.6\n",
          "1,tracked,99,0,0,0.1,0.2,0.3,1e999,0.5,0.6\n"}) {
        run.write("frames.csv", std::string(titles) + line);
        try {
            readClaimedPoses(run / "");
            ADD_FAILURE() << line;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), testing::HasSubstr("frames.csv:2")) << line;
        }
    }
    run.write("frames.csv", "stamp_s,origin,inliers,keyframe,part\n1,tracked,99,0,0\n");
    EXPECT_THROW(readClaimedPoses(run / ""), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
