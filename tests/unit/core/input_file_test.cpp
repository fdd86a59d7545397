#include "rgbd_graphslam/core/input_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "../../support/problem_of.h"
#include "rgbd_graphslam/core/options.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class InputFile : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    std::string with(const std::string& text) const {
        const std::string path = folder_ + "/a.ini";
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    const std::string folder_ =
        (fs::temp_directory_path() / ("input_file_" + std::to_string(getpid()))).string();
};

TEST_F(InputFile, foldersAreNotReadAsEmptyFiles) {
    const std::string expected = "'" + folder_ + "' is a folder, not an ini file; name the file";
    EXPECT_EQ(problemOf([&] { refuseFolder(folder_, "an ini file"); }), expected);
    EXPECT_EQ(problemOf([&] { readTextFile(folder_, "an ini file", "x"); }), expected);
    EXPECT_EQ(problemOf([&] { IniFile::fromFile(folder_); }), expected);
}

TEST_F(InputFile, textIsReadWhole) {
    EXPECT_EQ(readTextFile(with("a = 1\r\n\tb"), "an ini file", "x"), "a = 1\r\n\tb");
    EXPECT_EQ(readTextFile(with(""), "an ini file", "x"), "");
    EXPECT_NO_THROW(refuseFolder(with(""), "an ini file"));
}

TEST_F(InputFile, whatIsMissingOrNoTextIsNamedWithTheRemedy) {
    EXPECT_EQ(problemOf([&] { readTextFile("no.ini", "a camera file", "give one"); }),
              "cannot read 'no.ini' as a camera file; give one");
    const std::string path = with(std::string("a\0b", 3));
    EXPECT_EQ(problemOf([&] { readTextFile(path, "a camera file", "give one"); }),
              "'" + path + "' is not a text file; give one");
}

}  // namespace
}  // namespace rgbd_graphslam
