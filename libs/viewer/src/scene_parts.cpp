#include "rgbd_graphslam/viewer/scene_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_set>

namespace rgbd_graphslam {
namespace {

constexpr float grid_height_m = 0.01f;
constexpr float free_at_least = 0.6f, occupied_at_most = 0.4f;
constexpr Rgba free_color = {214, 219, 226, 255}, occupied_color = {14, 16, 20, 255};

void addLine(Vertices& lines, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
             const Rgba& color) {
    lines.push_back({a.cast<float>(), color});
    lines.push_back({b.cast<float>(), color});
}

/** Two triangles. \param corners in order round the quadrangle */
void addQuad(Vertices& triangles, const std::array<Eigen::Vector3f, 4>& corners,
             const Rgba& color) {
    for (const int i : {0, 1, 2, 0, 2, 3}) triangles.push_back({corners[i], color});
}

void addFrustum(Vertices& lines, const SE3& T, const Camera& camera, double depth_m,
                const Rgba& color) {
    const double w = camera.width - 1, h = camera.height - 1;
    const Eigen::Vector3d corners[] = {
        T * camera.unproject(0, 0, depth_m), T * camera.unproject(w, 0, depth_m),
        T * camera.unproject(w, h, depth_m), T * camera.unproject(0, h, depth_m)};
    for (int i = 0; i < 4; ++i) {
        addLine(lines, T.t, corners[i], color);
        addLine(lines, corners[i], corners[(i + 1) % 4], color);
    }
}

/** Cells by size and place; those of an octree lie in one another's grid. */
class CellIndex {
  public:
    explicit CellIndex(const std::vector<OctreeCell>& cells) {
        for (const OctreeCell& cell : cells) {
            const int level = levelOf(cell);
            keys_.insert(keyOf(level, placeOf(cell)));
            finest_ = std::min(finest_, level);
            coarsest_ = std::max(coarsest_, level);
        }
    }
    /** Whether other cells touch all of a side. \param side -1 or 1 along the axis */
    bool covers(const OctreeCell& cell, int axis, int side) const {
        const int level = levelOf(cell);
        const Place beside = placeOf(cell) + side * Place::Unit(axis);
        return insideOne(level, beside) || filled(level, beside, axis, side);
    }

  private:
    using Place = Eigen::Vector3i;

    static int levelOf(const OctreeCell& cell) { return std::ilogb(cell.size_m); }
    static Place placeOf(const OctreeCell& cell) {
        return (cell.center / cell.size_m).array().floor().cast<int>();
    }
    /** Twenty bits an axis, four for the size. */
    static std::uint64_t keyOf(int level, const Place& place) {
        std::uint64_t key = static_cast<std::uint64_t>(level) & 15;
        for (const int p : place) key = key << 20 | (static_cast<std::uint64_t>(p) & 0xFFFFF);
        return key;
    }
    bool has(int level, const Place& place) const { return keys_.count(keyOf(level, place)) > 0; }

    /** A cell of this size or a larger one. */
    bool insideOne(int level, Place place) const {
        for (; level <= coarsest_; ++level) {
            if (has(level, place)) return true;
            for (int& p : place) p >>= 1;
        }
        return false;
    }
    /** The side that is turned to the asker, by cells of this size or smaller ones. */
    bool filled(int level, const Place& place, int axis, int side) const {
        if (has(level, place)) return true;
        if (level <= finest_) return false;
        for (int quarter = 0; quarter < 4; ++quarter) {
            Place child = 2 * place;
            child[axis] += side < 0 ? 1 : 0;
            child[(axis + 1) % 3] += quarter & 1;
            child[(axis + 2) % 3] += quarter >> 1;
            if (!filled(level - 1, child, axis, side)) return false;
        }
        return true;
    }

    std::unordered_set<std::uint64_t> keys_;
    int finest_ = std::numeric_limits<int>::max(), coarsest_ = std::numeric_limits<int>::min();
};

void addFace(Vertices& triangles, const OctreeCell& cell, int axis, int side) {
    const float half = cell.size_m / 2;
    Eigen::Vector3f across = Eigen::Vector3f::Zero(), along = across, out = across;
    out[axis] = side * half;
    across[(axis + 1) % 3] = half;
    along[(axis + 2) % 3] = half;
    const Eigen::Vector3f center = cell.center + out;
    addQuad(triangles,
            {center - across - along, center + across - along, center + across + along,
             center - across + along},
            {cell.rgb[0], cell.rgb[1], cell.rgb[2], 255});
}

enum class CellKind { Unseen, Free, Occupied };

CellKind kindOf(float probability_free) {
    if (probability_free > free_at_least) return CellKind::Free;
    return probability_free < occupied_at_most ? CellKind::Occupied : CellKind::Unseen;
}

/** Cells [x0, x1) of a row. */
void addGridRun(Vertices& triangles, const GridMap& grid, int y, int x0, int x1, CellKind kind) {
    const auto corner = [&](int cx, int cy) {
        return Eigen::Vector3f(static_cast<float>(grid.x_min_m + cx * grid.resolution_m),
                               static_cast<float>(grid.y_min_m + cy * grid.resolution_m),
                               grid_height_m);
    };
    addQuad(triangles, {corner(x0, y), corner(x1, y), corner(x1, y + 1), corner(x0, y + 1)},
            kind == CellKind::Free ? free_color : occupied_color);
}

/** Triangles between the first vertices of cubes. */
Triangles clustered(const PlyModel& mesh, float cell_m) {
    std::map<std::array<int, 3>, std::uint32_t> firsts;
    std::vector<std::uint32_t> first_of;
    for (const Eigen::Vector3f& p : mesh.vertices) {
        const Eigen::Vector3i cell = (p / cell_m).array().floor().cast<int>();
        const auto index = static_cast<std::uint32_t>(first_of.size());
        first_of.push_back(
            firsts.emplace(std::array{cell.x(), cell.y(), cell.z()}, index).first->second);
    }
    Triangles triangles;
    for (const auto& [i, j, k] : mesh.triangles) {
        const std::uint32_t a = first_of[i], b = first_of[j], c = first_of[k];
        if (a != b && b != c && c != a) triangles.push_back({a, b, c});
    }
    return triangles;
}

}  // namespace

Vertices pathLines(const Trajectory& poses, const std::vector<double>& unplaced_s,
                   const Rgba& color) {
    Vertices lines;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        const bool gap = anyBetween(unplaced_s, poses[i - 1].stamp_s, poses[i].stamp_s);
        addLine(lines, poses[gap ? i : i - 1].T_world_cam.t, poses[i].T_world_cam.t, color);
    }
    return lines;
}

