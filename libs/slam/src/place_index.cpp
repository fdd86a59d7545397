#include "rgbd_graphslam/slam/place_index.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <iterator>

#include "popcount.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr int tree_count = 4;
constexpr int descriptor_bits = 256;
constexpr std::size_t leaf_capacity = 80;
/** A bit that splits worse than this says too little. */
constexpr double most_unbalanced = 0.3;
/** Leaves take memory in pieces of so many entries: doubling would leave a third of it idle, and
 *  sizes of all kinds leave holes that nothing fits. */
constexpr std::size_t entries_at_once = 16;
/** One round of sweeping takes so many keyframes. */
constexpr std::size_t sweep_keyframes = 64;
constexpr std::size_t least_node_bytes = sizeof(std::int16_t) + sizeof(std::uint32_t);

struct Entry {
    Descriptor descriptor;
    int keyframe;
};

bool bitOf(const Descriptor& descriptor, int bit) {
    return (descriptor[bit / 64] >> (bit % 64)) & 1;
}

RGBD_WITH_POPCOUNT
void voteInLeaf(const std::vector<Entry>& leaf, const Descriptor& query, int max_hamming,
                int query_index, std::vector<int>& last_voter, std::vector<int>& votes) {
    for (const Entry& entry : leaf) {
        if (last_voter[entry.keyframe] == query_index) continue;
        if (hammingDistance(entry.descriptor, query) > max_hamming) continue;
        last_voter[entry.keyframe] = query_index;
        ++votes[entry.keyframe];
    }
}

using BitCounts = std::array<int, descriptor_bits>;

/** How many of the entries have each of the bits first_bit, first_bit + 4, ... set. Sixteen bits of
 *  a word are counted at once, in four binary digits each, up to fifteen entries at a time. */
BitCounts countOnes(const std::vector<Entry>& entries, int first_bit) {
    static_assert(tree_count == 4);
    constexpr std::uint64_t every_fourth = 0x1111111111111111;
    constexpr std::size_t most_in_four_digits = 15;
    BitCounts ones{};
    for (std::size_t begin = 0; begin < entries.size(); begin += most_in_four_digits) {
        const std::size_t end = std::min(begin + most_in_four_digits, entries.size());
        Descriptor counts{};
        for (std::size_t e = begin; e < end; ++e) {
            for (int w = 0; w < 4; ++w) {
                counts[w] += (entries[e].descriptor[w] >> first_bit) & every_fourth;
            }
        }
        for (int bit = first_bit; bit < descriptor_bits; bit += tree_count) {
            ones[bit] += (counts[bit / 64] >> (bit - first_bit) % 64) & most_in_four_digits;
        }
    }
    return ones;
}

}  // namespace

/** Uses the bits that are `first_bit` modulo the number of trees. */
struct PlaceIndex::Tree {
    struct Node {
        int bit = -1;  // -1 = leaf
        int child[2] = {-1, -1};
        std::size_t splits_at = leaf_capacity;
        std::vector<Entry> entries;
        /** Entries of erased keyframes that were there when this was saved; they only count. */
        std::size_t forgotten = 0;

        std::size_t size() const { return entries.size() + forgotten; }
        void add(const Entry& entry) {
            if (entries.size() == entries.capacity()) {
                entries.reserve(entries.size() + entries_at_once);
            }
            entries.push_back(entry);
        }
        void forget(const std::vector<char>& erased) {
            const auto is_erased = [&](const Entry& e) { return erased[e.keyframe] != 0; };
            entries.erase(std::remove_if(entries.begin(), entries.end(), is_erased), entries.end());
            forgotten = 0;
        }
        /** Gives back pieces that are not needed. */
        void fit() {
            const std::size_t pieces = (entries.size() + entries_at_once - 1) / entries_at_once;
            if (entries.capacity() <= pieces * entries_at_once) return;
            std::vector<Entry> fitting;
            fitting.reserve(pieces * entries_at_once);
            fitting.assign(entries.begin(), entries.end());
            entries = std::move(fitting);
        }
    };
    explicit Tree(int first) : first_bit(first), nodes(1) {}

