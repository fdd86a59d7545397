#include "rgbd_graphslam/evaluation/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "../../support/made_trajectories.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/evaluation/gnuplot.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;
namespace fs = std::filesystem;

class Plots : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = parent_ / "it's a folder";
        fs::create_directories(folder_);
    }
    std::string file(const std::string& name) const { return folder_ / name; }
    std::string content(const std::string& name) const { return readText(file(name)); }
    std::size_t fileCount() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }
    TestFolder parent_;
    fs::path folder_;
};

EvaluatedAte evaluated(const std::string& label) {
    auto estimate = circle();
    for (auto& pose : estimate) pose.T_world_cam.t *= 1.01;
    return {label, estimate, evaluateAte(estimate, circle())};
}

TEST_F(Plots, trajectoriesAsSvgWithLegendAndAxes) {
    plotTrajectories(circle(), {evaluated("my_estimate")}, PlotPlane::XZ, file("a.svg"));
    EXPECT_THAT(content("a.svg"),
                testing::AllOf(HasSubstr("<svg"), HasSubstr("my_estimate"), HasSubstr("truth"),
                               HasSubstr("difference"), HasSubstr("x (m)"), HasSubstr("z (m)")));
}

TEST_F(Plots, trajectoriesAsPng) {
    plotTrajectories(circle(), {evaluated("a"), evaluated("b")}, PlotPlane::XY, file("a.png"));
    EXPECT_EQ(content("a.png").substr(1, 3), "PNG");
}

TEST_F(Plots, aTrajectoryThatStandsStill) {
    Trajectory still = circle();
    for (auto& pose : still) pose.T_world_cam.t = {1, 2, 3};
    plotTrajectories(still, {{"still", still, evaluateAte(still, still)}}, PlotPlane::XY,
                     file("a.svg"));
    EXPECT_THAT(content("a.svg"), HasSubstr("still"));
}

TEST_F(Plots, errorsOverTimeAndTheirDistribution) {
    const auto panels = errorPanels(std::vector<EvaluatedAte>{evaluated("one"), evaluated("two")});
    plotErrorsOverTime(panels, file("time.svg"));
    EXPECT_THAT(content("time.svg"), testing::AllOf(HasSubstr("time (s)"), HasSubstr("two")));
    plotErrorDistribution(panels, file("share.svg"));
    EXPECT_THAT(content("share.svg"), HasSubstr("translational error (m)"));
}

TEST_F(Plots, relativeErrorsHaveTwoPanels) {
    const auto rpe = evaluateRpe(straight(1.02, 0.1), straight(1, 0));
    const auto panels = errorPanels({{"drift", rpe}}, ErrorPanel::Style::Points);
    plotErrorsOverTime(panels, file("time.svg"));
    plotErrorDistribution(panels, file("share.svg"));
    for (const char* name : {"time.svg", "share.svg"}) {
        EXPECT_THAT(content(name), testing::AllOf(HasSubstr("translational error (m)"),
                                                  HasSubstr("rotational error (deg)")));
    }
}

TEST_F(Plots, errorsThatAreAllZeroHaveADistribution) {
    const auto truth = circle();
    plotErrorDistribution(errorPanels({{"same", truth, evaluateAte(truth, truth)}}),
                          file("share.svg"));
    EXPECT_THAT(content("share.svg"), HasSubstr("same"));
}

TEST_F(Plots, gnuplotsRefusalIsAnErrorThatLeavesNothing) {
    Gnuplot plot(file("a.png"), 300, 200);
    plot.command("set nonsense");
    try {
        plot.draw();
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("nonsense"));
    }
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(Plots, otherEndingsAreRefused) {
    EXPECT_THROW(Gnuplot(file("a.gif"), 300, 200), Error);
    EXPECT_THROW(Gnuplot(file("png"), 300, 200), Error);
}

TEST_F(Plots, aMissingGnuplotIsNamed) {
    const std::string path = std::getenv("PATH");
    Gnuplot plot(file("a.png"), 300, 200);
    plot.command("plot x");
    setenv("PATH", folder_.c_str(), 1);
    std::string message;
    try {
        plot.draw();
    } catch (const Error& e) {
        message = e.what();
    }
    setenv("PATH", path.c_str(), 1);
    EXPECT_THAT(message, HasSubstr("gnuplot-nox"));
    EXPECT_EQ(fileCount(), 0u);
}

}  // namespace
}  // namespace rgbd_graphslam
