#include "rgbd_graphslam/mapping/map_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/opengl/CAssimpModel.h>
#include <mrpt/serialization/CArchive.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "../../support/problem_of.h"
#include "box_room.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/ply.h"
#include "rgbd_graphslam/mapping/dense_mapper.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;
namespace fs = std::filesystem;

class MapFiles : public testing::Test {
  protected:
    MapFiles() : mapper_(MapOptions(), smallCamera()) {
        fs::create_directories(folder_);
        for (const SE3& T : walk(6)) mapper_.insert(T, render(BoxRoom(), smallCamera(), T));
    }
    ~MapFiles() override { fs::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }

    /** A file with its first `bytes` bytes only. */
    void truncate(const std::string& file, double share) const {
        fs::resize_file(
            file, static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(file))));
    }

    fs::path folder_ =
        fs::path(testing::TempDir()) / ("rgbd-map-files-" + std::to_string(getpid()));
    DenseMapper mapper_;
};

/** Leaf by leaf at the finest level. */
template <class Tree>
void expectSameOccupancy(const Tree& tree, const OccupancyVolume& volume) {
    std::size_t known = 0;
    for (const auto& [key, block] : volume.blocks().entries()) {
        const VoxelIndex b = voxelOfKey(key);
        for (int i = 0; i < 512; ++i) {
            if (block->log_odds[i] == OccupancyVolume::unknown) continue;
            const auto part = [](int index, int within) {
                return static_cast<octomap::key_type>(8 * index + within + 32768);
            };
            const octomap::OcTreeKey leaf(part(b.x, i % 8), part(b.y, i / 8 % 8),
                                          part(b.z, i / 64));
            const auto* node = tree.search(leaf);
            ASSERT_TRUE(node);
            ASSERT_EQ(tree.isNodeOccupied(node), block->log_odds[i] >= 0);
            ++known;
        }
    }
    EXPECT_GT(known, 10000u);
    std::size_t in_tree = 0;
    for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
        const std::size_t edge = std::size_t(1) << (16 - leaf.getDepth());
        in_tree += edge * edge * edge;
    }
    EXPECT_EQ(in_tree, known);
}

/** The reader of SceneViewer3D's "Import 3D model". */
TEST_F(MapFiles, meshIsReadByAssimpAsWell) {
    PlyModel mesh;
    mesh.vertices = {{1, 2, 3}, {4, 2, 3}, {1, 5, 3}, {1, 2, 6}};
    mesh.normals.assign(4, Eigen::Vector3f(0, 0, 1));
    mesh.colors.assign(4, {10, 20, 30});
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    writePly(path("mesh.ply"), mesh);
    mrpt::opengl::CAssimpModel model;
    ASSERT_NO_THROW(model.loadScene(path("mesh.ply")));
    const auto box = model.getBoundingBox();
    EXPECT_EQ(box.min, mrpt::math::TPoint3D(1, 2, 3));
    EXPECT_EQ(box.max, mrpt::math::TPoint3D(4, 5, 6));
}

TEST_F(MapFiles, binaryOctreeReadsBackLeafByLeaf) {
    saveBinaryOcTree(path("a.bt"), *mapper_.octree(LeafValues::MaximumLikelihood));
    const auto tree = loadBinaryOcTree(path("a.bt"));
    EXPECT_DOUBLE_EQ(tree->getResolution(), 0.05);
    expectSameOccupancy(*tree, mapper_.volume());
    expectSameOccupancy(*mapper_.octree(LeafValues::Exact), mapper_.volume());
}

