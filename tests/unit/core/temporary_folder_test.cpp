#include "rgbd_graphslam/core/temporary_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class TemporaryFolderTest : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(around_); }
    void TearDown() override { fs::remove_all(around_); }

    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(around_), fs::directory_iterator()));
    }

    fs::path around_ = fs::temp_directory_path() / ("around-" + std::to_string(getpid()));
    fs::path final_ = around_ / "a";
};

TEST_F(TemporaryFolderTest, goesUnlessItIsMoved) {
    { const TemporaryFolder dropped(final_); }
    EXPECT_EQ(entries(), 0u);
    {
        const TemporaryFolder kept(final_);
        std::ofstream(kept.path() + "/file") << "text";
        EXPECT_FALSE(fs::exists(final_));
        kept.moveToFinalName();
    }
    EXPECT_TRUE(fs::exists(final_ / "file"));
    EXPECT_EQ(entries(), 1u);
}

TEST_F(TemporaryFolderTest, replacesAnOlderOne) {
    fs::create_directories(final_ / "old");
    const TemporaryFolder made(final_);
    made.moveToFinalName();
    EXPECT_TRUE(fs::is_empty(final_));
}

TEST_F(TemporaryFolderTest, aPlaceThatIsNoneIsNamed) {
    std::ofstream(around_ / "file") << "text";
    EXPECT_THROW(TemporaryFolder(around_ / "file/a"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
