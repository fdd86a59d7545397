/** A run of rgbd-slam that is killed goes on with --resume and ends with the files of a run that
 *  never was. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <random>

#include "killed_runs.h"
#include "rgbd_graphslam/core/byte_stream.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kills = 10;
/** Once round the room and on, so that a loop is closed. */
constexpr int frames = 140;
constexpr double turn_rad = 0.05;

const std::string program = "'" RGBD_BINARY_DIR "/bin/rgbd-slam' ";

/** Without those that tell of times. */
Files resultsIn(const std::string& folder) {
    Files files = filesIn(folder);
    for (const std::string& name : files_of_times) files.erase(name);
    return files;
}

std::vector<std::string> namesOf(const Files& files) {
    std::vector<std::string> names;
    for (const auto& file : files) names.push_back(file.first);
    return names;
}

void expectTheSame(const Files& files, const Files& expected) {
    EXPECT_EQ(namesOf(files), namesOf(expected));
    for (const auto& [name, bytes] : expected) {
        const auto file = files.find(name);
        EXPECT_TRUE(file == files.end() || file->second == bytes) << name << " differs";
    }
}

class FaultResume : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder_ = new TestFolder;
        writeFilm(*folder_ / "a.rawlog", 0, frames, turn_rad);
        const auto start = std::chrono::steady_clock::now();
        const ProgramResult result = runProgram("rgbd-slam", arguments("finished"));
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        run_s_ = passed.count();
        finished_ = new Files(resultsIn(*folder_ / "finished"));
        ASSERT_THAT(readText(*folder_ / "finished/summary.json"), Not(HasSubstr("\"loops\": 0")));
    }
    static void TearDownTestSuite() {
        delete finished_;
        delete folder_;
    }
    ~FaultResume() override { fs::remove_all(*folder_ / "out"); }

    static std::string arguments(const std::string& out, const std::string& rawlog = "a.rawlog") {
        return inQuotes(RGBD_SOURCE_DIR "/ini/default.ini") + " " + inQuotes(*folder_ / rawlog) +
               " -o " + inQuotes(*folder_ / out) +
               " --quiet --set MapOptions.octree_resolution_m=0.1"
               " --set RunOptions.checkpoint_keyframes=3";
    }
    static std::string resumeArguments() {
        return "--quiet --resume " + inQuotes(*folder_ / "out");
    }
    /** As soon as there is one. */
    static void signalAtCheckpoint(const std::string& signal, const std::string& arguments) {
        // The shell lets its background jobs ignore SIGINT until the program listens to it.
        shell(program + arguments + " >/dev/null 2>&1 & until [ -e " + inQuotes(checkpoint()) +
              " ]; do kill -0 $! || exit; sleep 0.02; done; kill -" + signal + " $!; wait $!");
        ASSERT_TRUE(fs::exists(checkpoint()));
    }
    static ProgramResult resume(const std::string& more = "") {
        return runProgram("rgbd-slam", resumeArguments() + more);
    }
    static void expectFinished(const ProgramResult& result) {
        EXPECT_EQ(result.exit_code, 0) << result.err;
        expectTheSame(resultsIn(*folder_ / "out"), *finished_);
    }
    static void expectRefused(const ProgramResult& result, const std::string& reason) {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("rgbd-slam: error: "));
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }
    static std::string checkpoint() { return *folder_ / "out/checkpoint"; }

    static TestFolder* folder_;
    static Files* finished_;
    static double run_s_;
};

TestFolder* FaultResume::folder_ = nullptr;
Files* FaultResume::finished_ = nullptr;
double FaultResume::run_s_ = 0;

TEST_F(FaultResume, aCameraThatStandsStillIsSavedAsWell) {
    writeFilm(*folder_ / "still.rawlog", 0, 250, 0);
    const ProgramResult result = runProgram(
        "rgbd-slam", inQuotes(RGBD_SOURCE_DIR "/ini/default.ini") + " " +
                         inQuotes(*folder_ / "still.rawlog") + " -o " + inQuotes(*folder_ / "out") +
                         " --verbose --no-maps --set RunOptions.checkpoint_keyframes=1");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(readText(*folder_ / "out/summary.json"), HasSubstr("\"keyframes\": 1,"));
    int checkpoints = 0;
    const std::string said = result.out + result.err;
    for (auto at = said.find("checkpoint:"); at != std::string::npos;
         at = said.find("checkpoint:", at + 1)) {
        ++checkpoints;
    }
    EXPECT_EQ(checkpoints, 3);
}

TEST_F(FaultResume, killedAtAnyMoment) {
    KillMoments moments(run_s_);
    int resumed = 0;
    for (int i = 0; i < kills; ++i) {
        killAfter(moments.next(), "rgbd-slam", arguments("out"));
        if (fs::exists(*folder_ / "out/summary.json")) moments.cameTooLate();
        if (fs::exists(checkpoint())) {
            ++resumed;
            expectFinished(resume());
        }
        fs::remove_all(*folder_ / "out");
    }
    EXPECT_GT(resumed, kills / 4) << "hardly a run was killed after its first checkpoint";
}

