#include "rgbd_graphslam/mapping/octree_builder.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace rgbd_graphslam {
namespace {

constexpr int block_size = OccupancyVolume::block_size;
constexpr int block_level = 3;  // 2^3 = block_size
constexpr int tree_levels = 16;

octomap::OcTreeKey keyOf(const VoxelIndex& v) {
    constexpr int middle = 1 << (tree_levels - 1);
    const auto part = [](int i) { return static_cast<octomap::key_type>(i + middle); };
    return {part(v.x), part(v.y), part(v.z)};
}

std::uint8_t channel(float value) {
    return static_cast<std::uint8_t>(std::lround(value));
}

/** A tree that can be built from the root down: OctoMap makes a root only for a leaf. */
template <class Tree>
class GrownTree : public Tree {
  public:
    using Tree::Tree;
    void ensureRoot() {
        if (this->root) return;
        this->root = new typename Tree::NodeType();
        ++this->tree_size;
        this->size_changed = true;
    }
};

/** Adds blocks node by node, which spares the descent from the root for every leaf. */
template <class Tree>
class TreeBuilder {
  public:
    using Node = typename Tree::NodeType;
    static constexpr bool colored = std::is_same_v<Tree, octomap::ColorOcTree>;

    TreeBuilder(GrownTree<Tree>& tree, const OccupancyVolume& volume, LeafValues values)
        : tree_(tree), volume_(volume), values_(values) {}

    void run() {
        for (const auto& [key, block] : volume_.blocks().entries())
            addBlock(voxelOfKey(key), *block);
    }

  private:
    using Block = OccupancyVolume::Block;

    void addBlock(const VoxelIndex& index, const Block& block) {
        if (!anyKnown(block, {0, 0, 0}, block_size)) return;
        corner_ = {index.x * block_size, index.y * block_size, index.z * block_size};
        const octomap::OcTreeKey key = keyOf(corner_);
        tree_.ensureRoot();
        Node* node = tree_.getRoot();
        for (int level = tree_levels - 1; level >= block_level; --level) {
            node = child(node, octomap::computeChildIdx(key, level));
        }
        fill(node, block, {0, 0, 0}, block_size);
    }

    Node* child(Node* node, unsigned i) {
        return tree_.nodeChildExists(node, i) ? tree_.getNodeChild(node, i)
                                              : tree_.createNodeChild(node, i);
    }

    void fill(Node* node, const Block& block, const VoxelIndex& at, int size) {
        const std::int8_t first = block.log_odds[Block::indexOf(at.x, at.y, at.z)];
        if (size == 1 || (isMergeable(first) && isUniform(block, at, size)))
            return finish(node, first, at);
        const int half = size / 2;
        for (unsigned octant = 0; octant < 8; ++octant) {
            const VoxelIndex corner{at.x + (octant & 1 ? half : 0), at.y + (octant & 2 ? half : 0),
                                    at.z + (octant & 4 ? half : 0)};
            if (anyKnown(block, corner, half)) fill(child(node, octant), block, corner, half);
        }
    }

    void finish(Node* node, std::int8_t value, const VoxelIndex& at) {
        node->setLogOdds(logOdds(value));
        if constexpr (colored) {
            const auto bgr = volume_.color({corner_.x + at.x, corner_.y + at.y, corner_.z + at.z});
            if (bgr) node->setColor(channel((*bgr)[2]), channel((*bgr)[1]), channel((*bgr)[0]));
        }
    }

    float logOdds(std::int8_t value) const {
        if (values_ == LeafValues::Exact) return OccupancyVolume::log_odds_step * value;
        return value >= 0 ? tree_.getClampingThresMaxLog() : tree_.getClampingThresMinLog();
    }

    static bool isMergeable(std::int8_t value) { return !colored || value < 0; }

    template <class Predicate>
    static bool allOf(const Block& block, const VoxelIndex& at, int size, Predicate predicate) {
        for (int z = at.z; z < at.z + size; ++z) {
            for (int y = at.y; y < at.y + size; ++y) {
                const std::int8_t* row = &block.log_odds[Block::indexOf(at.x, y, z)];
                if (!std::all_of(row, row + size, predicate)) return false;
            }
        }
        return true;
    }

    static bool anyKnown(const Block& block, const VoxelIndex& at, int size) {
        return !allOf(block, at, size, [](int v) { return v == OccupancyVolume::unknown; });
    }

    bool isUniform(const Block& block, const VoxelIndex& at, int size) const {
        const std::int8_t first = block.log_odds[Block::indexOf(at.x, at.y, at.z)];
        if (first == OccupancyVolume::unknown) return false;
        if (values_ == LeafValues::Exact)
            return allOf(block, at, size, [&](int v) { return v == first; });
        return allOf(block, at, size, [&](int v) {
            return v != OccupancyVolume::unknown && (v >= 0) == (first >= 0);
        });
    }

    GrownTree<Tree>& tree_;
    const OccupancyVolume& volume_;
    LeafValues values_;
    VoxelIndex corner_;  // of the block at hand, in voxels
};

}  // namespace

std::unique_ptr<octomap::OcTree> toOcTree(const OccupancyVolume& volume, LeafValues values) {
    auto tree = std::make_unique<GrownTree<octomap::OcTree>>(volume.resolution());
    TreeBuilder<octomap::OcTree>(*tree, volume, values).run();
    tree->updateInnerOccupancy();
    tree->prune();
    return tree;
}

std::unique_ptr<octomap::ColorOcTree> toColorOcTree(const OccupancyVolume& volume) {
    auto tree = std::make_unique<GrownTree<octomap::ColorOcTree>>(volume.resolution());
    TreeBuilder<octomap::ColorOcTree>(*tree, volume, LeafValues::Exact).run();
    tree->updateInnerOccupancy();
    return tree;
}

}  // namespace rgbd_graphslam