Vertices frustumLines(const Trajectory& cameras, const Camera& camera, double depth_m,
                      const Rgba& color) {
    Vertices lines;
    for (const StampedPose& pose : cameras) {
        addFrustum(lines, pose.T_world_cam, camera, depth_m, color);
    }
    return lines;
}

Vertices edgeLines(const Trajectory& keyframes, const std::vector<KeyframeEdge>& edges,
                   const Rgba& color) {
    Vertices lines;
    for (const KeyframeEdge& edge : edges) {
        addLine(lines, keyframes[edge.from].T_world_cam.t, keyframes[edge.to].T_world_cam.t, color);
    }
    return lines;
}

Vertices pairLines(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs,
                   const Rgba& color) {
    Vertices lines;
    for (const auto& [a, b] : pairs) addLine(lines, a, b, color);
    return lines;
}

Vertices floorLines(const FloorGrid& grid, const Rgba& color) {
    Vertices lines;
    const auto count = [&](double low, double high) {
        return std::lround((high - low) / grid.step_m);
    };
    for (long i = 0; i <= count(grid.x_min_m, grid.x_max_m); ++i) {
        const double x = grid.x_min_m + static_cast<double>(i) * grid.step_m;
        addLine(lines, {x, grid.y_min_m, 0}, {x, grid.y_max_m, 0}, color);
    }
    for (long i = 0; i <= count(grid.y_min_m, grid.y_max_m); ++i) {
        const double y = grid.y_min_m + static_cast<double>(i) * grid.step_m;
        addLine(lines, {grid.x_min_m, y, 0}, {grid.x_max_m, y, 0}, color);
    }
    return lines;
}

std::array<Vertices, 6> outerFaces(const std::vector<OctreeCell>& cells) {
    const CellIndex index(cells);
    std::array<Vertices, 6> faces;
    for (const OctreeCell& cell : cells) {
        for (int direction = 0; direction < 6; ++direction) {
            const int axis = direction / 2, side = direction % 2 == 0 ? -1 : 1;
            if (!index.covers(cell, axis, side)) addFace(faces[direction], cell, axis, side);
        }
    }
    return faces;
}

Vertices gridTriangles(const GridMap& grid) {
    Vertices triangles;
    for (int y = 0; y < grid.height; ++y) {
        const float* row = grid.free.data() + static_cast<std::size_t>(y) * grid.width;
        for (int x0 = 0, x1 = 0; x0 < grid.width; x0 = x1) {
            const CellKind kind = kindOf(row[x0]);
            while (x1 < grid.width && kindOf(row[x1]) == kind) ++x1;
            if (kind != CellKind::Unseen) addGridRun(triangles, grid, y, x0, x1, kind);
        }
    }
    return triangles;
}

Vertices pointVertices(const PointMap& points) {
    Vertices vertices;
    vertices.reserve(points.size());
    for (const auto& [p, rgb] : points) vertices.push_back({p, {rgb[0], rgb[1], rgb[2], 255}});
    return vertices;
}

Vertices meshVertices(const PlyModel& mesh) {
    const Eigen::Vector3f to_light = Eigen::Vector3f(0.35f, -0.5f, 0.8f).normalized();
    constexpr float shadow = 0.55f;
    Vertices vertices;
    vertices.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const float facing = mesh.normals.empty() ? 1 : mesh.normals[i].dot(to_light);
        const float light = shadow + (1 - shadow) * (0.5f + 0.5f * facing);
        const auto rgb =
            mesh.colors.empty() ? std::array<std::uint8_t, 3>{190, 190, 190} : mesh.colors[i];
        vertices.push_back(
            {mesh.vertices[i], {rgb[0], rgb[1], rgb[2], static_cast<std::uint8_t>(255 * light)}});
    }
    return vertices;
}

Triangles fewerTriangles(const PlyModel& mesh, std::size_t most) {
    constexpr float finest_m = 0.03f;
    Triangles fewer = mesh.triangles;
    for (float cell_m = finest_m; fewer.size() > most; cell_m *= 1.5f)
        fewer = clustered(mesh, cell_m);
    return fewer;
}

}  // namespace rgbd_graphslam
