#include "rgbd_graphslam/core/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
  protected:
    void SetUp() override {
        // ctest runs each test in a process of its own, several at a time.
        folder_ = fs::path(testing::TempDir()) / ("rgbd-atomic-file-" + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    std::string path() const { return (folder_ / "a.txt").string(); }
    std::string content() const {
        std::ostringstream text;
        text << std::ifstream(path()).rdbuf();
        return text.str();
    }
    fs::path folder_;
};

TEST_F(AtomicFile, failureKeepsTheOldFileAndLeavesNoTemporary) {
    writeTextAtomically(path(), "old");
    EXPECT_THROW(writeAtomically(path(),
                                 [](const std::string& temporary) {
                                     std::ofstream(temporary) << "half";
                                     return false;
                                 }),
                 Error);
    EXPECT_EQ(content(), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(AtomicFile, successReplacesTheOldFile) {
    writeTextAtomically(path(), "old");
    writeTextAtomically(path(), "new");
    EXPECT_EQ(content(), "new");
}

TEST_F(AtomicFile, missingFolderIsNamed) {
    try {
        writeTextAtomically((folder_ / "none" / "a.txt").string(), "x");
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("none"), std::string::npos);
    }
}

TEST(MakeWritableFolder, removesWhatKilledProcessesLeft) {
    const fs::path folder = fs::temp_directory_path() / ("abandoned-" + std::to_string(getpid()));
    fs::create_directories(folder);
    const std::string own = temporaryName("points.ply");
    const std::string number = std::to_string(getpid());
    std::string abandoned = own;
    abandoned.replace(abandoned.rfind(number), number.size(), "2000000000");  // none in Linux
    const std::string elsewhere = ".tmp-another-machine-2000000000-points.ply";
    for (const std::string& name : {own, abandoned, elsewhere, std::string(".tmp-notes")}) {
        fs::create_directories(folder / name / "rgb");
    }
    makeWritableFolder(folder.string());
    EXPECT_TRUE(fs::exists(folder / own));
    EXPECT_TRUE(fs::exists(folder / elsewhere));
    EXPECT_TRUE(fs::exists(folder / ".tmp-notes"));
    EXPECT_FALSE(fs::exists(folder / abandoned));
    fs::remove_all(folder);
}

}  // namespace
}  // namespace rgbd_graphslam