TEST_F(FaultResume, killedAgainAndAgain) {
    signalAtCheckpoint("KILL", arguments("out"));
    std::mt19937 random(2);
    for (int i = 0; i < 5 && fs::exists(checkpoint()); ++i) {
        killAfter(run_s_ * (random() % 1000) / 1000, "rgbd-slam", resumeArguments());
    }
    if (fs::exists(checkpoint())) expectFinished(resume());
    expectTheSame(resultsIn(*folder_ / "out"), *finished_);
}

TEST_F(FaultResume, anInterruptedRunGoesOn) {
    signalAtCheckpoint("INT", arguments("out"));
    expectFinished(resume());
}

TEST_F(FaultResume, anyNumberOfThreadsGoesOn) {
    signalAtCheckpoint("KILL", arguments("out"));
    EXPECT_EQ(resume(" --threads 1").exit_code, 0);
    const std::string times = readText(*folder_ / "out/frame_times.csv");
    EXPECT_EQ(std::count(times.begin(), times.end(), '\n'), 1 + frames);
    Files expected = *finished_, files = resultsIn(*folder_ / "out");
    for (Files* f : {&expected, &files}) {  // tell the settings or their hash
        f->erase("config.ini");
        f->erase("map.sparse");
    }
    expectTheSame(files, expected);
}

TEST_F(FaultResume, anExtendedMapGoesOn) {
    writeFilm(*folder_ / "first.rawlog", 0, 40, turn_rad);
    writeFilm(*folder_ / "second.rawlog", 30, 90, turn_rad);
    const std::string extend = " --extend --map " + inQuotes(*folder_ / "first");
    ASSERT_EQ(runProgram("rgbd-slam", arguments("first", "first.rawlog")).exit_code, 0);
    ASSERT_EQ(runProgram("rgbd-slam", arguments("both", "second.rawlog") + extend).exit_code, 0);
    signalAtCheckpoint("KILL", arguments("out", "second.rawlog") + extend);
    EXPECT_EQ(resume().exit_code, 0);
    expectTheSame(resultsIn(*folder_ / "out"), resultsIn(*folder_ / "both"));
}

TEST_F(FaultResume, aRunThatEndsOrBeginsLeavesNoCheckpoint) {
    EXPECT_EQ(finished_->count("checkpoint"), 0u);
    signalAtCheckpoint("KILL", arguments("out"));
    EXPECT_EQ(runProgram("rgbd-slam", arguments("out")).exit_code, 0);
    EXPECT_FALSE(fs::exists(checkpoint()));
    expectRefused(resume(), "nothing to resume");
}

TEST_F(FaultResume, refusesAnotherRawlogAndOtherSettings) {
    signalAtCheckpoint("KILL", arguments("out"));
    const std::string rawlog = *folder_ / "a.rawlog", kept = *folder_ / "kept.rawlog";
    fs::rename(rawlog, kept);
    expectRefused(resume(), "cannot read the rawlog");
    writeFilm(rawlog, 0, 10, turn_rad);
    expectRefused(resume(), "is not the one that the checkpoint was written for");
    fs::rename(kept, rawlog);
    for (const char* more :
         {" --set TrackerOptions.min_inliers=20", " --no-maps", " --max-frames 9"}) {
        const ProgramResult result = resume(more);
        EXPECT_NE(result.exit_code, 0);
        EXPECT_THAT(result.err, HasSubstr("excludes --resume")) << result.err;
    }
}

/** With its check sum mended. */
void rewriteCheckpoint(const std::string& path, std::string bytes, std::size_t at, char value) {
    constexpr std::size_t checksum_at = 20, payload_at = 24;
    bytes[at] = value;
    ByteWriter checksum;
    checksum.put(static_cast<std::uint32_t>(crc32_z(
        0, reinterpret_cast<const Bytef*>(bytes.data()) + payload_at, bytes.size() - payload_at)));
    std::ofstream(path, std::ios::binary) << bytes.replace(checksum_at, 4, checksum.bytes());
}

TEST_F(FaultResume, refusesDamagedCheckpointsAndThoseOfOtherVersions) {
    signalAtCheckpoint("KILL", arguments("out"));
    const std::string whole = readText(checkpoint());
    const auto write = [&](const std::string& bytes) {
        std::ofstream(checkpoint(), std::ios::binary) << bytes;
    };
    write(whole.substr(0, whole.size() / 2));
    expectRefused(resume(), "is cut off or damaged");
    std::string changed = whole;
    changed[changed.size() / 2] ^= 1;
    write(changed);
    expectRefused(resume(), "its check sum is wrong");
    write("something else");
    expectRefused(resume(), "is no checkpoint of rgbd-slam");
    constexpr std::size_t format_at = 8, program_version_at = 28;
    changed = whole;
    changed[format_at] = 9;
    write(changed);
    expectRefused(resume(), "is of version 9");
    rewriteCheckpoint(checkpoint(), whole, program_version_at, '9');
    expectRefused(resume(), "of the program, this is");
    write(whole);
    expectFinished(resume());
}

TEST_F(FaultResume, bytesThatMakeNoSenseNeverBreakIt) {
    signalAtCheckpoint("KILL", arguments("out"));
    const std::string whole = readText(checkpoint());
    std::mt19937 random(3);
    for (int i = 0; i < 8; ++i) {
        rewriteCheckpoint(checkpoint(), whole, whole.size() / 10 + random() % (whole.size() / 2),
                          static_cast<char>(random()));
        const ProgramResult result = resume();
        EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 1) << result.err;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
