/** Arguments that a hurried user gives: a folder for a file, no number for a
 *  number, an output that cannot be written. Each ends in one line and with 1, and leaves no half
 *  file. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../support/run_program.h"
#include "../support/small_disk.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string sample = "'" RGBD_SOURCE_DIR "/rawlogs/office_sample.rawlog'";

class FaultArguments : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(folder_ / "dir");
        folder_.write("binary.ini", std::string("[CAMERA_PARAMS]\nfx = \0${x\n", 26));
        small_sequence::make(folder_, "s", 4);
    }

    /** \param arguments with % before the names of files of the folder */
    std::string inFolder(const std::string& arguments) const {
        std::string line;
        for (const char c : arguments) line += c == '%' ? folder_ / "" : std::string(1, c);
        return line;
    }
    void expectRefused(const std::string& program, const std::string& arguments,
                       const std::string& reason) const {
        const ProgramResult result = runProgram(program, inFolder(arguments));
        EXPECT_EQ(result.exit_code, 1) << program << " " << arguments;
        EXPECT_THAT(result.err, HasSubstr(program + ": error: ")) << arguments;
        EXPECT_THAT(result.err, HasSubstr(reason)) << arguments;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    }

    TestFolder folder_;
};

TEST_F(FaultArguments, foldersInPlaceOfFiles) {
    expectRefused("rgbd-import", "%s %out.rawlog -q --camera %dir", "is a folder, not a c");
    expectRefused("rgbd-import", "%s %out.rawlog -q --register %dir", "is a folder, not a c");
}

TEST_F(FaultArguments, filesThatAreNoText) {
    expectRefused("rgbd-import", "%s %out.rawlog -q --camera %binary.ini", "is not a text file");
}

TEST_F(FaultArguments, numbersThatAreNone) {
    expectRefused("rgbd-import", "%s %out.rawlog --depth-offset nan", "'nan' is not a finite");
    expectRefused("rgbd-import", "%s %out.rawlog --threads 0", "'0' is not from 1 to 256");
    expectRefused("rawlog2tum", sample + " %out --from nan", "'nan' is not a finite number");
}

TEST_F(FaultArguments, optionsOfBagsForFolders) {
    expectRefused("rgbd-import", "%s %out.rawlog --color-topic /a",
                  "--color-topic is for ROS bags");
}

TEST_F(FaultArguments, fullDisk) {
    const SmallDisk disk(folder_ / "disk", 64 << 10);
    if (!disk.mounted()) GTEST_SKIP() << "making a small disk takes root";
    folder_.write("disk/rest", std::string(64 << 10, 'x'));
    for (const char* storage : {"", " --compact", " --small"}) {
        expectRefused("rgbd-import", std::string("%s %disk/a.rawlog -q") + storage,
                      "No space left on device");
    }
    expectRefused("rawlog2tum", sample + " %disk/s -q", "check free space");
}

}  // namespace
}  // namespace rgbd_graphslam