    int leafOf(const Descriptor& descriptor) const {
        int node = 0;
        while (nodes[node].bit >= 0) node = nodes[node].child[bitOf(descriptor, nodes[node].bit)];
        return node;
    }

    void insert(const Entry& entry, const std::vector<char>& erased) {
        const int leaf = leafOf(entry.descriptor);
        nodes[leaf].add(entry);
        if (nodes[leaf].size() <= nodes[leaf].splits_at) return;
        nodes[leaf].forget(erased);
        if (nodes[leaf].entries.size() > nodes[leaf].splits_at) split(leaf);
    }

    /** Frees what erased keyframes left in some of the leaves, others from call to call. */
    void sweep(const std::vector<char>& erased) {
        for (std::size_t i = 0; i < nodes.size() / sweep_keyframes + 1; ++i) {
            swept = (swept + 1) % nodes.size();
            nodes[swept].forget(erased);
            nodes[swept].fit();
        }
    }

    void split(int leaf) {
        const std::vector<Entry> entries = std::move(nodes[leaf].entries);
        const int bit = mostBalancedBit(entries);
        if (bit < 0) {
            nodes[leaf].splits_at = 2 * entries.size();
            nodes[leaf].entries = entries;
            return;
        }
        const int first_child = static_cast<int>(nodes.size());
        nodes.resize(nodes.size() + 2);
        nodes[leaf].bit = bit;
        for (const int side : {0, 1}) nodes[leaf].child[side] = first_child + side;
        for (const Entry& entry : entries) {
            nodes[first_child + bitOf(entry.descriptor, bit)].add(entry);
        }
    }

    int mostBalancedBit(const std::vector<Entry>& entries) const {
        const BitCounts ones = countOnes(entries, first_bit);
        int best = -1;
        double best_imbalance = most_unbalanced;
        for (int bit = first_bit; bit < descriptor_bits; bit += tree_count) {
            const double share = static_cast<double>(ones[bit]) / entries.size();
            const double imbalance = std::abs(share - 0.5);
            if (imbalance < best_imbalance) {
                best_imbalance = imbalance;
                best = bit;
            }
        }
        return best;
    }

    /** How the nodes divide; of the entries only how many are forgotten. */
    void saveShape(ByteWriter& out, const std::vector<char>& erased) const {
        out.putCount(swept);
        out.putCount(nodes.size());
        for (const Node& node : nodes) {
            out.put<std::int16_t>(node.bit);
            if (node.bit >= 0) {
                out.putCount(node.child[0]);
                continue;
            }
            out.putCount(node.splits_at);
            out.putCount(node.forgotten +
                         std::count_if(node.entries.begin(), node.entries.end(),
                                       [&](const Entry& e) { return erased[e.keyframe] != 0; }));
        }
    }

    void loadShape(ByteReader& in) {
        swept = in.get<std::uint32_t>();
        nodes.resize(in.getCount(least_node_bytes));
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            Node& node = nodes[i];
            node.bit = in.get<std::int16_t>();
            if (node.bit >= descriptor_bits) throw DamagedBytes("a bit beyond a descriptor");
            if (node.bit >= 0) {
                node.child[0] = getIndex(in, nodes.size() - 1, "node");
                node.child[1] = node.child[0] + 1;
                if (node.child[0] <= static_cast<int>(i)) throw DamagedBytes("a tree with a loop");
                continue;
            }
            node.splits_at = in.get<std::uint32_t>();
            node.forgotten = in.get<std::uint32_t>();
            if (node.forgotten > node.splits_at) throw DamagedBytes("a leaf with too much");
        }
        if (nodes.empty()) throw DamagedBytes("a tree without a root");
        if (swept >= nodes.size()) throw DamagedBytes("a sweep beyond a tree");
    }

    int first_bit;
    std::size_t swept = 0;  // the last node that sweep() visited
    std::vector<Node> nodes;
};

