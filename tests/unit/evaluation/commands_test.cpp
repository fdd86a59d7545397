#include "rgbd_graphslam/evaluation/commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "../../support/made_trajectories.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
using testing::HasSubstr;
namespace fs = std::filesystem;

class Commands : public testing::Test {
  protected:
    std::string file(const std::string& name) const { return folder_ / name; }
    std::string with(const std::string& name, const Trajectory& path) const {
        folder_.write(name, toTumText(path));
        return file(name);
    }
    TestFolder folder_;
};

TEST_F(Commands, ateOfSeveralEstimatesInOneTableWithPlots) {
    AteRequest request;
    request.files = {with("good.txt", circle()), with("shrunk.txt", scaled(circle(), 0.9)),
                     with("truth.txt", circle())};
    request.format = ReportFormat::Csv;
    request.plot = file("paths.svg");
    request.errors_plot = file("errors.svg");
    request.distribution_plot = file("distribution.svg");
    const std::string text = runAte(request);
    EXPECT_THAT(text, HasSubstr("\ngood,101,101,101,0.000000"));
    EXPECT_THAT(text, HasSubstr("\nshrunk,101,101,101,0.1"));
    for (const auto& plot : {request.plot, request.errors_plot, request.distribution_plot}) {
        EXPECT_TRUE(fs::exists(plot)) << plot;
    }
}

TEST_F(Commands, estimatesOfOneNameAreToldApart) {
    RpeRequest request;
    request.files = {with("a/trajectory.txt", circle()), with("b/trajectory.txt", circle()),
                     with("truth.txt", circle())};
    request.format = ReportFormat::Csv;
    EXPECT_THAT(runRpe(request), HasSubstr("\n" + file("b/trajectory.txt") + ","));
}

TEST_F(Commands, errorsNameTheEstimate) {
    AteRequest request;
    request.files = {with("late.txt", delayed(circle(), 99)), with("truth.txt", circle())};
    try {
        runAte(request);
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("late.txt: 0 poses match"));
    }
    request.files.pop_back();
    EXPECT_THROW(runAte(request), Error);
}

TEST_F(Commands, theTruthOfARawlogThatIsNoneIsAnError) {
    AteRequest request;
    request.files = {with("a.txt", circle()), with("truth.rawlog", circle())};
    EXPECT_THROW(runAte(request), Error);
}

TEST_F(Commands, mapIsMovedAsItsTrajectory) {
    PlyModel surface;
    surface.vertices = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}};
    surface.triangles = {{0, 1, 2}};
    PlyModel map;
    for (const auto& p : {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(2, 1, 0.01)}) {
        map.vertices.push_back((someMotion() * p).cast<float>());
    }
    MapRequest request;
    request.map = file("map.ply");
    request.surface = file("surface.ply");
    writePly(request.map, map);
    writePly(request.surface, surface);
    request.estimate = with("estimate.txt", moved(circle(), someMotion()));
    request.truth = with("truth.txt", circle());
    EXPECT_THAT(runMap(request), HasSubstr("distance_to_surface.mean 0.005000 m\n"));
}

TEST_F(Commands, pairsOfImagesNeedPoses) {
    PointCloudRequest request;
    request.pairs = file("pairs.txt");
    request.output = file("cloud.ply");
    EXPECT_THROW(runPointCloud(request), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
