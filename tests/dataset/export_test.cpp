/** Every exported file is read by a program of somebody else's. */
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "../support/node_packages.h"
#include "../support/synthetic_film.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {
namespace {

using nlohmann::json;
using testing::HasSubstr;
namespace fs = std::filesystem;

/** \return what a command wrote to both streams; the exit code goes to `code` */
std::string outputOf(const std::string& command, int& code) {
    const TestFolder folder;
    code = std::system((command + " >'" + folder / "out" + "' 2>&1 </dev/null").c_str());
    return readText(folder / "out");
}

bool isInstalled(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

double numberAfter(const std::string& name, const std::string& text) {
    const auto place = text.find(name);
    return place == std::string::npos ? -1 : std::stod(text.substr(place + name.size()));
}

/** The sample rawlog, mapped with mesh once for all tests. */
const std::string& sampleRun() {
    static const TestFolder folder;
    static const std::string run = [] {
        const std::string out = folder / "run";
        runOrFail("rgbd-slam", "'" RGBD_SOURCE_DIR "/ini/default.ini' '" RGBD_SOURCE_DIR
                               "/rawlogs/office_sample.rawlog' -o '" +
                                   out + "' -q --set MapOptions.mesh_voxel_m=0.03");
        return out;
    }();
    return run;
}

class Export : public testing::Test {
  protected:
    std::string write(const std::string& format, const std::string& more = "") {
        const ProgramResult result =
            runProgram("rgbd-export",
                       "'" + sampleRun() + "' -o '" + out / "" + "' --to " + format + " " + more);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.out;
    }

    TestFolder out;
};

TEST_F(Export, colmapReadsTheModel) {
    write("colmap");
    const Trajectory keyframes = readTumTrajectory(sampleRun() + "/keyframes.txt");
    EXPECT_EQ(static_cast<std::size_t>(std::distance(fs::directory_iterator(out / "colmap/images"),
                                                     fs::directory_iterator())),
              keyframes.size());
    if (!isInstalled("colmap")) GTEST_SKIP() << "SKIPPED: no colmap (Debian package colmap)";
    int code = -1;
    const std::string sparse = out / "colmap/sparse";
    const std::string said =
        outputOf("QT_QPA_PLATFORM=offscreen colmap model_analyzer --path '" + sparse + "'", code);
    ASSERT_EQ(code, 0) << said;
    EXPECT_EQ(numberAfter("Registered images: ", said), static_cast<double>(keyframes.size()));
    EXPECT_GT(numberAfter("Points: ", said), 500);
    EXPECT_GT(numberAfter("Mean track length: ", said), 2);
    EXPECT_GT(numberAfter("Mean reprojection error: ", said), 0);
    EXPECT_LT(numberAfter("Mean reprojection error: ", said), 1);
    fs::create_directory(out / "text");
    const std::string converted = outputOf(
        "QT_QPA_PLATFORM=offscreen colmap model_converter --output_type TXT --input_path '" +
            sparse + "' --output_path '" + out / "text'",
        code);
    ASSERT_EQ(code, 0) << converted;
    EXPECT_THAT(readText(out / "text/cameras.txt"), HasSubstr("1 PINHOLE "));
}

/** Depth, taken to the world by the matrix as nerfstudio reads it, must lie on the map's points. */
TEST_F(Export, nerfstudioHasDepthOnThePoints) {
    write("nerfstudio");
    const auto scene = json::parse(readText(out / "nerfstudio/transforms.json"));
    const PlyModel points =
        readPly(out / ("nerfstudio/" + scene["ply_file_path"].get<std::string>()));
    const auto cell = [](const Eigen::Vector3d& p) {
        const Eigen::Vector3i c = (p / 0.05).array().floor().cast<int>();
        return std::array<int, 3>{c.x(), c.y(), c.z()};
    };
    std::set<std::array<int, 3>> occupied;
    for (const auto& vertex : points.vertices) {
        for (int corner = 0; corner < 8; ++corner) {
            const Eigen::Vector3d shift(corner & 1, corner >> 1 & 1, corner >> 2);
            occupied.insert(cell(vertex.cast<double>() + 0.04 * (shift.array() - 0.5).matrix()));
        }
    }
    int on_points = 0, readings = 0;
    for (const auto& frame : scene["frames"]) {
        const cv::Mat1w depth =
            cv::imread(out / ("nerfstudio/" + frame["depth_file_path"].get<std::string>()),
                       cv::IMREAD_UNCHANGED);
        ASSERT_EQ(depth.cols, scene["w"]);
        ASSERT_TRUE(fs::exists(out / ("nerfstudio/" + frame["file_path"].get<std::string>())));
        Eigen::Matrix4d M;
        for (int i = 0; i < 16; ++i) M(i / 4, i % 4) = frame["transform_matrix"][i / 4][i % 4];
        for (int v = 3; v < depth.rows; v += 17) {
            for (int u = 5; u < depth.cols; u += 19) {
                const double z = 0.001 * depth(v, u);
                if (z <= 0.3 || z > 4) continue;
                // Pixel centers are at one half, y is up and the view along -z.
                const double x =
                    (u + 0.5 - scene["cx"].get<double>()) / scene["fl_x"].get<double>();
                const double y =
                    (v + 0.5 - scene["cy"].get<double>()) / scene["fl_y"].get<double>();
                const Eigen::Vector4d p = M * Eigen::Vector4d(x * z, -y * z, -z, 1);
                ++readings;
                on_points += static_cast<int>(occupied.count(cell(p.head<3>())));
            }
        }
    }
    EXPECT_GT(readings, 1000);
    EXPECT_GT(on_points, 0.95 * readings);
}

TEST_F(Export, assimpReadsTheMeshes) {
    EXPECT_THAT(write("glb --to obj"), HasSubstr("textured"));
    runOrFail("rgbd-export",
              "'" + sampleRun() + "' --to glb --vertex-colors -o '" + out / "colors.glb" + "'");
    if (!isInstalled("assimp")) GTEST_SKIP() << "SKIPPED: no assimp (Debian package assimp-utils)";
    const PlyModel mesh = readPly(sampleRun() + "/mesh.ply");
    for (const char* name : {"mesh.glb", "obj/mesh.obj", "colors.glb"}) {
        int code = -1;
        const std::string said = outputOf("assimp info '" + out / name + "'", code);
        ASSERT_EQ(code, 0) << said;
        EXPECT_EQ(numberAfter("Faces:", said), static_cast<double>(mesh.triangles.size())) << said;
        if (std::string(name) == "colors.glb") continue;
        EXPECT_THAT(said, testing::ContainsRegex("Textures \\(embed\\.\\): *[01]|mesh\\.jpg"));
    }
}

TEST_F(Export, foxglovesLibrariesReadTheBag) {
    write("ros2");
    const std::string packages = nodePackages();
    if (packages.empty()) GTEST_SKIP() << "SKIPPED: no node, npm or network";
    int code = -1;
    const std::string said =
        outputOf("NODE_PATH='" + packages +
                     "/node_modules' node '" RGBD_SOURCE_DIR "/tests/support/read_mcap.js' '" +
                     out / "run.mcap'",
                 code);
    ASSERT_EQ(code, 0) << said;
    const auto bag = json::parse(said);
    const Trajectory trajectory = readTumTrajectory(sampleRun() + "/trajectory.txt");
    EXPECT_EQ(bag["profile"], "ros2");
    EXPECT_EQ(bag["streamed"], 3 + 2 * trajectory.size());
    const auto& topics = bag["topics"];
    for (const char* topic : {"/tf", "/pose"}) EXPECT_EQ(topics[topic]["count"], trajectory.size());
    const auto& last = topics["/pose"]["last"]["pose"];
    const SE3& pose = trajectory.back().T_world_cam;
    EXPECT_NEAR(last["position"]["x"], pose.t.x(), 1e-9);
    EXPECT_NEAR(std::abs(last["orientation"]["w"].get<double>()), std::abs(pose.quaternion().w()),
                1e-8);
    const auto& transform = topics["/tf"]["first"]["transforms"][0];
    EXPECT_EQ(transform["child_frame_id"], "camera_optical_frame");
    EXPECT_NEAR(transform["transform"]["translation"]["z"], trajectory[0].T_world_cam.t.z(), 1e-9);
    EXPECT_EQ(topics["/path"]["first"]["poses"]["length"], trajectory.size());
    const PlyModel points = readPly(sampleRun() + "/points.ply");
    const auto& cloud = topics["/points"]["first"];
    EXPECT_EQ(cloud["width"], points.vertices.size());
    EXPECT_EQ(cloud["data"]["length"], 16 * points.vertices.size());
    EXPECT_EQ(cloud["data"]["first"][14], points.colors[0][0]);  // BGR0
    const auto& grid = topics["/map"]["first"];
    const cv::Mat picture = cv::imread(sampleRun() + "/grid.png", cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(grid["info"]["width"], picture.cols);
    EXPECT_EQ(grid["data"]["length"], picture.total());
    EXPECT_NEAR(grid["info"]["resolution"], 0.05, 1e-6);
}

TEST_F(Export, everyFormatIsTheSameEachTime) {
    const std::string formats = "g2o --to kitti --to euroc --to tum --to ros2 --to glb --to colmap";
    write(formats);
    const TestFolder again;
    const ProgramResult result =
        runProgram("rgbd-export", "'" + sampleRun() + "' -o '" + again / "" + "' --to " + formats);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out / "")) {
        if (!entry.is_regular_file()) continue;
        const std::string name = fs::relative(entry.path(), out / "").string();
        EXPECT_TRUE(readText(entry.path().string()) == readText(again / name)) << name;
        ++files;
    }
    EXPECT_GT(files, 8);
}

}  // namespace
}  // namespace rgbd_graphslam