PlaceIndex::PlaceIndex(int max_hamming) : max_hamming_(max_hamming) {
    for (int t = 0; t < tree_count; ++t) trees_.push_back(std::make_unique<Tree>(t));
}

PlaceIndex::~PlaceIndex() = default;

void PlaceIndex::insert(int keyframe, const std::vector<Descriptor>& descriptors) {
    erased_.resize(keyframe + 1, false);
    for (auto& tree : trees_) {
        for (const Descriptor& descriptor : descriptors) {
            tree->insert({descriptor, keyframe}, erased_);
        }
        tree->sweep(erased_);
    }
}

void PlaceIndex::insertAll(const std::vector<std::vector<Descriptor>>& descriptors) {
    erased_.resize(descriptors.size(), false);
    std::vector<std::future<void>> growing;
    for (auto& tree : trees_) {
        growing.push_back(std::async(std::launch::async, [&] {
            for (std::size_t k = 0; k < descriptors.size(); ++k) {
                for (const Descriptor& d : descriptors[k]) {
                    tree->insert({d, static_cast<int>(k)}, erased_);
                }
            }
        }));
    }
    for (auto& done : growing) done.get();
}

void PlaceIndex::save(ByteWriter& out) const {
    out.putCount(erased_.size());
    for (const char erased : erased_) putFlag(erased, out);
    for (const auto& tree : trees_) tree->saveShape(out, erased_);
    std::vector<Entry> known;  // every tree has the same
    for (const Tree::Node& node : trees_.front()->nodes) {
        std::copy_if(node.entries.begin(), node.entries.end(), std::back_inserter(known),
                     [&](const Entry& e) { return !erased_[e.keyframe]; });
    }
    out.putCount(known.size());
    for (const Entry& entry : known) {
        put(entry.descriptor, out);
        out.putCount(entry.keyframe);
    }
}

void PlaceIndex::load(ByteReader& in, std::size_t keyframes) {
    erased_.resize(in.getCount(1));
    if (erased_.size() > keyframes) throw DamagedBytes("places of keyframes that are not there");
    for (char& erased : erased_) erased = getFlag(in);
    for (auto& tree : trees_) tree->loadShape(in);
    const std::size_t known = in.getCount(sizeof(Descriptor) + sizeof(std::uint32_t));
    for (std::size_t i = 0; i < known; ++i) {
        const Descriptor descriptor = getDescriptor(in);
        const Entry entry{descriptor, getIndex(in, erased_.size(), "keyframe")};
        for (auto& tree : trees_) tree->nodes[tree->leafOf(descriptor)].add(entry);
    }
}

void PlaceIndex::erase(int keyframe) {
    if (keyframe >= static_cast<int>(erased_.size())) erased_.resize(keyframe + 1, false);
    erased_[keyframe] = true;
}

std::vector<PlaceVote> PlaceIndex::query(const std::vector<Descriptor>& descriptors) const {
    const int keyframes = static_cast<int>(erased_.size());
    std::vector<int> last_voter(keyframes, -1), votes(keyframes, 0);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        for (const auto& tree : trees_) {
            const auto& leaf = tree->nodes[tree->leafOf(descriptors[i])].entries;
            voteInLeaf(leaf, descriptors[i], max_hamming_, static_cast<int>(i), last_voter, votes);
        }
    }
    std::vector<PlaceVote> result;
    for (int k = 0; k < keyframes; ++k) {
        if (votes[k] && !erased_[k]) result.push_back({k, votes[k]});
    }
    std::sort(result.begin(), result.end(), [](const PlaceVote& a, const PlaceVote& b) {
        return a.votes != b.votes ? a.votes > b.votes : a.keyframe < b.keyframe;
    });
    return result;
}

}  // namespace rgbd_graphslam
