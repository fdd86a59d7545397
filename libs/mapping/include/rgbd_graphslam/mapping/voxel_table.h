/** Sparse voxels: a hash table from integer coordinates to cells. */
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rgbd_graphslam/mapping/chunked_vector.h"

namespace rgbd_graphslam {

/** Integer coordinates of a voxel; the voxel spans [x, x + 1) times the voxel's edge. */
struct VoxelIndex {
    int x = 0, y = 0, z = 0;
};

/** Voxel coordinates are kept within +-2^20. */
constexpr int voxel_index_limit = 1 << 20;

inline std::uint64_t voxelKey(const VoxelIndex& v) {
    const auto part = [](std::int64_t i) {
        return static_cast<std::uint64_t>(i + voxel_index_limit);
    };
    return part(v.x) << 42 | part(v.y) << 21 | part(v.z);
}

inline VoxelIndex voxelOfKey(std::uint64_t key) {
    const auto part = [&](int shift) {
        return static_cast<int>(key >> shift & 0x1fffff) - voxel_index_limit;
    };
    return {part(42), part(21), part(0)};
}

/** Two levels: cubes of 4 x 4 x 4 voxels in a hash table with linear probing, cells within. Images
 *  ask for neighbors one after the other, which then mostly share a cube. Entries stay in order of
 *  insertion, so that everything made from them is the same each run. References stay
 * valid until clear(). */
template <class Cell>
class VoxelTable {
  public:
    struct Entry {
        std::uint64_t key;
        Cell cell;
    };

    /** The cell of a key; a new one is value-initialized. */
    Cell& operator[](std::uint64_t key) {
        Cube& home = cube(key);
        std::uint32_t& number = home.number[within(key)];
        if (number == 0) {
            entries_.push_back({key, Cell{}});
            number = static_cast<std::uint32_t>(entries_.size());
            home.filled |= std::uint64_t{1} << within(key);
        }
        return entries_[number - 1].cell;
    }

    const Cell* find(std::uint64_t key) const {
        if (slots_.empty()) return nullptr;
        const std::uint32_t found = slots_[slotOf(key & cube_bits)];
        const std::uint32_t number = found ? cubes_[found - 1].number[within(key)] : 0;
        return number ? &entries_[number - 1].cell : nullptr;
    }

    /** Calls visit(index, cell) for the entries of a box, both corners included: one search a cube
     *  instead of one a voxel. */
    template <class Visit>
    void forEachWithin(const VoxelIndex& low, const VoxelIndex& high, Visit&& visit) const {
        if (slots_.empty()) return;
        for (int x = low.x & ~3; x <= high.x; x += 4) {
            for (int y = low.y & ~3; y <= high.y; y += 4) {
                for (int z = low.z & ~3; z <= high.z; z += 4) {
                    const std::uint32_t found = slots_[slotOf(voxelKey({x, y, z}))];
                    if (found) visitCube(cubes_[found - 1], {x, y, z}, low, high, visit);
                }
            }
        }
    }

    const ChunkedVector<Entry>& entries() const { return entries_; }

    /** Keeps the memory for the next use. */
    void clear() {
        entries_.clear();
        cubes_.clear();
        slots_.assign(slots_.size(), 0);
        last_ = 0;
    }

    std::size_t bytes() const {
        return entries_.bytes() + cubes_.bytes() + slots_.capacity() * sizeof(slots_[0]);
    }

  private:
    struct Cube {
        std::uint64_t key;
        std::uint64_t filled = 0;                // a bit for each number that is not 0
        std::array<std::uint32_t, 64> number{};  // of the entry, from 1; 0 = empty
    };
    static constexpr std::uint64_t low_bits = 3ull << 42 | 3ull << 21 | 3ull;
    static constexpr std::uint64_t cube_bits = ~low_bits;

    static std::size_t within(std::uint64_t key) {
        return (key >> 38 & 48) | (key >> 19 & 12) | (key & 3);
    }

    /** Bits of the voxels of a cube that lie in a box. */
    static std::uint64_t bitsWithin(const VoxelIndex& corner, const VoxelIndex& low,
                                    const VoxelIndex& high) {
        constexpr std::uint64_t each_column = 0x1111111111111111, each_layer = 0x0001000100010001;
        const auto range = [](int from, int to, int bits) {
            const int first = std::max(from, 0) * bits, end = (std::min(to, 3) + 1) * bits;
            return ~std::uint64_t{0} << first & ~std::uint64_t{0} >> (64 - end);
        };
        return range(low.x - corner.x, high.x - corner.x, 16) &
               each_layer * range(low.y - corner.y, high.y - corner.y, 4) &
               each_column * range(low.z - corner.z, high.z - corner.z, 1);
    }

    template <class Visit>
    void visitCube(const Cube& cube, const VoxelIndex& corner, const VoxelIndex& low,
                   const VoxelIndex& high, Visit& visit) const {
        std::uint64_t left = cube.filled & bitsWithin(corner, low, high);
        for (; left != 0; left &= left - 1) {
            const int i = __builtin_ctzll(left);
            visit(VoxelIndex{corner.x + (i >> 4), corner.y + (i >> 2 & 3), corner.z + (i & 3)},
                  entries_[cube.number[i] - 1].cell);
        }
    }

    Cube& cube(std::uint64_t key) {
        const std::uint64_t cube_key = key & cube_bits;
        if (last_ < cubes_.size() && cubes_[last_].key == cube_key) return cubes_[last_];
        if (2 * (cubes_.size() + 1) > slots_.size()) grow();
        std::uint32_t& slot = slots_[slotOf(cube_key)];
        if (slot == 0) {
            cubes_.push_back({cube_key, {}});
            slot = static_cast<std::uint32_t>(cubes_.size());
        }
        last_ = slot - 1;
        return cubes_[last_];
    }

    std::size_t slotOf(std::uint64_t cube_key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t slot = (cube_key * 0x9E3779B97F4A7C15ull >> 32) & mask;
        while (slots_[slot] && cubes_[slots_[slot] - 1].key != cube_key) slot = (slot + 1) & mask;
        return slot;
    }

    void grow() {
        slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), 0);
        for (std::size_t i = 0; i < cubes_.size(); ++i) {
            slots_[slotOf(cubes_[i].key)] = static_cast<std::uint32_t>(i + 1);
        }
    }

    std::vector<std::uint32_t> slots_;  // number of the cube, from 1; 0 = empty
    ChunkedVector<Cube> cubes_;
    ChunkedVector<Entry> entries_;
    std::size_t last_ = 0;  // cube asked for last
};

}  // namespace rgbd_graphslam