TEST_F(MapFiles, binaryOctreeIsWhatOctomapItselfWrites) {
    const auto tree = mapper_.octree(LeafValues::MaximumLikelihood);
    saveBinaryOcTree(path("a.bt"), *tree);
    ASSERT_TRUE(tree->writeBinaryConst(path("b.bt")));
    const auto bytes = [&](const char* name) {
        std::ifstream in(path(name), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    EXPECT_EQ(bytes("a.bt"), bytes("b.bt"));
}

TEST_F(MapFiles, colorsSurviveInTheOctree) {
    saveColorOcTree(path("a.ot"), *mapper_.colorOctree());
    const auto tree = loadColorOcTree(path("a.ot"));
    expectSameOccupancy(*tree, mapper_.volume());
    // The table's top is (40, 60, 200) in BGR.
    const auto* table = tree->search(1.6, 0.0, 0.72);
    ASSERT_TRUE(table && tree->isNodeOccupied(table));
    EXPECT_EQ(table->getColor(), octomap::ColorOcTreeNode::Color(200, 60, 40));
}

TEST_F(MapFiles, damagedOctreesAreRefusedWhereverTheyAreCut) {
    for (const double share : {0.0, 0.001, 0.3, 0.7, 0.999}) {
        saveBinaryOcTree(path("a.bt"), *mapper_.octree(LeafValues::MaximumLikelihood));
        truncate(path("a.bt"), share);
        EXPECT_THAT(problemOf([&] { loadBinaryOcTree(path("a.bt")); }), testing::HasSubstr("a.bt"))
            << share;
        saveColorOcTree(path("a.ot"), *mapper_.colorOctree());
        truncate(path("a.ot"), share);
        EXPECT_THAT(problemOf([&] { loadColorOcTree(path("a.ot")); }), testing::HasSubstr("a.ot"))
            << share;
    }
    EXPECT_THAT(problemOf([&] { loadBinaryOcTree(path("none.bt")); }),
                testing::HasSubstr("none.bt"));
}

TEST_F(MapFiles, aFileOfOnesIsNoEndlessTree) {
    std::ofstream out(path("a.bt"), std::ios::binary);
    out << "# Octomap OcTree binary file\nid OcTree\nsize 5000\nres 0.05\ndata\n"
        << std::string(100000, '\xff');
    out.close();
    EXPECT_THAT(problemOf([&] { loadBinaryOcTree(path("a.bt")); }), testing::HasSubstr("damaged"));
}

TEST_F(MapFiles, plyReadsBackToTheSamePoints) {
    const PointMap points = mapper_.points();
    savePly(path("a.ply"), points);
    const PointMap read = loadPly(path("a.ply"));
    ASSERT_EQ(read.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(read[i].position, points[i].position);
        ASSERT_EQ(read[i].rgb, points[i].rgb);
    }
    truncate(path("a.ply"), 0.9);
    EXPECT_THAT(problemOf([&] { loadPly(path("a.ply")); }), testing::HasSubstr("cut off"));
}

TEST_F(MapFiles, pcdHasOneRecordAPoint) {
    const PointMap points = mapper_.points();
    savePcd(path("a.pcd"), points);
    std::ifstream in(path("a.pcd"), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(in), {});
    const auto data = bytes.find("DATA binary\n") + 12;
    ASSERT_EQ(bytes.size() - data, 16 * points.size());
    EXPECT_THAT(bytes.substr(0, data),
                testing::HasSubstr("POINTS " + std::to_string(points.size()) + "\n"));
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[data + i]); };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t rgb = 16 * i + 12;  // blue first
        ASSERT_EQ((std::array{byte(rgb + 2), byte(rgb + 1), byte(rgb)}), points[i].rgb) << i;
    }
}

TEST_F(MapFiles, metricMapIsWhatMrptReads) {
    saveMetricMap(path("a.metricmap"), mapper_.points());
    mrpt::io::CFileGZInputStream in(path("a.metricmap"));
    auto archive = mrpt::serialization::archiveFrom(in);
    const auto map = std::dynamic_pointer_cast<mrpt::maps::CSimplePointsMap>(archive.ReadObject());
    ASSERT_TRUE(map);
    EXPECT_EQ(map->size(), mapper_.points().size());
}

TEST_F(MapFiles, rosGridShowsWhatTheGridHolds) {
    mrpt::maps::COccupancyGridMap2D grid;
    mapper_.grid(grid);
    saveRosGrid(path("grid"), grid);
    const cv::Mat image = cv::imread(path("grid.png"), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(image.type(), CV_8UC1);
    ASSERT_EQ(image.cols, static_cast<int>(grid.getSizeX()));
    ASSERT_EQ(image.rows, static_cast<int>(grid.getSizeY()));
    for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) {
            const float free = grid.getCell(x, image.rows - 1 - y);
            const int shade = image.at<std::uint8_t>(y, x);
            ASSERT_EQ(shade, free < 0.35f ? 0 : free > 0.804f ? 254 : 205) << free;
        }
    }
    std::ifstream yaml(path("grid.yaml"));
    const std::string text(std::istreambuf_iterator<char>(yaml), {});
    EXPECT_THAT(text, testing::HasSubstr("image: grid.png\n"));
    EXPECT_THAT(text, testing::HasSubstr("resolution: 0.05\n"));
}

/** A robot that takes unseen space for free drives into it. */
TEST_F(MapFiles, readersOfTheRosGridKeepUnknownUnknown) {
    mrpt::maps::COccupancyGridMap2D grid;
    mapper_.grid(grid);
    saveRosGrid(path("grid"), grid);
    const auto read = mrpt::maps::COccupancyGridMap2D::FromROSMapServerYAML(path("grid.yaml"));
    ASSERT_EQ(read.getSizeX(), grid.getSizeX());
    ASSERT_EQ(read.getSizeY(), grid.getSizeY());
    int unknown = 0;
    for (unsigned y = 0; y < grid.getSizeY(); ++y) {
        for (unsigned x = 0; x < grid.getSizeX(); ++x) {
            if (std::abs(grid.getCell(x, y) - 0.5f) > 0.01f) continue;
            ++unknown;
            ASSERT_NEAR(read.getCell(x, y), 0.5, 0.01) << x << ", " << y;
        }
    }
    EXPECT_GT(unknown, 100);
}

TEST_F(MapFiles, folderThatIsNotThereIsNamed) {
    EXPECT_THAT(problemOf([&] { savePly(path("none/a.ply"), mapper_.points()); }),
                testing::HasSubstr("none/a.ply"));
    EXPECT_THAT(problemOf([&] { saveBinaryOcTree(path("none/a.bt"), *mapper_.octree()); }),
                testing::HasSubstr("none/a.bt"));
}

}  // namespace
}  // namespace rgbd_graphslam
