/** A wall with a picture on it, seen by cameras in known places. */
#include "rgbd_graphslam/export/textured_mesh.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/export/mesh_files.h"

namespace rgbd_graphslam {
namespace {

constexpr double unit_m = 0.001;

/** In the plane z = z_m, from (x0, y0) to (x1, y1), facing -z: a camera at the origin with no
 * rotation sees its front. */
void addWall(PlyModel& mesh, float x0, float y0, float x1, float y1, float z_m, int cells) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto n = static_cast<std::uint32_t>(cells);
    for (std::uint32_t row = 0; row <= n; ++row) {
        for (std::uint32_t column = 0; column <= n; ++column) {
            const float u = static_cast<float>(column) / static_cast<float>(n),
                        v = static_cast<float>(row) / static_cast<float>(n);
            mesh.vertices.emplace_back(x0 + u * (x1 - x0), y0 + v * (y1 - y0), z_m);
            mesh.colors.push_back({128, 128, 128});
        }
    }
    for (std::uint32_t row = 0; row < n; ++row) {
        for (std::uint32_t column = 0; column < n; ++column) {
            const std::uint32_t a = first + row * (n + 1) + column, b = a + 1, c = a + n + 1,
                                d = c + 1;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, d});
        }
    }
}

CameraModel smallCamera() {
    Intrinsics camera;
    camera.width = 160;
    camera.height = 120;
    camera.fx = camera.fy = 130;
    camera.cx = 79.5;
    camera.cy = 59.5;
    return camera;
}

cv::Mat1w depthOf(double z_m) {
    return cv::Mat1w(120, 160, static_cast<std::uint16_t>(z_m / unit_m));
}

/** Waves that tell places a few pixels apart. */
double wave(double u, double v) {
    return 40 * (std::sin(2 * M_PI * u / 11) + std::sin(2 * M_PI * v / 13));
}

/** The waves, brighter than the mesh: another exposure. */
cv::Mat3b picture() {
    cv::Mat3b image(120, 160);
    for (int v = 0; v < image.rows; ++v) {
        for (int u = 0; u < image.cols; ++u)
            image(v, u) = cv::Vec3b(static_cast<std::uint8_t>(150 + wave(u, v)), 150, 150);
    }
    return image;
}

cv::Vec3b texel(const TexturedMesh& mesh, const Eigen::Vector2f& uv) {
    const int u = static_cast<int>(uv.x() * static_cast<float>(mesh.texture.cols)),
              v = static_cast<int>(uv.y() * static_cast<float>(mesh.texture.rows));
    return mesh.texture(v, u);
}

TEST(TextureBuilder, putsEachPixelWhereItWasSeen) {
    PlyModel mesh;
    addWall(mesh, -0.5f, -0.4f, 0.5f, 0.4f, 1, 20);
    TextureBuilder builder(mesh, 1024);
    const CameraModel camera = smallCamera();
    builder.addView(3, camera, {}, depthOf(1), unit_m);
    builder.plan();
    EXPECT_EQ(builder.coveredShare(), 1);
    builder.paint(3, camera, {}, picture());
    const TexturedMesh result = builder.take();
    EXPECT_EQ(result.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(result.vertices.size(), mesh.vertices.size());  // one chart
    double error_sum = 0, green_sum = 0;
    for (std::size_t i = 0; i < result.vertices.size(); ++i) {
        const Eigen::Vector2d pixel = camera.project(result.vertices[i].cast<double>());
        const cv::Vec3b seen = texel(result, result.uv[i]);
        error_sum += std::abs(seen[0] - (128 + wave(pixel.x(), pixel.y())));
        green_sum += seen[1];
    }
    const auto count = static_cast<double>(result.vertices.size());
    EXPECT_LT(error_sum / count, 9);  // rounding is 5, a pixel off 14 to 17
    EXPECT_NEAR(green_sum / count, 128, 2);
}

TEST(TextureBuilder, takesNothingFromImagesThatDoNotShowIt) {
    PlyModel mesh;
    addWall(mesh, -0.2f, -0.2f, 0.2f, 0.2f, 1, 4);     // in front
    addWall(mesh, -0.1f, -0.1f, 0.1f, 0.1f, 1.5f, 4);  // hidden behind it
    addWall(mesh, 5, -0.1f, 5.2f, 0.1f, 1, 4);         // out of the image
    const std::size_t wall = 32;
    ViewSelection selection(mesh);
    cv::Mat1w depth = depthOf(1);
    selection.add(0, smallCamera(), {}, depth, unit_m);
    const auto views = selection.views(neighborsOf(mesh.triangles));
    for (std::size_t i = 0; i < views.size(); ++i)
        EXPECT_EQ(views[i], i < wall ? 0 : ViewSelection::no_view) << i;
}

/** The view of all triangles of a wall, which is the same. */
int viewOfWall(const ViewSelection& selection, const PlyModel& wall) {
    const auto views = selection.views(neighborsOf(wall.triangles));
    for (const int view : views) EXPECT_EQ(view, views[0]);
    return views[0];
}

TEST(TextureBuilder, takesNothingFromPeopleBeforeAndTheBestOfTheRest) {
    PlyModel mesh;
    addWall(mesh, -0.2f, -0.2f, 0.2f, 0.2f, 1, 4);
    ViewSelection selection(mesh);
    // Somebody at 0.6 m hides the wall.
    selection.add(0, smallCamera(), {}, depthOf(0.6), unit_m);
    EXPECT_EQ(viewOfWall(selection, mesh), ViewSelection::no_view);
    // Its back rather than nothing, its front from afar rather than its back, and nearby best.
    selection.add(1, smallCamera(), SE3(rotationExp({0, M_PI, 0}), {0, 0, 2}), depthOf(1), unit_m);
    EXPECT_EQ(viewOfWall(selection, mesh), 1);
    selection.add(2, smallCamera(), SE3(Eigen::Matrix3d::Identity(), {0, 0, -1}), depthOf(2),
                  unit_m);
    EXPECT_EQ(viewOfWall(selection, mesh), 2);
    selection.add(3, smallCamera(), {}, depthOf(1), unit_m);
    EXPECT_EQ(viewOfWall(selection, mesh), 3);
}

TEST(TextureBuilder, givesMeanColorsWhereNoImageShowsIt) {
    PlyModel mesh;
    addWall(mesh, -0.2f, -0.2f, 0.2f, 0.2f, 1, 4);
    for (auto& color : mesh.colors) color = {200, 100, 40};
    TextureBuilder builder(mesh, 1024);
    builder.plan();
    EXPECT_EQ(builder.coveredShare(), 0);
    const TexturedMesh result = builder.take();
    EXPECT_EQ(result.triangles.size(), mesh.triangles.size());
    for (const auto& uv : result.uv) EXPECT_EQ(texel(result, uv), cv::Vec3b(40, 104, 200));
}

TEST(AtlasPacking, nothingOverlapsAndLargeSetsAreScaled) {
    std::vector<cv::Size> sizes;
    for (int i = 0; i < 300; ++i) sizes.push_back({5 + i * 7 % 90, 3 + i * 13 % 70});
    for (const int most : {4096, 300}) {
        const AtlasLayout layout = packAtlas(sizes, most);
        EXPECT_LE(std::max(layout.size.width, layout.size.height), most);
        EXPECT_EQ(layout.scale == 1, most == 4096);
        cv::Mat1b taken = cv::Mat1b::zeros(layout.size);
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            cv::Mat1b place = taken(cv::Rect(layout.corners[i], scaled(sizes[i], layout.scale)));
            EXPECT_EQ(cv::countNonZero(place), 0) << i;
            place = 1;
        }
    }
}

