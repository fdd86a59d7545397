/** Runs that start from a map, and maps that are made again, killed at any moment: no map that was
 *  there is lost. */
#include <gtest/gtest.h>

#include <chrono>

#include "killed_runs.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

constexpr int kills = 15;
constexpr double turn_rad = 0.03;

/** Done into a folder OUT that holds the results of an earlier run. */
struct Work {
    std::string name, program, arguments;  // % = the folder of all files
    std::string mesh_before;               // arguments of rgbd-map, done to the earlier results
};

/** Arguments of rgbd-slam. */
std::string slam(const std::string& arguments) {
    return inQuotes(RGBD_SOURCE_DIR "/ini/default.ini") + " " + arguments +
           " --quiet --set MapOptions.octree_resolution_m=0.1";
}

void PrintTo(const Work& work, std::ostream* out) {
    *out << work.name;
}

class FaultReuse : public ::testing::TestWithParam<Work> {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TestFolder;
        writeFilm(*folder_ / "first.rawlog", 0, 8, turn_rad);
        writeFilm(*folder_ / "second.rawlog", 4, 14, turn_rad);
        expectDone("rgbd-slam", slam("%first.rawlog -o %map"), "");
        map_ = new Files(filesIn(*folder_ / "map"));
    }
    static void TearDownTestSuite() {
        delete map_;
        delete folder_;
    }

    void SetUp() override {
        fs::copy(*folder_ / "map", *folder_ / "earlier");
        const Work& work = GetParam();
        if (!work.mesh_before.empty()) expectDone("rgbd-map", work.mesh_before, "earlier");
        earlier_ = filesIn(*folder_ / "earlier");
        restoreEarlier();
        const auto start = std::chrono::steady_clock::now();
        expectDone(work.program, work.arguments, "out");
        run_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        finished_ = filesIn(*folder_ / "out");
    }
    void TearDown() override {
        for (const char* name : {"earlier", "out"}) fs::remove_all(*folder_ / name);
    }

    static std::string filledIn(const std::string& arguments, const std::string& out) {
        std::string words;
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const bool is_out = arguments.compare(i, 3, "OUT") == 0;
            if (is_out) i += 2;
            words += is_out                ? *folder_ / out
                     : arguments[i] == '%' ? *folder_ / ""
                                           : std::string(1, arguments[i]);
        }
        return words;
    }
    static void expectDone(const std::string& program, const std::string& arguments,
                           const std::string& out) {
        const ProgramResult result = runProgram(program, filledIn(arguments, out));
        EXPECT_EQ(result.exit_code, 0) << result.err;
    }
    void restoreEarlier() const {
        fs::remove_all(*folder_ / "out");
        fs::copy(*folder_ / "earlier", *folder_ / "out");
    }
    void killWorkAfter(double delay_s) const {
        killAfter(delay_s, GetParam().program, filledIn(GetParam().arguments, "out"));
    }

    static TestFolder* folder_;
    static Files* map_;
    Files earlier_, finished_;
    double run_s_ = 0;
};

TestFolder* FaultReuse::folder_ = nullptr;
Files* FaultReuse::map_ = nullptr;

TEST_P(FaultReuse, killedAtAnyMoment) {
    KillMoments moments(run_s_);
    int unfinished = 0;
    for (int i = 0; i < kills; ++i) {
        restoreEarlier();
        killWorkAfter(moments.next());
        const LeftBehind left(filesIn(*folder_ / "out"), earlier_, finished_);
        left.expectOldOrNew();
        unfinished += !left.isFinished();
        if (left.isFinished()) moments.cameTooLate();
        expectDone("rgbd-slam", slam("%second.rawlog -o %found --no-maps --localize --map OUT"),
                   "out");
    }
    RecordProperty("killed_before_the_end", unfinished);
    EXPECT_GT(unfinished, kills / 5) << "hardly a run was killed before its end";
    EXPECT_EQ(filesIn(*folder_ / "map"), *map_);
    killWorkAfter(0.9 * run_s_);
    expectDone(GetParam().program, GetParam().arguments, "out");
    EXPECT_TRUE(temporariesIn(*folder_ / "out").empty()) << "left over from one that was killed";
}

INSTANTIATE_TEST_SUITE_P(
    Works, FaultReuse,
    testing::Values(
        Work{"Localized", "rgbd-slam", slam("%second.rawlog -o OUT --localize --map %map"), ""},
        Work{"Extended", "rgbd-slam", slam("%second.rawlog -o OUT --extend --map %map"), ""},
        Work{"ExtendedInItsPlace", "rgbd-slam", slam("%second.rawlog -o OUT --extend --map OUT"),
             ""},
        Work{"Meshed", "rgbd-slam", slam("%second.rawlog -o OUT --set MapOptions.mesh_voxel_m=0.1"),
             "OUT --mesh 0.05 -q"},
        Work{"MeshedAgain", "rgbd-map", "OUT --mesh 0.1 --octree 0.2 -q", "OUT --mesh 0.05 -q"},
        Work{"MeshGone", "rgbd-map", "OUT --points 0.02 -q", "OUT --mesh 0.05 -q"}),
    [](const auto& work) { return work.param.name; });

}  // namespace
}  // namespace rgbd_graphslam
