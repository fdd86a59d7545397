#include "rgbd_graphslam/mapping/surface_nets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

namespace rgbd_graphslam {
namespace {

using Voxel = TsdfVolume::Voxel;
using Block = TsdfVolume::Block;
constexpr int block_size = TsdfVolume::block_size;

// A corner of a cell is numbered x | y << 1 | z << 2. An edge along an axis is numbered by the axis
// and by the place of its lower corner along the next two axes.
constexpr int corners = 8, edges = 12;

constexpr int next(int axis) {
    return (axis + 1) % 3;
}

struct Edge {
    int from, to;  // corners
};

constexpr Edge edgeOf(int number) {
    const int axis = number / 4, b = next(axis), c = next(b);
    const int from = (number & 1) << b | (number >> 1 & 1) << c;
    return {from, from | 1 << axis};
}

constexpr int edgeNumber(int axis, int corner) {
    const int b = next(axis), c = next(b);
    return 4 * axis + ((corner >> b & 1) | (corner >> c & 1) << 1);
}

int edgeBetween(int corner, int other) {
    const int bit = corner ^ other;
    return edgeNumber(bit == 1 ? 0 : bit == 2 ? 1 : 2, corner & other);
}

/** Of a cell: bit c is for corner c. */
struct CornerSigns {
    std::uint8_t known = 0;
    std::uint8_t behind = 0;  // the surface
};

/** Which crossed edges of a cell belong to the same sheet of surface. */
class Sheets {
  public:
    Sheets() = default;
    explicit Sheets(const CornerSigns& signs) : signs_(signs) {
        std::iota(sheet_.begin(), sheet_.end(), 0);
        for (int axis = 0; axis < 3; ++axis) {
            joinInFace(axis, 0);
            joinInFace(axis, 1 << axis);
        }
        number();
    }

    int count() const { return count_; }
    /** Whether the surface is known to cross an edge. */
    bool crosses(int edge) const {
        const auto [from, to] = edgeOf(edge);
        const bool known = (signs_.known >> from & 1) && (signs_.known >> to & 1);
        return known && isBehind(from) != isBehind(to);
    }
    /** From 0; of a crossed edge. */
    int of(int edge) const { return sheet_[edge]; }
    /** What is not seen is mostly hidden by surface. */
    bool isBehind(int corner) const { return (signs_.behind | ~signs_.known) >> corner & 1; }

  private:
    /** Cuts what lies behind off the face: walking round it, the edge where that begins and the one
     *  where it ends are on one sheet. Both cells at the face see it alike. */
    void joinInFace(int axis, int side) {
        const int b = 1 << next(axis), c = 1 << next(next(axis));
        const int round[] = {side, side | b, side | b | c, side | c};
        for (int i = 0; i < 4; ++i) {
            const int before = round[i], first = round[(i + 1) % 4];
            if (isBehind(before) || !isBehind(first)) continue;
            int last = i + 1;
            while (isBehind(round[(last + 1) % 4])) ++last;
            join(edgeBetween(before, first), edgeBetween(round[last % 4], round[(last + 1) % 4]));
        }
    }

    void join(int edge, int other) {
        const std::int8_t from = sheet_[edge], to = sheet_[other];
        std::replace(sheet_.begin(), sheet_.end(), from, to);
    }

    void number() {
        std::array<std::int8_t, edges> numbers;
        numbers.fill(-1);
        for (int e = 0; e < edges; ++e) {
            if (!crosses(e)) continue;
            std::int8_t& number = numbers[sheet_[e]];
            if (number < 0) number = count_++;
            sheet_[e] = number;
        }
    }

    CornerSigns signs_;
    std::int8_t count_ = 0;
    std::array<std::int8_t, edges> sheet_{};  // small: every cell at the surface keeps its own
};

/** A block's voxels and the first ones of the blocks after it. */
class Neighborhood {
  public:
    Neighborhood(const TsdfVolume::BlockTable& blocks, const VoxelIndex& index) {
        for (int i = 0; i < corners; ++i) {
            const auto* found = blocks.find(
                voxelKey({index.x + (i & 1), index.y + (i >> 1 & 1), index.z + (i >> 2)}));
            blocks_[i] = found ? found->get() : nullptr;
        }
    }

    /** Nothing where no view saw it. \param x,y,z from 0 to block_size */
    const Voxel* at(int x, int y, int z) const {
        const int far = (x / block_size) | (y / block_size) << 1 | (z / block_size) << 2;
        if (!blocks_[far]) return nullptr;
        constexpr int mask = block_size - 1;
        const Voxel& voxel = blocks_[far]->voxels[Block::indexOf(x & mask, y & mask, z & mask)];
        return voxel.weight > 0 ? &voxel : nullptr;
    }

  private:
    std::array<const Block*, corners> blocks_;
};

class SurfaceNets {
  public:
    SurfaceNets(const TsdfVolume::BlockTable& blocks, double voxel_m) : voxel_m_(voxel_m) {
        for (const auto& entry : blocks.entries()) addVertices(blocks, entry.key);
        for (const auto& entry : cells_.entries()) addFaces(voxelOfKey(entry.key), entry.cell);
    }

    PlyModel mesh() && { return std::move(mesh_); }

  private:
    struct Cell {
        std::uint32_t first_vertex = 0;  // one a sheet
        Sheets sheets;
    };
    /** Null where no view saw it. */
    using CellCorners = std::array<const Voxel*, corners>;

    void addVertices(const TsdfVolume::BlockTable& blocks, std::uint64_t block_key) {
        const VoxelIndex block = voxelOfKey(block_key);
        const Neighborhood voxels(blocks, block);
        for (int z = 0; z < block_size; ++z) {
            for (int y = 0; y < block_size; ++y) {
                for (int x = 0; x < block_size; ++x) {
                    CellCorners found;
                    for (int i = 0; i < corners; ++i)
                        found[i] = voxels.at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
                    addCell({block_size * block.x + x, block_size * block.y + y,
                             block_size * block.z + z},
                            found);
                }
            }
        }
    }

