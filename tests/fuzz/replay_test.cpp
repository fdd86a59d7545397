/** The fuzzers' corpora, and each of their files cut short and with single bytes changed, without
 *  a fuzzer: runs with any compiler. */
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "../../libs/job/src/checkpoint.h"
#include "../support/tum_folder.h"
#include "fuzz_targets.h"
#include "rgbd_graphslam/job/sparse_map_file.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t places = 60;  // of each file, evenly spread

class FuzzReplay : public testing::TestWithParam<NamedTarget> {};

void addFilesOf(const fs::path& folder, std::vector<std::string>& texts) {
    if (!fs::exists(folder)) return;
    for (const auto& file : fs::directory_iterator(folder)) {
        texts.push_back(readText(file.path().string()));
    }
}

/** The corpus, or what is made where there is none, and what fuzzing has found. */
std::vector<std::string> seedsOf(const std::string& target) {
    const fs::path fuzz = fs::path(RGBD_SOURCE_DIR) / "tests/fuzz";
    std::vector<std::string> seeds;
    addFilesOf(fuzz / "corpus" / target, seeds);
    if (seeds.empty()) seeds = binarySeeds(target);
    addFilesOf(fuzz / "found" / target, seeds);
    std::sort(seeds.begin(), seeds.end());  // a folder has no order of its own
    return seeds;
}

/** Calls `use` with the place of every byte, or of as many as there is time for. */
template <class Use>
void forEachPlace(const std::string& text, Use use) {
    const std::size_t step = std::max<std::size_t>(1, text.size() / places);
    for (std::size_t at = 0; at < text.size(); at += step) use(at);
}

TEST_P(FuzzReplay, everySeed) {
    const auto seeds = seedsOf(GetParam().name);
    ASSERT_FALSE(seeds.empty());
    for (const std::string& seed : seeds) EXPECT_NO_THROW(GetParam().run(seed)) << seed;
}

/** A finding names its place or its round: it comes back only from the same bytes. */
TEST_P(FuzzReplay, seedsAreTheSameEveryTime) {
    const auto seeds = seedsOf(GetParam().name);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_TRUE(seedsOf(GetParam().name) == seeds);
}

TEST_P(FuzzReplay, cutAnywhere) {
    for (const std::string& seed : seedsOf(GetParam().name)) {
        forEachPlace(seed, [&](std::size_t at) {
            EXPECT_NO_THROW(GetParam().run(seed.substr(0, at))) << "cut at byte " << at;
        });
    }
}

TEST_P(FuzzReplay, oneByteChangedAnywhere) {
    for (const std::string& seed : seedsOf(GetParam().name)) {
        forEachPlace(seed, [&](std::size_t at) {
            for (const char byte : {'\0', '\xff', '-'}) {
                std::string changed = seed;
                changed[at] = byte;
                EXPECT_NO_THROW(GetParam().run(changed)) << "byte " << at << " set to " << +byte;
            }
        });
    }
}

/** Others with --gtest_shuffle --gtest_random_seed=N. */
TEST_P(FuzzReplay, someBytesChangedAtRandom) {
    std::mt19937 random(static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()));
    for (const std::string& seed : seedsOf(GetParam().name)) {
        for (std::size_t i = 0; i < places; ++i) {
            std::string changed = seed;
            for (auto changes = 1 + random() % 4; changes > 0; --changes) {
                changed[random() % changed.size()] = static_cast<char>(random());
            }
            EXPECT_NO_THROW(GetParam().run(changed)) << "round " << i;
        }
    }
}

/** What is written now must be read by what is called the same format, in this build and the next.
 */
TEST(CheckpointFormat, stateOfThisFormatIsReadAndWrittenTheSame) {
    const std::string name = "format-" + std::to_string(Checkpoint::format);
    const fs::path file = fs::path(RGBD_SOURCE_DIR) / "tests/fuzz/corpus/checkpoint" / name;
    const std::string state = readText(file.string());
    ASSERT_FALSE(state.empty()) << "see tests/fuzz/README.md for how to make " << file;
    EXPECT_TRUE(goneOnAndSaved(state) == state)
        << "the layout of checkpoints has changed: raise Checkpoint::format";
}

/** Maps that people have made stay readable. */
TEST(SparseMapFormat, everyVersionKeptIsRead) {
    const TestFolder folder;
    for (auto version = oldest_sparse_map_version; version <= sparse_map_version; ++version) {
        const std::string kept = "sparse_map/version-" + std::to_string(version);
        const fs::path corpus = fs::path(RGBD_SOURCE_DIR) / "tests/fuzz/corpus";
        folder.write("map.sparse", sparseMapFile(version, readText((corpus / kept).string())));
        const SparseMap map = readSparseMap(folder / "map.sparse");
        EXPECT_FALSE(map.snapshot.keyframes.empty()) << kept;
        EXPECT_FALSE(map.snapshot.landmarks.empty()) << kept;
        EXPECT_FALSE(map.sessions.empty()) << kept;
    }
}

INSTANTIATE_TEST_SUITE_P(Corpora, FuzzReplay, testing::ValuesIn(fuzzTargets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace rgbd_graphslam
