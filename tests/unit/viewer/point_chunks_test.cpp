#include "rgbd_graphslam/viewer/point_chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace rgbd_graphslam {
namespace {

const Eigen::Vector2i size_px(640, 480);

/** A square of side `side_m` on the floor, n x n points; each one's color is its number. */
Vertices sheet(int n, float side_m) {
    Vertices points;
    for (int i = 0; i < n * n; ++i) {
        const float x = side_m * static_cast<float>(i % n) / static_cast<float>(n - 1);
        const float y = side_m * static_cast<float>(i / n) / static_cast<float>(n - 1);
        points.push_back({{x, y, 0},
                          {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8),
                           static_cast<std::uint8_t>(i >> 16), 255}});
    }
    return points;
}

int numberOf(const Vertex& v) {
    return v.color[0] | v.color[1] << 8 | v.color[2] << 16;
}

TEST(PointChunks, keepEveryPointOnceInCompactChunks) {
    const ChunkedPoints cloud = chunked(sheet(100, 10), 1000);
    ASSERT_EQ(cloud.chunks.size(), 10U);
    std::set<int> numbers;
    for (const Vertex& v : cloud.points) numbers.insert(numberOf(v));
    EXPECT_EQ(numbers.size(), 10000U);
    for (const PointChunk& chunk : cloud.chunks) {
        EXPECT_LT(chunk.radius_m, 6.5);  // a tenth of the area; all of it would be 7.1
        for (std::size_t i = chunk.first; i < chunk.first + chunk.count; ++i) {
            const double distance = (cloud.points[i].position.cast<double>() - chunk.center).norm();
            EXPECT_LE(distance, chunk.radius_m + 1e-5);
        }
    }
}

TEST(PointChunks, areTheSameEveryTime) {
    const ChunkedPoints a = chunked(sheet(64, 3), 500), b = chunked(sheet(64, 3), 500);
    for (std::size_t i = 0; i < a.points.size(); ++i) {
        ASSERT_EQ(numberOf(a.points[i]), numberOf(b.points[i]));
    }
}

TEST(PointChunks, thePrefixOfAChunkIsAnEvenThinning) {
    const ChunkedPoints cloud = chunked(sheet(100, 10), 10000);
    Eigen::Array<int, 4, 1> quarters = Eigen::Array<int, 4, 1>::Zero();
    for (std::size_t i = 0; i < 1000; ++i) {
        const auto& p = cloud.points[i].position;
        ++quarters[2 * (p.x() > 5) + (p.y() > 5)];
    }
    EXPECT_GT(quarters.minCoeff(), 200);
    EXPECT_LT(quarters.maxCoeff(), 300);
}

TEST(PointChunks, emptyCloudHasNone) {
    EXPECT_TRUE(chunked({}).chunks.empty());
}

TEST(UsefulPoints, noneBehindTheEyeAndAllOfTheOnesNearby) {
    const ChunkedPoints cloud = chunked(sheet(100, 10), 1000);
    OrbitCamera camera;
    camera.target = {5, 5, 0};
    camera.distance_m = 14;
    camera.elevation_rad = 1.2;
    const auto all = usefulPoints(cloud.chunks, camera, size_px);
    EXPECT_EQ(std::accumulate(all.begin(), all.end(), std::size_t{0}), 10000U);
    camera.target = {5, 5, 60};  // the eye above looks at a place below it that is above the sheet
    camera.elevation_rad = -1.2;
    const auto none = usefulPoints(cloud.chunks, camera, size_px);
    EXPECT_EQ(std::accumulate(none.begin(), none.end(), std::size_t{0}), 0U);
}

TEST(UsefulPoints, fewWhereTheSheetIsFarAway) {
    const ChunkedPoints cloud = chunked(sheet(300, 1), 10000);
    OrbitCamera camera;
    camera.distance_m = 100;
    const auto useful = usefulPoints(cloud.chunks, camera, size_px);
    const auto total = std::accumulate(useful.begin(), useful.end(), std::size_t{0});
    EXPECT_GT(total, 20U);
    EXPECT_LT(total, 5000U);
}

TEST(Slice, slicesTogetherDrawEachUsefulPointOnce) {
    const ChunkedPoints cloud = chunked(sheet(100, 10), 777);
    std::vector<std::size_t> useful;
    for (std::size_t c = 0; c < cloud.chunks.size(); ++c) {
        useful.push_back(cloud.chunks[c].count * (c % 4) / 3);
    }
    std::vector<int> drawn(cloud.points.size(), 0);
    const double shares[] = {0, 0.13, 0.5, 0.51, 1};
    for (int s = 0; s < 4; ++s) {
        for (const DrawRange& range : slice(cloud.chunks, useful, shares[s], shares[s + 1])) {
            for (std::size_t i = 0; i < range.count; ++i) ++drawn[range.first + i];
        }
    }
    for (std::size_t c = 0; c < cloud.chunks.size(); ++c) {
        for (std::size_t i = 0; i < cloud.chunks[c].count; ++i) {
            ASSERT_EQ(drawn[cloud.chunks[c].first + i], i < useful[c] ? 1 : 0);
        }
    }
}

}  // namespace
}  // namespace rgbd_graphslam
