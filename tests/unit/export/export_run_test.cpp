#include <gmock/gmock.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/export/exporter.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

/** A run folder with a trajectory alone. */
class ExportRun : public testing::Test {
  protected:
    ExportRun() {
        poses_.push_back({1305031453.359684,
                          SE3(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), Eigen::Vector3d(1, 2, 3))});
        poses_.push_back({1305031453.393017, SE3(Eigen::Quaterniond(0.1, -0.7, 0.2, 0.6),
                                                 Eigen::Vector3d(-1, 0.25, 1.5))});
        folder_.write("run/trajectory.txt", toTumText(poses_));
    }

    std::vector<ExportedFile> write(const std::string& format, const std::string& output = "") {
        return exportRun(folder_ / "run", {format}, {}, output);
    }

    TestFolder folder_;
    Trajectory poses_;
};

TEST_F(ExportRun, writesKittiRelativeToTheFirstCamera) {
    write("kitti");
    std::ifstream in(folder_ / "run/export/trajectory_kitti.txt");
    for (const StampedPose& pose : poses_) {
        const SE3 expected = poses_[0].T_world_cam.inverse() * pose.T_world_cam;
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 4; ++column) {
                double value = 99;
                ASSERT_TRUE(in >> value);
                EXPECT_NEAR(value, column < 3 ? expected.R(row, column) : expected.t(row), 1e-7);
            }
        }
    }
    double more = 0;
    EXPECT_FALSE(in >> more);
}

TEST_F(ExportRun, writesEurocStampsToTheNanosecond) {
    write("euroc");
    std::istringstream in(readText(folder_ / "run/export/trajectory_euroc.csv"));
    std::string line;
    std::getline(in, line);
    EXPECT_THAT(line, testing::StartsWith("#timestamp [ns],p_RS_R_x [m]"));
    std::getline(in, line);
    EXPECT_EQ(line,
              "1305031453359684000,1.000000000,2.000000000,3.000000000,0.500000000,0.500000000,"
              "-0.500000000,0.500000000");
}

TEST_F(ExportRun, writesTheSameTrajectoryInTumsFormat) {
    write("tum", folder_ / "copy.txt");
    EXPECT_EQ(readText(folder_ / "copy.txt"), readText(folder_ / "run/trajectory.txt"));
}

TEST_F(ExportRun, writesIntoAFolderThatIsThere) {
    fs::create_directory(folder_ / "there");
    EXPECT_EQ(write("tum", folder_ / "there")[0].path, folder_ / "there/trajectory_tum.txt");
    const auto both = exportRun(folder_ / "run", {"tum", "kitti", "tum"}, {}, folder_ / "new");
    EXPECT_EQ(both.size(), 2u);
    EXPECT_TRUE(fs::exists(folder_ / "new/trajectory_kitti.txt"));
}

/** Two cameras with the same stamps, the second one's images brighter. */
TEST_F(ExportRun, takesTheImagesOfTheCameraThatWasTracked) {
    const CameraSetup setup;
    const cv::Size size(setup.camera.width, setup.camera.height);
    writeRawlog(folder_ / "a.rawlog", RawlogStorage::Embedded, [&](RawlogWriter& writer) {
        for (const StampedPose& pose : poses_) {
            for (const auto& [label, gray] : {std::pair("FRONT", 40), std::pair("REAR", 200)}) {
                const auto frame = makeRgbdObservation(setup, pose.stamp_s);
                setColor(*frame, cv::Mat(size, CV_8UC3, cv::Scalar::all(gray)));
                setDepth(*frame, cv::Mat(size, CV_16UC1, cv::Scalar(5000)));
                frame->sensorLabel = label;
                writer.write(*frame);
            }
        }
    });
    const std::string rawlog = R"("rawlog": ")" + folder_ / "a.rawlog" + "\"";
    folder_.write("run/keyframes.txt", toTumText(poses_));
    folder_.write("run/summary.json", "{" + rawlog +
                                          R"(, "sensor": "REAR", "earlier_sessions": [{)" + rawlog +
                                          R"(, "keyframes": 1, "sensor": "FRONT"}]})");
    savePly(folder_ / "run/points.ply", PointMap{{Eigen::Vector3f(0, 0, 1), {1, 2, 3}}});
    write("nerfstudio", folder_ / "scene");
    const auto grayOf = [&](const char* name) {
        return cv::mean(cv::imread(folder_ / (std::string("scene/images/") + name)))[0];
    };
    EXPECT_NEAR(grayOf("frame_000000.jpg"), 40, 2);
    EXPECT_NEAR(grayOf("frame_000001.jpg"), 200, 2);
}