TEST(NeighborsOf, edgesOfThreeTrianglesHaveNone) {
    const TriangleNeighbors neighbors =
        neighborsOf({{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {6, 5, 7}, {5, 6, 8}});
    EXPECT_EQ(neighbors[0], (std::array<std::int32_t, 3>{-1, 1, -1}));
    EXPECT_EQ(neighbors[1], (std::array<std::int32_t, 3>{0, -1, -1}));
    EXPECT_EQ(neighbors[2], (std::array<std::int32_t, 3>{-1, -1, -1}));
}

/** The two chunks of a GLB, whose lengths must be right. */
std::pair<nlohmann::json, std::string> readGlb(const std::string& path) {
    const std::string bytes = readText(path);
    ByteReader in(bytes);
    EXPECT_EQ(in.getBytes(4), "glTF");
    EXPECT_EQ(in.get<std::uint32_t>(), 2u);
    EXPECT_EQ(in.get<std::uint32_t>(), bytes.size());
    const auto text_size = in.get<std::uint32_t>();
    EXPECT_EQ(text_size % 4, 0u);
    EXPECT_EQ(in.getBytes(4), "JSON");
    const auto text = nlohmann::json::parse(in.getBytes(text_size));
    const auto binary_size = in.get<std::uint32_t>();
    EXPECT_EQ(in.getBytes(4), std::string_view("BIN\0", 4));
    const std::string binary(in.getBytes(binary_size));
    EXPECT_EQ(in.left(), 0u);
    return {text, binary};
}

TEST(MeshFiles, glbIsYUpAndHasItsColorsLinear) {
    PlyModel mesh;
    mesh.vertices = {{1, 2, 3}, {2, 2, 3}, {1, 3, 3}};
    mesh.colors = {{255, 188, 0}, {0, 0, 0}, {9, 9, 9}};
    mesh.triangles = {{0, 1, 2}};
    const TestFolder folder;
    writeGlb(folder / "mesh.glb", mesh);
    const auto [text, binary] = readGlb(folder / "mesh.glb");
    ByteReader in(binary);
    EXPECT_EQ(in.get<float>(), 1);
    EXPECT_EQ(in.get<float>(), 3);
    EXPECT_EQ(in.get<float>(), -2);
    EXPECT_EQ(text["accessors"][0]["min"][2], -3);
    const std::size_t offset = text["bufferViews"][1]["byteOffset"];
    ByteReader colors(std::string_view(binary).substr(offset));
    EXPECT_EQ(colors.get<std::uint16_t>(), 65535);
    EXPECT_NEAR(colors.get<std::uint16_t>(), 0.5 * 65535, 700);  // 188 of sRGB is half the light
    EXPECT_EQ(colors.get<std::uint16_t>(), 0);
}

}  // namespace
}  // namespace rgbd_graphslam
