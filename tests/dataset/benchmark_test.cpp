/** rgbd-benchmark as a user runs it, alone and shared out by GNU parallel or Slurm. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/run_program.h"
#include "../support/textured_room.h"
#include "rgbd_graphslam/benchmark/sequence_result.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/tum_export.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int frames = 45;
constexpr double turn_rad = 0.02;

class BenchmarkProgram : public ::testing::Test {
  protected:
    /** Two folders with truth, a rawlog without, and an archive that is none. */
    static void SetUpTestSuite() {
        folder_ = new TestFolder;
        const std::string rawlog = path("in/c.rawlog");
        fs::create_directories(path("in"));
        writeRawlog(rawlog, RawlogStorage::Embedded, [](RawlogWriter& writer) {
            for (const auto& frame : filmRoundTrip(frames, turn_rad)) writer.write(*frame);
        });
        Trajectory truth;
        for (int i = 0; i < frames; ++i) {
            truth.push_back({room_start_s + i * room_period_s,
                             roundTrip(i, turn_rad) * T_optical_from_mrpt.inverse()});
        }
        for (const char* name : {"in/a", "in/b"}) {
            exportTumSequence(rawlog, path(name), {});
            writeTextAtomically(path(name) + "/groundtruth.txt", toTumText(truth));
        }
    }
    static void TearDownTestSuite() { delete folder_; }

    static std::string path(const std::string& name) { return *folder_ / name; }

    static ProgramResult benchmark(const std::string& out, const std::string& more = "") {
        return runProgram("rgbd-benchmark",
                          "'" + path("in") + "' -o '" + path(out) + "' --no-maps " + more);
    }

    static SequenceResult resultOf(const std::string& folder) {
        const auto result = readResult(path(folder));
        EXPECT_TRUE(result) << folder;
        return result.value_or(SequenceResult{});
    }

    static void expectAllReported(const std::string& out) {
        const std::string report = readText(path(out) + "/report.md");
        EXPECT_THAT(report, HasSubstr("3 sequences"));
        for (const char* name : {"| a |", "| b |", "| c |"}) EXPECT_THAT(report, HasSubstr(name));
    }

    static TestFolder* folder_;
};

TestFolder* BenchmarkProgram::folder_ = nullptr;

TEST_F(BenchmarkProgram, everySequenceIsRunOnceAndReported) {
    const auto run = benchmark("out");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* name : {"out/a", "out/b", "out/c"}) {
        const auto result = resultOf(name);
        EXPECT_EQ(result.problem, "");
        EXPECT_EQ(result.frames, static_cast<std::size_t>(frames));
        EXPECT_EQ(result.lost, 0u);
    }
    EXPECT_LT(resultOf("out/a").ate_rmse_m.value_or(1), 0.02);
    EXPECT_LT(resultOf("out/a").rpe_rmse_m.value_or(1), 0.02);
    EXPECT_FALSE(resultOf("out/c").ate_rmse_m) << "there is no truth in it";
    EXPECT_TRUE(fs::exists(path("out/a/ate.png")));
    EXPECT_FALSE(fs::exists(path("out/a/sequence.rawlog"))) << "not asked to be kept";
    EXPECT_THAT(readText(path("out/report.html")), HasSubstr("data:image/png;base64,"));
}

TEST_F(BenchmarkProgram, onlyWhatChangedRunsAgain) {
    ASSERT_EQ(benchmark("again").exit_code, 0);
    const auto made = [](const char* name) {
        return fs::last_write_time(path(name + std::string("/result.json")));
    };
    const auto a = made("again/a"), c = made("again/c");
    ASSERT_EQ(benchmark("again").exit_code, 0);
    EXPECT_EQ(made("again/a"), a);
    EXPECT_EQ(made("again/c"), c);
    std::ofstream(path("in/a/groundtruth.txt"), std::ios::app) << "# looked at\n";
    ASSERT_EQ(benchmark("again").exit_code, 0);
    EXPECT_GT(made("again/a"), a);
    EXPECT_EQ(made("again/c"), c);
    ASSERT_EQ(benchmark("again", "--set FeatureOptions.count=800").exit_code, 0);
    EXPECT_GT(made("again/c"), c);
}

TEST_F(BenchmarkProgram, gnuParallelSharesTheWork) {
    if (std::system("command -v parallel >/dev/null") != 0) GTEST_SKIP() << "no GNU parallel";
    const std::string command =
        "parallel -j 2 \"'" RGBD_BINARY_DIR "/bin/rgbd-benchmark' '" + path("in") + "' -o '" +
        path("shared") + "' --no-maps --only {}/2\" ::: 1 2 >'" + path("parallel.log") + "' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << readText(path("parallel.log"));
    expectAllReported("shared");
}

TEST_F(BenchmarkProgram, aSlurmJobArraySharesTheWork) {
    if (std::system("which munged slurmctld slurmd sbatch >/dev/null") != 0) {
        GTEST_SKIP() << "Debian's slurm-wlm is not installed";
    }
    const TestFolder cluster;
    const std::string job = "--array=1-3 --wrap \"'" RGBD_BINARY_DIR "/bin/rgbd-benchmark' '" +
                            path("in") + "' -o '" + path("slurm") +
                            "' --no-maps --only \\$SLURM_ARRAY_TASK_ID/3\"";
    const std::string command = "timeout 240 '" RGBD_SOURCE_DIR "/tests/support/with_slurm' '" +
                                cluster / "" + "' sbatch --output=/dev/null " + job + " >'" +
                                path("slurm.log") + "' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << readText(path("slurm.log"));
    expectAllReported("slurm");
}

TEST_F(BenchmarkProgram, aBrokenSequenceFailsAloneAndIsTriedAgain) {
    fs::create_directories(path("bad"));
    fs::copy_file(path("in/c.rawlog"), path("bad/good.rawlog"));
    std::ofstream(path("bad/cut.tgz")) << "no archive";
    const auto run = [] {
        return runProgram("rgbd-benchmark",
                          "'" + path("bad") + "' -o '" + path("bad-out") + "' --no-maps");
    };
    const auto first = run();
    EXPECT_EQ(first.exit_code, 1);
    EXPECT_THAT(first.err, HasSubstr("rgbd-benchmark: error: 1 sequence failed"));
    EXPECT_THAT(resultOf("bad-out/cut").problem, HasSubstr("cannot unpack"));
    EXPECT_EQ(resultOf("bad-out/good").problem, "");
    EXPECT_THAT(readText(path("bad-out/report.md")), HasSubstr("| cut | – |"));
    fs::remove(path("bad/cut.tgz"));
    fs::copy(path("in/b"), path("bad/cut"), fs::copy_options::recursive);
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(resultOf("bad-out/cut").problem, "");
}

TEST_F(BenchmarkProgram, usageIsChecked) {
    EXPECT_THAT(runProgram("rgbd-benchmark", path("in")).err,
                HasSubstr("output folder is missing"));
    EXPECT_THAT(benchmark("x", "--only 3/2").err, HasSubstr("'3/2' is no share"));
    const auto listed = benchmark("x", "--list --only 1/2");
    EXPECT_EQ(listed.exit_code, 0);
    EXPECT_THAT(listed.out, HasSubstr("a\t" + path("in/a") + "\nc\t"));
    EXPECT_FALSE(fs::exists(path("x")));
}

}  // namespace
}  // namespace rgbd_graphslam