TEST_F(ExportRun, doesNotReplaceAFolderOfSomeoneElse) {
    folder_.write("mine/nerfstudio/thesis.txt", "years of work");
    folder_.write("run/points.ply", "");
    EXPECT_THAT(problemOf([&] { write("nerfstudio", folder_ / "mine"); }),
                HasSubstr("nerfstudio' already exists"));
    EXPECT_TRUE(fs::exists(folder_ / "mine/nerfstudio/thesis.txt"));
}

/** Puts a program of that text first on the PATH. */
void installSm2mm(const TestFolder& folder, const std::string& text) {
    folder.write("bin/sm2mm", "#!/bin/sh\n" + text);
    fs::permissions(folder / "bin/sm2mm", fs::perms::owner_all);
    setenv("PATH", (folder / "bin" + ":/usr/bin:/bin").c_str(), 1);
}

TEST_F(ExportRun, hasMetricMapsMadeBySm2mm) {
    folder_.write("run/map.simplemap", "keyframes");
    const std::string output = folder_ / "it's a map.mm";
    installSm2mm(folder_, "[ \"$1$3\" = -i-o ] && cp \"$2\" \"$4\"\n");
    write("mm", output);
    EXPECT_EQ(readText(output), "keyframes");
    installSm2mm(folder_, "exit 3\n");
    EXPECT_THAT(problemOf([&] { write("mm", output); }), HasSubstr("sm2mm ended with code 3"));
    EXPECT_EQ(readText(output), "keyframes");
    fs::remove(folder_ / "bin/sm2mm");
    setenv("PATH", (folder_ / "bin").c_str(), 1);
    EXPECT_THAT(problemOf([&] { write("mm", output); }), HasSubstr("mp2p_icp (not part of Debian"));
}

TEST_F(ExportRun, writesABagOfPosesWhereThereAreNoMaps) {
    const WarningRecord record;
    EXPECT_EQ(write("ros2")[0].summary, "2 poses");
    ASSERT_EQ(record.warnings().size(), 1u);
    EXPECT_THAT(record.warnings()[0], HasSubstr("with: rgbd-map " + folder_ / "run"));
    const std::string bag = readText(folder_ / "run/export/run.mcap");
    EXPECT_THAT(bag, HasSubstr("/path"));
    EXPECT_EQ(bag.find("/points"), std::string::npos);
}

TEST_F(ExportRun, takesTheMapThatARunWasLocalizedIn) {
    folder_.write("map/keyframes.txt", toTumText(poses_));
    folder_.write("run/summary.json", "{\"map\": {\"folder\": \"../map\", \"use\": \"localize\"}}");
    const WarningRecord record;
    EXPECT_EQ(write("ros2")[0].summary, "2 poses");
    ASSERT_EQ(record.warnings().size(), 1u);
    EXPECT_THAT(record.warnings()[0], HasSubstr("run/../map' has no maps"));
}

TEST_F(ExportRun, namesWhatIsMissingAndHowToGetIt) {
    const auto problem = [&](const std::string& format) {
        return problemOf([&] { write(format); });
    };
    EXPECT_THAT(problem("nerfstudio"),
                HasSubstr("has no points.ply; make the maps with: rgbd-map"));
    EXPECT_THAT(problem("colmap"), HasSubstr("keyframes.txt"));
    EXPECT_THAT(problem("glb"), HasSubstr("has no mesh.ply; make it with: rgbd-map"));
    EXPECT_THAT(problem("obj"), HasSubstr("--mesh 0.02"));
    EXPECT_THAT(problem("g2o"), HasSubstr("graph.graph"));
    EXPECT_THAT(problem("mm"), HasSubstr("has no map.simplemap"));
    EXPECT_THAT(problem("fbx"), HasSubstr("'fbx' is not a known format; use one of nerfstudio"));
    EXPECT_THAT(problemOf([&] { exportRun(folder_ / "none", {"tum"}, {}, ""); }),
                HasSubstr("is not a folder"));
    EXPECT_FALSE(fs::exists(folder_ / "run/export/mesh.glb"));
    for (const auto& entry : fs::directory_iterator(folder_ / "run/export"))
        ADD_FAILURE() << entry.path() << " was left behind";
}

}  // namespace
}  // namespace rgbd_graphslam
