/** rgbd-slam on bad input ends in one clear line and an exit code; what was mapped is kept. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/run_program.h"
#include "../support/textured_room.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string inQuotes(const std::string& text) {
    return "'" + text + "'";
}

std::size_t linesOf(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class FaultSlam : public ::testing::Test {
  protected:
    FaultSlam() : rawlog_(folder_ / "a.rawlog"), out_(folder_ / "out") { writeFrames(10); }

    /** To and fro in a room. */
    void writeFrames(int frames) const {
        const auto film = filmRoundTrip(10, 0.02);
        writeRawlog(rawlog_, RawlogStorage::Embedded, [&](RawlogWriter& writer) {
            for (int i = 0; i < frames; ++i) {
                auto& frame = *film[i / 10 % 2 ? 9 - i % 10 : i % 10];
                frame.timestamp = toMrptTime(room_start_s + i * room_period_s);
                writer.write(frame);
            }
        });
    }
    std::string arguments(const std::string& ini, const std::string& rawlog,
                          const std::string& out) const {
        return inQuotes(ini) + " " + inQuotes(rawlog) + " -o " + inQuotes(out) +
               " --no-maps --quiet ";
    }
    ProgramResult slam(const std::string& more = "") const {
        return runProgram("rgbd-slam", arguments(default_ini, rawlog_, out_) + more);
    }
    static void expectRefused(const ProgramResult& result, const std::string& reason) {
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("rgbd-slam: error: "));
        EXPECT_THAT(result.err, HasSubstr(reason));
        EXPECT_EQ(linesOf(result.err), 1u) << result.err;
    }

    const std::string default_ini = RGBD_SOURCE_DIR "/ini/default.ini";
    TestFolder folder_;
    std::string rawlog_, out_;
};

/** Errors apart: that no gravity is known is a warning here. */
std::string errorsOf(const std::string& err) {
    std::string errors, line;
    for (const char c : err) {
        line += c;
        if (c != '\n') continue;
        if (line.find("warning: ") != 0) errors += line;
        line.clear();
    }
    return errors + line;
}

TEST_F(FaultSlam, goodRawlogIsTaken) {
    const ProgramResult result = slam();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(errorsOf(result.err), "");
    EXPECT_THAT(result.out, HasSubstr("10 tracked"));
}

TEST_F(FaultSlam, missingIni) {
    expectRefused(runProgram("rgbd-slam", arguments(folder_ / "no.ini", rawlog_, out_)), "no.ini");
}

TEST_F(FaultSlam, unknownKeyIsNamedWithItsLine) {
    folder_.write("bad.ini", "[TrackerOptions]\nmin_inliers = 20\nmin_inlier = 20\n");
    const auto result = runProgram("rgbd-slam", arguments(folder_ / "bad.ini", rawlog_, out_));
    expectRefused(result, "bad.ini:3: unknown key 'min_inlier'");
    EXPECT_THAT(result.err, HasSubstr("did you mean 'min_inliers'?"));
    EXPECT_FALSE(fs::exists(out_));
}

TEST_F(FaultSlam, aKeyUnlikeAnyOtherIsNoMisspeltOne) {
    const auto result = slam("--set TrackerOptions.foo=1");
    expectRefused(result, "unknown key 'foo' in [TrackerOptions]");
    EXPECT_THAT(result.err, ::testing::Not(HasSubstr("did you mean")));
}

TEST_F(FaultSlam, valuesOutOfRange) {
    expectRefused(slam("--set TrackerOptions.min_inliers=many"), "min_inliers = 'many'");
    expectRefused(slam("--set nonsense"), "--set 'nonsense' is malformed");
    expectRefused(slam("--threads 0"), "threads = '0'");
}

TEST_F(FaultSlam, missingArguments) {
    expectRefused(runProgram("rgbd-slam", inQuotes(default_ini)),
                  "missing argument RAWLOG. Usage: rgbd-slam RAWLOG -o OUT");
    expectRefused(runProgram("rgbd-slam", inQuotes(rawlog_)), "missing argument -o OUT");
    expectRefused(runProgram("rgbd-slam", inQuotes(default_ini) + " " + inQuotes(rawlog_)),
                  "missing argument -o OUT");
}

TEST_F(FaultSlam, settingsGivenTwice) {
    expectRefused(
        slam("--config " + inQuotes(default_ini)),
        "both '" + default_ini + "' and --config '" + default_ini + "' give the settings");
}

TEST_F(FaultSlam, moreThanOneRawlog) {
    const std::string b = folder_ / "b.rawlog";
    expectRefused(slam(inQuotes(b)), b + "' cannot be worked on at once");
    expectRefused(runProgram("rgbd-slam", inQuotes(rawlog_) + " " + inQuotes(b) + " -o out"),
                  "'" + rawlog_ + "' and '" + b + "' cannot be worked on at once");
}