    static CornerSigns signsOf(const CellCorners& voxels) {
        CornerSigns signs;
        for (int i = 0; i < corners; ++i) {
            if (!voxels[i]) continue;
            signs.known |= 1 << i;
            if (voxels[i]->distance_m < 0) signs.behind |= 1 << i;
        }
        return signs;
    }

    void addCell(const VoxelIndex& index, const CellCorners& voxels) {
        const CornerSigns signs = signsOf(voxels);
        if (signs.behind == 0 || signs.behind == signs.known) return;
        const Sheets sheets(signs);
        if (sheets.count() == 0) return;
        cells_[voxelKey(index)] = {static_cast<std::uint32_t>(mesh_.vertices.size()), sheets};
        for (int sheet = 0; sheet < sheets.count(); ++sheet)
            addVertex(index, voxels, sheets, sheet);
    }

    void addVertex(const VoxelIndex& index, const CellCorners& voxels, const Sheets& sheets,
                   int sheet) {
        Eigen::Vector3f place = Eigen::Vector3f::Zero(), color = Eigen::Vector3f::Zero();
        int crossings = 0;
        for (int e = 0; e < edges; ++e) {
            if (!sheets.crosses(e) || sheets.of(e) != sheet) continue;
            const auto [from, to] = edgeOf(e);
            const Voxel &a = *voxels[from], &b = *voxels[to];
            const float share = a.distance_m / (a.distance_m - b.distance_m);
            place += placeOf(from) + share * (placeOf(to) - placeOf(from));
            color += colorBetween(a, b, share);
            ++crossings;
        }
        const auto n = static_cast<float>(crossings);
        const Eigen::Vector3d lower(index.x, index.y, index.z);
        mesh_.vertices.push_back((voxel_m_ * (lower + (place / n).cast<double>())).cast<float>());
        const Eigen::Vector3f bgr = (color / n).array() + 0.5f;
        mesh_.colors.push_back({static_cast<std::uint8_t>(bgr[2]),
                                static_cast<std::uint8_t>(bgr[1]),
                                static_cast<std::uint8_t>(bgr[0])});
    }

    static Eigen::Vector3f placeOf(int corner) {
        return Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2).cast<float>();
    }

    /** One of the two may have been seen from afar only, without surface nearby. */
    static Eigen::Vector3f colorBetween(const Voxel& a, const Voxel& b, float share) {
        if (a.color_views == 0) return colorOf(b);
        if (b.color_views == 0) return colorOf(a);
        return (1 - share) * colorOf(a) + share * colorOf(b);
    }

    static Eigen::Vector3f colorOf(const Voxel& voxel) {
        return Eigen::Vector3f(voxel.color[0], voxel.color[1], voxel.color[2]) /
               TsdfVolume::color_steps;
    }

    /** Those of the edges at a cell's lower corner, each in the middle of four cells. */
    void addFaces(const VoxelIndex& index, const Cell& cell) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!cell.sheets.crosses(edgeNumber(axis, 0))) continue;
            const auto around = verticesAround(index, axis);
            const bool leads_to_free_side = cell.sheets.isBehind(0);
            if (around) addQuad(*around, leads_to_free_side);
        }
    }

    /** Of the cells around the edge at a cell's lower corner, counter-clockwise as seen from where
     *  the axis points to; nothing beside the end of the known world. */
    std::optional<std::array<std::uint32_t, 4>> verticesAround(const VoxelIndex& index,
                                                               int axis) const {
        constexpr int back[4][2] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
        const int b = next(axis), c = next(b);
        std::array<std::uint32_t, 4> around;
        for (int i = 0; i < 4; ++i) {
            const auto [back_b, back_c] = back[i];
            std::array<int, 3> place{index.x, index.y, index.z};
            place[b] -= back_b;
            place[c] -= back_c;
            const Cell* cell = cells_.find(voxelKey({place[0], place[1], place[2]}));
            if (!cell) return std::nullopt;
            const int sheet = cell->sheets.of(edgeNumber(axis, back_b << b | back_c << c));
            around[i] = cell->first_vertex + static_cast<std::uint32_t>(sheet);
        }
        return around;
    }

    /** Two triangles, along the shorter diagonal; nothing where the surface known is but a line. */
    void addQuad(std::array<std::uint32_t, 4> corner, bool counter_clockwise) {
        if (!counter_clockwise) std::swap(corner[1], corner[3]);
        const auto diagonal = [&](int i) -> Eigen::Vector3f {
            return mesh_.vertices[corner[i + 2]] - mesh_.vertices[corner[i]];
        };
        constexpr float least_area = 1e-3f;  // in voxels' faces
        const auto voxel = static_cast<float>(voxel_m_);
        if (diagonal(0).cross(diagonal(1)).norm() < 2 * least_area * voxel * voxel) return;
        const int first = diagonal(0).squaredNorm() <= diagonal(1).squaredNorm() ? 0 : 1;
        const auto at = [&](int i) { return corner[(first + i) % 4]; };
        mesh_.triangles.push_back({at(0), at(1), at(2)});
        mesh_.triangles.push_back({at(0), at(2), at(3)});
    }

    double voxel_m_;
    VoxelTable<Cell> cells_;
    PlyModel mesh_;
};

}  // namespace

PlyModel surfaceOf(const TsdfVolume::BlockTable& blocks, double voxel_m) {
    return SurfaceNets(blocks, voxel_m).mesh();
}

}  // namespace rgbd_graphslam
