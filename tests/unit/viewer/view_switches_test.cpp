#include "rgbd_graphslam/viewer/view_switches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using S = ViewerSettings;

RunData fullRun() {
    RunData run;
    run.rawlog = "a.rawlog";
    run.trajectory = run.keyframes = run.keyframes_before_loops = run.truth = {{0, {}}, {1, {}}};
    run.loops = run.covisibility = {{0, 1}};
    run.points.resize(1);
    run.mesh.triangles.resize(1);
    run.octree.occupied.resize(1);
    run.grid = GridMap();
    return run;
}

TEST(ViewSwitches, allAreOfferedForARunThatHasEverything) {
    for (const ViewSwitch& entry : viewSwitches())
        EXPECT_THAT(whyNothingToShow(entry.field, contentsOf(fullRun())), IsEmpty()) << entry.name;
}

TEST(ViewSwitches, aMissingMapIsNamedWithTheCommandThatMakesIt) {
    RunData run = fullRun();
    run.mesh = {};
    run.octree = {};
    const RunContents contents = contentsOf(run);
    EXPECT_THAT(whyNothingToShow(&S::mesh, contents), HasSubstr("rgbd-map OUT --mesh 0.02"));
    EXPECT_THAT(whyNothingToShow(&S::octree, contents), HasSubstr("rgbd-map OUT"));
    EXPECT_THAT(whyNothingToShow(&S::free_space, contents), HasSubstr("rgbd-map OUT"));
    EXPECT_THAT(whyNothingToShow(&S::grid, contents), IsEmpty());
}

TEST(ViewSwitches, pointsOfTheRecordingStandInForAMissingMap) {
    RunData run = fullRun();
    run.points.clear();
    EXPECT_THAT(whyNothingToShow(&S::points, contentsOf(run)), IsEmpty());
    run.rawlog.clear();
    EXPECT_THAT(whyNothingToShow(&S::points, contentsOf(run)), HasSubstr("recording is gone"));
}

TEST(ViewSwitches, theCeilingStaysWhereUpIsAGuess) {
    RunData run = fullRun();
    run.up_is_guessed = true;
    EXPECT_THAT(whyNothingToShow(&S::cut_ceiling, contentsOf(run)), HasSubstr("guess"));
}

TEST(ViewSwitches, aRunningSlamPromisesWhatComesAtItsEnd) {
    EXPECT_THAT(whyNothingToShow(&S::mesh, liveContents()), HasSubstr("when the run has ended"));
    EXPECT_THAT(whyNothingToShow(&S::truth, liveContents()), HasSubstr("when the run has ended"));
    EXPECT_THAT(whyNothingToShow(&S::loops, liveContents()), IsEmpty());
}

TEST(ViewSwitches, eachHasAKeyOfItsOwn) {
    std::set<std::string> keys;
    for (const ViewSwitch& entry : viewSwitches()) {
        const bool is_new = !*entry.key || keys.insert(entry.key).second;
        EXPECT_TRUE(is_new) << entry.key;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
