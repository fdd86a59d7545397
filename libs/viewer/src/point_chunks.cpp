#include "rgbd_graphslam/viewer/point_chunks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

namespace rgbd_graphslam {
namespace {

constexpr double useful_points_a_pixel = 2;

/** Spreads the lower ten bits to every third place. */
std::uint32_t spread(std::uint32_t v) {
    v = (v | v << 16) & 0x030000FF;
    v = (v | v << 8) & 0x0300F00F;
    v = (v | v << 4) & 0x030C30C3;
    return (v | v << 2) & 0x09249249;
}

Eigen::AlignedBox3f boxOf(const Vertices& points, std::size_t first, std::size_t count) {
    Eigen::AlignedBox3f box;
    for (std::size_t i = first; i < first + count; ++i) box.extend(points[i].position);
    return box;
}

/** Positions of the points along the curve, with their index. */
std::vector<std::pair<std::uint32_t, std::uint32_t>> mortonOrder(const Vertices& points) {
    const auto box = boxOf(points, 0, points.size());
    const float scale = 1023 / std::max(box.sizes().maxCoeff(), 1e-6f);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Array3i cell = (scale * (points[i].position - box.min())).cast<int>();
        order[i] = {spread(cell.x()) | spread(cell.y()) << 1 | spread(cell.z()) << 2, i};
    }
    std::sort(order.begin(), order.end());
    return order;
}

/** Fisher-Yates; std::shuffle differs between libraries. */
template <class Iterator>
void shuffle(Iterator first, std::size_t count, std::mt19937& random) {
    for (std::size_t i = count; i > 1; --i) std::swap(first[i - 1], first[random() % i]);
}

bool inSight(const PointChunk& chunk, const Eigen::Matrix4d& clip_from_world) {
    const Eigen::Vector4d w = clip_from_world.row(3);
    for (int axis = 0; axis < 2; ++axis) {
        for (const int side : {-1, 1}) {
            const Eigen::Vector4d plane = w + side * clip_from_world.row(axis).transpose();
            const double distance = plane.dot(chunk.center.homogeneous());
            if (distance < -chunk.radius_m * plane.head<3>().norm()) return false;
        }
    }
    return w.dot(chunk.center.homogeneous()) > -chunk.radius_m;
}

}  // namespace

ChunkedPoints chunked(Vertices points, std::size_t points_a_chunk) {
    ChunkedPoints cloud;
    auto order = mortonOrder(points);
    std::mt19937 random(1);
    cloud.points.reserve(points.size());
    for (std::size_t first = 0; first < points.size(); first += points_a_chunk) {
        const std::size_t count = std::min(points_a_chunk, points.size() - first);
        shuffle(order.begin() + static_cast<std::ptrdiff_t>(first), count, random);
        for (std::size_t i = first; i < first + count; ++i) {
            cloud.points.push_back(points[order[i].second]);
        }
        const auto box = boxOf(cloud.points, first, count);
        cloud.chunks.push_back(
            {first, count, box.center().cast<double>(), 0.5 * box.diagonal().norm()});
    }
    return cloud;
}

void shufflePoints(Vertices& points) {
    std::mt19937 random(1);
    shuffle(points.begin(), points.size(), random);
}

PointChunk chunkOf(const Vertices& points, std::size_t first) {
    const auto box = boxOf(points, 0, points.size());
    return {first, points.size(), box.center().cast<double>(), 0.5 * box.diagonal().norm()};
}

std::vector<std::size_t> usefulPoints(const std::vector<PointChunk>& chunks,
                                      const OrbitCamera& camera, const Eigen::Vector2i& size_px) {
    const Eigen::Matrix4d clip_from_world = camera.clipFromWorld(size_px);
    const Eigen::Vector3d eye = camera.eye();
    const double focal_px = OrbitCamera::focalPx(size_px.y());
    std::vector<std::size_t> useful;
    for (const PointChunk& chunk : chunks) {
        if (!inSight(chunk, clip_from_world)) {
            useful.push_back(0);
            continue;
        }
        const double nearest_m = std::max((chunk.center - eye).norm() - chunk.radius_m, 1e-3);
        const double radius_px = focal_px * chunk.radius_m / nearest_m;
        const double wanted = 1 + useful_points_a_pixel * M_PI * radius_px * radius_px;
        useful.push_back(
            static_cast<std::size_t>(std::min(wanted, static_cast<double>(chunk.count))));
    }
    return useful;
}

std::vector<DrawRange> slice(const std::vector<PointChunk>& chunks,
                             const std::vector<std::size_t>& useful, double from_share,
                             double to_share) {
    std::vector<DrawRange> ranges;
    for (std::size_t c = 0; c < useful.size(); ++c) {
        const auto n = static_cast<double>(useful[c]);
        const auto from = static_cast<std::size_t>(std::ceil(from_share * n));
        const auto to = static_cast<std::size_t>(std::ceil(to_share * n));
        if (to > from) ranges.push_back({chunks[c].first + from, to - from});
    }
    return ranges;
}

}  // namespace rgbd_graphslam
