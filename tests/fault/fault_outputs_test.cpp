/** A run of rgbd-slam that is killed or cannot write leaves every file either as it was or as the
 *  finished run has it. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "../support/small_disk.h"
#include "killed_runs.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kills = 50;
constexpr double turn_rad = 0.03;

/** `out` holds an earlier run's results; `finished` those of the run that the faults meet. */
class FaultOutputs : public ::testing::Test {
  protected:
    FaultOutputs() {
        writeFilm(folder_ / "earlier.rawlog", 0, 4, turn_rad);
        writeFilm(folder_ / "a.rawlog", 0, 8, turn_rad);
        earlier_ = run("earlier.rawlog", "out");
        const auto start = std::chrono::steady_clock::now();
        finished_ = run("a.rawlog", "finished");
        run_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    std::string arguments(const std::string& rawlog, const std::string& out) const {
        return inQuotes(RGBD_SOURCE_DIR "/ini/default.ini") + " " + inQuotes(folder_ / rawlog) +
               " -o " + inQuotes(folder_ / out) +
               " --quiet --set MapOptions.octree_resolution_m=0.1";
    }
    Files run(const std::string& rawlog, const std::string& out) const {
        const ProgramResult result = runProgram("rgbd-slam", arguments(rawlog, out));
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return filesIn(folder_ / out);
    }
    /** \return whether all of the finished run is there */
    bool expectOldOrNew(const std::string& out) const {
        const LeftBehind left(filesIn(folder_ / out), earlier_, finished_);
        left.expectOldOrNew();
        return left.isFinished();
    }
    void restoreEarlier() const {
        fs::remove_all(folder_ / "out");
        for (const auto& [name, bytes] : earlier_) folder_.write("out/" + name, bytes);
    }
    void expectRefused(const ProgramResult& result, const std::string& reason) const {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("rgbd-slam: error: "));
        EXPECT_THAT(result.err, HasSubstr(reason));
    }
    TestFolder folder_;
    Files earlier_, finished_;
    double run_s_ = 0;
};

TEST_F(FaultOutputs, killedAtAnyMoment) {
    KillMoments moments(run_s_);
    int unfinished = 0;
    for (int i = 0; i < kills; ++i) {
        killAfter(moments.next(), "rgbd-slam", arguments("a.rawlog", "out"));
        const bool finished = expectOldOrNew("out");
        unfinished += !finished;
        if (finished) moments.cameTooLate();
        restoreEarlier();
    }
    RecordProperty("killed_before_the_end", unfinished);
    EXPECT_GT(unfinished, kills / 5) << "hardly a run was killed before its end";
    killAfter(0.9 * run_s_, "rgbd-slam", arguments("a.rawlog", "out"));
    run("a.rawlog", "out");
    EXPECT_TRUE(expectOldOrNew("out"));
    EXPECT_TRUE(temporariesIn(folder_ / "out").empty()) << "left over from a run that was killed";
}

TEST_F(FaultOutputs, fileSizeLimit) {
    // SIGXFSZ ignored turns the shell's limit into an error of write().
    const std::string command = inQuotes(RGBD_BINARY_DIR "/bin/rgbd-slam") + " " +
                                arguments("a.rawlog", "out") + " 2>" + inQuotes(folder_ / "err");
    const int status =
        std::system(("bash -c \"trap '' XFSZ; ulimit -f 16; " + command + "\" >/dev/null").c_str());
    expectRefused({WEXITSTATUS(status), "", readText(folder_ / "err")}, "cannot write '");
    EXPECT_FALSE(expectOldOrNew("out"));
    EXPECT_TRUE(temporariesIn(folder_ / "out").empty());
}

TEST_F(FaultOutputs, fullDisk) {
    for (const std::size_t spare_bytes : {0u, 30000u, 100000u}) {
        std::size_t size = spare_bytes;
        for (const auto& [name, bytes] : earlier_) size += (bytes.size() / 4096 + 1) * 4096;
        const SmallDisk disk(folder_ / "disk", size);
        if (!disk.mounted()) GTEST_SKIP() << "making a small disk takes root";
        fs::copy(folder_ / "out", folder_ / "disk", fs::copy_options::recursive);
        expectRefused(runProgram("rgbd-slam", arguments("a.rawlog", "disk")), "No space left");
        EXPECT_FALSE(expectOldOrNew("disk"));
        EXPECT_TRUE(temporariesIn(folder_ / "disk").empty());
    }
}

TEST_F(FaultOutputs, readOnlyFolder) {
    const SmallDisk disk(folder_ / "disk", 64 << 20);
    if (!disk.mounted()) GTEST_SKIP() << "making a read-only disk takes root";
    fs::copy(folder_ / "out", folder_ / "disk", fs::copy_options::recursive);
    ASSERT_TRUE(disk.makeReadOnly());
    expectRefused(runProgram("rgbd-slam", arguments("a.rawlog", "disk")), "is not writable");
    EXPECT_EQ(filesIn(folder_ / "disk"), earlier_);
}

}  // namespace
}  // namespace rgbd_graphslam
