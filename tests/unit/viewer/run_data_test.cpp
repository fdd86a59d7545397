#include "rgbd_graphslam/viewer/run_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/run_folder.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class RunFolder : public testing::Test {
  protected:
    RunFolder() {
        fs::create_directories(folder_);
        write("trajectory.txt", toTumText(poses(6)));
        write("truth.txt", toTumText(poses(4)));
        write("keyframes.txt", toTumText(poses(3)));
        write("summary.json",
              R"({"rawlog": "gone.rawlog", "loop_edges": [[2, 0, 40], [9, 0, 1]]})");
        write("frames.csv", "stamp_s,origin,inliers,keyframe\n1.0,tracked,80,0\n3.5,lost,0,\n");
        write("frame_times.csv", "stamp_s,wall_ms\n1.0,6.5\n2.0,30\n");
        write("covisibility.csv", "from,to,landmarks\n0,2,30\n0,1,20\n");
    }
    ~RunFolder() override { fs::remove_all(folder_); }

    static Trajectory poses(int n) {
        Trajectory list;
        for (int i = 0; i < n; ++i)
            list.push_back({1.0 + i, SE3(Eigen::Matrix3d::Identity(), {0.1 * i, 0, 1})});
        return list;
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }
    void write(const char* name, const std::string& text) const {
        std::ofstream(path(name)) << text;
    }
    /** \return what was warned of */
    std::string load(RunData& run) const {
        testing::internal::CaptureStderr();
        run = loadRun(folder_.string());
        return testing::internal::GetCapturedStderr();
    }

    fs::path folder_ = fs::path(testing::TempDir()) / ("rgbd-run-data-" + std::to_string(getpid()));
};

TEST_F(RunFolder, isReadWithoutItsRecordingAndMaps) {
    RunData run;
    EXPECT_THAT(load(run), testing::HasSubstr("gone.rawlog"));
    EXPECT_EQ(run.trajectory.size(), 6U);
    EXPECT_EQ(run.keyframes.size(), 3U);
    EXPECT_TRUE(run.rawlog.empty());
    EXPECT_EQ(run.truth.size(), 4U);
    EXPECT_TRUE(run.points.empty());
    ASSERT_EQ(run.loops.size(), 1U);  // the other names a keyframe that does not exist
    EXPECT_EQ(run.loops[0].from, 2);
    ASSERT_EQ(run.covisibility.size(), 2U);
    EXPECT_EQ(run.covisibility[0].to, 1);  // by the later keyframe
    ASSERT_EQ(run.frames.size(), 2U);
    EXPECT_EQ(run.frames[0].inliers, 80);
    EXPECT_TRUE(run.frames[1].lost);
    EXPECT_EQ(run.unplaced_s, std::vector<double>{3.5});
    EXPECT_EQ(run.frame_times_ms, (std::vector<float>{6.5f, 30}));
}

TEST_F(RunFolder, aLocalizedRunComesWithItsMap) {
    const fs::path later = folder_ / "later";
    fs::create_directories(later);
    savePly(path("points.ply"), {{{1, 2, 3}, {4, 5, 6}}});
    write("later/trajectory.txt", toTumText(poses(2)));
    write("later/frames.csv", "stamp_s,origin,inliers,keyframe\n1.0,tracked,70,0\n9.0,lost,0,\n");
    write("later/summary.json",
          R"({"rawlog": "later.rawlog", "map": {"folder": "..", "use": "localize"}})");
    const RunData run = loadRun(later.string());
    EXPECT_EQ(run.folder, later.string());
    EXPECT_EQ(run.trajectory.size(), 2U);
    EXPECT_EQ(run.keyframes.size(), 3U);
    EXPECT_EQ(run.points.size(), 1U);
    EXPECT_EQ(run.unplaced_s, std::vector<double>{9.0});
    ASSERT_EQ(run.frames.size(), 2U);
    EXPECT_EQ(run.frames[0].inliers, 70);
    EXPECT_TRUE(run.truth.empty());
    EXPECT_THROW(readRunFolder(later.string(), ""), Error);  // of which no map can be made
    write("later/summary.json", R"({"map": {"folder": "/no/such/map", "use": "localize"}})");
    EXPECT_THROW(loadRun(later.string()), Error);
    write("later/summary.json", R"({"map": {"folder": 7, "use": "localize"}})");
    EXPECT_THROW(loadRun(later.string()), Error);
    write("later/summary.json", R"({"map": {"folder": "..", "use": 7}})");
    EXPECT_THROW(loadRun(later.string()), Error);  // then it should have keyframes
}

TEST_F(RunFolder, damagedMapsAreNamedAndTheRestIsShown) {
    savePly(path("points.ply"), {{{1, 2, 3}, {4, 5, 6}}});
    write("octree.ot", "no octree");
    write("grid.gridmap.gz", "no grid");
    write("covisibility.csv", "from,to,landmarks\n0,7,30\n");
    RunData run;
    const std::string warnings = load(run);
    EXPECT_THAT(warnings, testing::HasSubstr("octree.ot"));
    EXPECT_THAT(warnings, testing::HasSubstr("grid.gridmap.gz"));
    EXPECT_THAT(warnings, testing::HasSubstr("covisibility.csv"));
    EXPECT_EQ(run.points.size(), 1U);
    EXPECT_TRUE(run.covisibility.empty());
    EXPECT_FALSE(run.grid);
}

TEST_F(RunFolder, cellsAreOccupiedOrFree) {
    octomap::ColorOcTree tree(0.1);
    for (int i = 0; i < 3; ++i) tree.updateNode(octomap::point3d(1, 2, 0.55f), true);
    tree.updateNode(octomap::point3d(1, 2, 0.25f), false);
    tree.updateInnerOccupancy();
    saveColorOcTree(path("octree.ot"), tree);
    RunData run;
    load(run);
    ASSERT_EQ(run.octree.occupied.size(), 1U);
    ASSERT_EQ(run.octree.free.size(), 1U);
    EXPECT_NEAR(run.octree.occupied[0].center.z(), 0.55, 1e-5);
    EXPECT_NEAR(run.octree.free[0].center.z(), 0.25, 1e-5);
}

TEST_F(RunFolder, whatIsNoRunIsRefused) {
    EXPECT_THROW(loadRun(path("nothing")), Error);
    fs::remove(path("keyframes.txt"));
    EXPECT_THROW(loadRun(folder_.string()), Error);
}

PlyModel triangle() {
    PlyModel mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.colors = {{200, 30, 20}, {200, 30, 20}, {200, 30, 20}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

TEST_F(RunFolder, meshIsReadWhereThereIsOne) {
    RunData run;
    load(run);
    EXPECT_TRUE(run.mesh.triangles.empty());
    writePly(path("mesh.ply"), triangle());
    load(run);
    EXPECT_EQ(run.mesh.triangles.size(), 1U);
    EXPECT_EQ(loadRun(path("mesh.ply")).mesh.triangles.size(), 1U);
    write("mesh.ply", "ply");
    EXPECT_THAT(load(run), testing::HasSubstr("mesh.ply"));
}

TEST_F(RunFolder, aCloudAloneCanBeOpened) {
    savePly(path("points.ply"), {{{1, 2, 3}, {4, 5, 6}}});
    const RunData run = loadRun(path("points.ply"));
    EXPECT_EQ(run.points.size(), 1U);
    EXPECT_TRUE(run.folder.empty());
}

}  // namespace
}  // namespace rgbd_graphslam
