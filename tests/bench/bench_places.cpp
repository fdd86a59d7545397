/** Ways to recognize a place by binary descriptors: cost of a query and what it finds again. */
#include <benchmark/benchmark.h>

#include <bitset>
#include <random>
#include <unordered_map>

#include "rgbd_graphslam/slam/place_index.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

constexpr int descriptors_a_keyframe = 400;
const int max_hamming = LoopOptions().bits_hamming;

std::vector<Descriptor> place(int keyframe) {
    std::mt19937_64 random(keyframe + 1);
    std::vector<Descriptor> descriptors(descriptors_a_keyframe);
    for (Descriptor& d : descriptors) d = {random(), random(), random(), random()};
    return descriptors;
}

std::vector<Descriptor> seenAgain(int keyframe, int flips) {
    std::mt19937_64 random(~keyframe);
    auto descriptors = place(keyframe);
    for (Descriptor& d : descriptors) {
        for (int i = 0; i < flips; ++i) d[random() % 4] ^= std::uint64_t{1} << (random() % 64);
    }
    return descriptors;
}

int distance(const Descriptor& a, const Descriptor& b) {
    std::size_t bits = 0;
    for (int w = 0; w < 4; ++w) bits += std::bitset<64>(a[w] ^ b[w]).count();
    return static_cast<int>(bits);
}

/** What the alternatives have in common: one vote a descriptor and keyframe. */
class Poll {
  public:
    explicit Poll(int keyframes) : votes_(keyframes), voter_(keyframes, -1) {}
    void vote(int keyframe, int voter) {
        if (std::exchange(voter_[keyframe], voter) != voter) ++votes_[keyframe];
    }
    std::vector<PlaceVote> result() const {
        PlaceVote best;
        for (std::size_t k = 0; k < votes_.size(); ++k) {
            if (votes_[k] > best.votes) best = {static_cast<int>(k), votes_[k]};
        }
        return {best};
    }

  private:
    std::vector<int> votes_, voter_;
};

/** Locality-sensitive hashing (Indyk and Motwani 1998): tables keyed by a sample of the bits. */
class HashTables {
  public:
    explicit HashTables(int) {
        std::mt19937 random(5);
        for (auto& bits : bits_) {
            for (int& bit : bits) bit = static_cast<int>(random() % 256);
        }
    }
    void insert(int keyframe, const std::vector<Descriptor>& descriptors) {
        keyframes_ = keyframe + 1;
        for (const Descriptor& d : descriptors) {
            for (int t = 0; t < tables; ++t) table_[t][key(d, t)].push_back({d, keyframe});
        }
    }
    std::vector<PlaceVote> query(const std::vector<Descriptor>& descriptors) const {
        Poll poll(keyframes_);
        for (std::size_t i = 0; i < descriptors.size(); ++i) {
            for (int t = 0; t < tables; ++t) {
                const auto bucket = table_[t].find(key(descriptors[i], t));
                if (bucket == table_[t].end()) continue;
                for (const auto& [d, keyframe] : bucket->second) {
                    if (distance(d, descriptors[i]) <= max_hamming)
                        poll.vote(keyframe, static_cast<int>(i));
                }
            }
        }
        return poll.result();
    }

  private:
    static constexpr int tables = 4, key_bits = 16;
    std::uint32_t key(const Descriptor& d, int table) const {
        std::uint32_t key = 0;
        for (const int bit : bits_[table]) key = 2 * key + (d[bit / 64] >> (bit % 64) & 1);
        return key;
    }
    int bits_[tables][key_bits] = {};
    std::unordered_map<std::uint32_t, std::vector<std::pair<Descriptor, int>>> table_[tables];
    int keyframes_ = 0;
};

/** Every descriptor against every other: the most that can be found. */
class Exhaustive {
  public:
    explicit Exhaustive(int) {}
    void insert(int, const std::vector<Descriptor>& descriptors) {
        keyframes_.push_back(descriptors);
    }
    std::vector<PlaceVote> query(const std::vector<Descriptor>& descriptors) const {
        Poll poll(static_cast<int>(keyframes_.size()));
        for (std::size_t k = 0; k < keyframes_.size(); ++k) {
            for (std::size_t i = 0; i < descriptors.size(); ++i) {
                for (const Descriptor& d : keyframes_[k]) {
                    if (distance(d, descriptors[i]) > max_hamming) continue;
                    poll.vote(static_cast<int>(k), static_cast<int>(i));
                }
            }
        }
        return poll.result();
    }

  private:
    std::vector<std::vector<Descriptor>> keyframes_;
};

template <class Index>
void recognize(benchmark::State& state) {
    const int keyframes = static_cast<int>(state.range(0));
    Index index(max_hamming);
    for (int k = 0; k < keyframes; ++k) index.insert(k, place(k));
    const auto query = seenAgain(keyframes / 2, static_cast<int>(state.range(1)));
    std::vector<PlaceVote> votes;
    for (auto _ : state) votes = index.query(query);
    const bool right = !votes.empty() && votes[0].keyframe == keyframes / 2;
    state.counters["found_share"] =
        right ? static_cast<double>(votes[0].votes) / descriptors_a_keyframe : 0;
}

void sizesAndFlips(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({"keyframes", "flips"})->Unit(benchmark::kMillisecond);
    for (const int keyframes : {100, 1000, 10000}) {
        for (const int flips : {10, 20, 30}) bench->Args({keyframes, flips});
    }
}
BENCHMARK_TEMPLATE(recognize, PlaceIndex)->Apply(sizesAndFlips);
BENCHMARK_TEMPLATE(recognize, HashTables)->Apply(sizesAndFlips);
BENCHMARK_TEMPLATE(recognize, Exhaustive)
    ->ArgNames({"keyframes", "flips"})
    ->Args({100, 10})
    ->Args({100, 20})
    ->Args({100, 30})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rgbd_graphslam

BENCHMARK_MAIN();
