#include "rgbd_graphslam/geometry/ply.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

PlyModel modelOf(const std::string& text) {
    const TestFolder folder;
    folder.write("model.ply", text);
    return readPly(folder / "model.ply");
}

PlyModel writtenAndRead(const PlyModel& model) {
    const TestFolder folder;
    writePly(folder / "model.ply", model);
    return readPly(folder / "model.ply");
}

PlyModel coloredTriangle() {
    PlyModel model;
    model.vertices = {{1, 2, 3}, {4, 5.5, 6}, {-7, 8, 9}};
    model.colors = {{255, 0, 1}, {2, 3, 4}, {5, 6, 7}};
    model.triangles = {{2, 0, 1}};
    return model;
}

TEST(Ply, isReadAsWritten) {
    const PlyModel written = coloredTriangle();
    const PlyModel read = writtenAndRead(written);
    EXPECT_EQ(read.vertices, written.vertices);
    EXPECT_EQ(read.colors, written.colors);
    EXPECT_EQ(read.triangles, written.triangles);
}

TEST(Ply, ofALitMeshIsReadAsWritten) {
    PlyModel written = coloredTriangle();
    written.normals = {{0, 0, 1}, {0, -1, 0}, {0.6f, 0, 0.8f}};
    const PlyModel read = writtenAndRead(written);
    EXPECT_EQ(read.vertices, written.vertices);
    EXPECT_EQ(read.normals, written.normals);
    EXPECT_EQ(read.colors, written.colors);
    EXPECT_EQ(read.triangles, written.triangles);
}

/** The order and types that MeshLab and Open3D write. */
TEST(Ply, ofALitMeshHasTheUsualHeader) {
    PlyModel model = coloredTriangle();
    model.normals.assign(3, {0, 0, 1});
    const TestFolder folder;
    writePly(folder / "model.ply", model);
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nproperty float nx\nproperty float ny\n"
        "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string text = readText(folder / "model.ply");
    EXPECT_EQ(text.substr(0, header.size()), header);
    EXPECT_EQ(text.size(), header.size() + 3 * 27 + 13);
}

TEST(Ply, ofPointsAloneHasNothingElse) {
    PlyModel written;
    written.vertices = {{1, 2, 3}};
    const PlyModel read = writtenAndRead(written);
    EXPECT_TRUE(read.colors.empty());
    EXPECT_TRUE(read.triangles.empty());
}

TEST(Ply, asciiWithQuadsAndThingsToSkip) {
    const PlyModel model = modelOf(
        "ply\nformat ascii 1.0\ncomment made by hand\nelement camera 1\nproperty float tilt\n"
        "element vertex 4\nproperty float nx\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 1\nproperty list uchar int vertex_index\nproperty int flags\nend_header\n"
        "0.5\n0 0 0 1 10 20 30\n0 1 0 1 10 20 30\n0 1 1 1 10 20 30\n0 0 1 1 10 20 31\n"
        "4 0 1 2 3 77\n");
    ASSERT_EQ(model.vertices.size(), 4u);
    EXPECT_EQ(model.vertices[2], Eigen::Vector3f(1, 1, 1));
    EXPECT_EQ(model.colors[3][2], 31);
    ASSERT_EQ(model.triangles.size(), 2u);
    EXPECT_EQ(model.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST(Ply, refusesWhatItCannotRead) {
    const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
    const std::string one = "element vertex 1\n" + vertex;
    EXPECT_THROW(readPly(TestFolder() / "absent.ply"), Error);
    EXPECT_THROW(modelOf("solid\n"), Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\nelement vertex 1\n"), Error);
    EXPECT_THROW(modelOf("ply\nformat binary_big_endian 1.0\n" + one + "end_header\n"), Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\n" + one + "end_header\n1 2\n"), Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\n" + one + "end_header\n1 nan 2\n"), Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\nelement vertex 0\n" + vertex + "end_header\n"),
                 Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\nproperty float x\nend_header\n"), Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\n" + one +
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "1 2 3\n3 0 0 1\n"),
                 Error);
    EXPECT_THROW(modelOf("ply\nformat ascii 1.0\n" + one +
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                         "1 2 3\n3 0 0 -1\n"),
                 Error);
}

TEST(Ply, thatIsCutOffAnywhereIsAnError) {
    const TestFolder folder;
    const std::string path = folder / "model.ply";
    writePly(path, coloredTriangle());
    const auto size = std::filesystem::file_size(path);
    for (std::uintmax_t cut = 1; cut <= 60; ++cut) {
        std::filesystem::resize_file(path, size - cut);
        EXPECT_THROW(readPly(path), Error) << cut;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