TEST_F(FaultSlam, missingRawlog) {
    fs::remove(rawlog_);
    expectRefused(slam(), "a.rawlog");
}

TEST_F(FaultSlam, folderInsteadOfARawlog) {
    fs::remove(rawlog_);
    fs::create_directory(rawlog_);
    expectRefused(slam(), "is a folder");
}

TEST_F(FaultSlam, fileThatIsNoRawlog) {
    folder_.write("a.rawlog", std::string(100000, 'x'));
    expectRefused(slam(), "is not a rawlog");
}

TEST_F(FaultSlam, unwritableFolder) {
    folder_.write("file", "");
    expectRefused(runProgram("rgbd-slam", arguments(default_ini, rawlog_, folder_ / "file/out")),
                  "file/out");
}

TEST_F(FaultSlam, cutRawlogKeepsWhatCameBeforeAndSaysWhere) {
    cutFile(rawlog_, 0.65);
    const ProgramResult result = slam();
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err, HasSubstr("cut off or damaged at entry 6"));
    EXPECT_EQ(linesOf(errorsOf(result.err)), 1u) << result.err;
    EXPECT_EQ(linesOf(readText(out_ + "/trajectory.txt")), 1u + 6);
    EXPECT_THAT(readText(out_ + "/summary.json"), HasSubstr("cut off"));
}

TEST_F(FaultSlam, badMapsAreRefusedBeforeAnythingIsWritten) {
    ASSERT_EQ(slam().exit_code, 0);
    const std::string map = out_ + "/map.sparse", whole = readText(map), out2 = folder_ / "out2";
    const auto localize = [&](const std::string& folder) {
        return runProgram("rgbd-slam", arguments(default_ini, rawlog_, out2) + "--localize --map " +
                                           inQuotes(folder));
    };
    EXPECT_EQ(localize(out_).exit_code, 0);
    fs::remove_all(out2);
    expectRefused(localize(folder_ / "nowhere"), "nowhere/map.sparse");
    cutFile(map, 0.7);
    expectRefused(localize(out_), "cut off or damaged");
    folder_.write("out/map.sparse", "RGBDMAP\n\7" + whole.substr(9));
    expectRefused(localize(out_), "version 7");
    std::string flipped = whole;
    flipped[5000] = static_cast<char>(flipped[5000] ^ 1);
    folder_.write("out/map.sparse", flipped);
    expectRefused(localize(out_), "its check sum is wrong");
    EXPECT_FALSE(fs::exists(out2));
}

TEST_F(FaultSlam, mapAloneDoesNotSayWhatToDo) {
    expectRefused(slam("--map " + inQuotes(out_)), "--localize or --extend");
}

TEST_F(FaultSlam, mapOfAnotherPyramidIsRefused) {
    ASSERT_EQ(slam().exit_code, 0);
    expectRefused(runProgram("rgbd-slam", arguments(default_ini, rawlog_, folder_ / "out2") +
                                              "--set FeatureOptions.levels=4 --extend --map " +
                                              inQuotes(out_)),
                  "6 pyramid levels");
}

/** \return the exit code of a run that gets Ctrl-C after `delay_s` */
int interruptAfter(double delay_s, const std::string& arguments, const std::string& err) {
    const std::string command = inQuotes(RGBD_BINARY_DIR "/bin/rgbd-slam") + " " + arguments +
                                " >/dev/null 2>" + inQuotes(err) + " & sleep " +
                                std::to_string(delay_s) + "; kill -INT $! 2>/dev/null; wait $!";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(FaultSlam, interruptionKeepsWhatWasMapped) {
    writeFrames(300);
    // How long tracking takes depends on the machine: growing delays meet it on any. Before the
    // program listens to signals, a shell lets its background jobs ignore this one.
    for (double delay_s = 0.1; delay_s < 20; delay_s *= 1.4) {
        const int exit_code =
            interruptAfter(delay_s, arguments(default_ini, rawlog_, out_), folder_ / "progress");
        if (exit_code != 130) continue;
        const std::size_t poses = linesOf(readText(out_ + "/trajectory.txt")) - 1;
        EXPECT_LT(poses, 300u);
        EXPECT_THAT(readText(out_ + "/summary.json"), HasSubstr("\"interrupted\": true"));
        if (poses >= 10) return;
    }
    FAIL() << "no run was interrupted after ten frames; the last said "
           << readText(folder_ / "progress");
}

}  // namespace
}  // namespace rgbd_graphslam
