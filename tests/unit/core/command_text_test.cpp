#include "rgbd_graphslam/core/command_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(ShellLine, quotesWhatAShellWouldTakeApart) {
    EXPECT_EQ(shellLine({"rgbd-slam", "a.ini", "--set", "A.b=1"}), "rgbd-slam a.ini --set A.b=1");
    EXPECT_EQ(shellLine({"a", "b c", "", "d'e", "$f"}), R"(a 'b c' '' 'd'\''e' '$f')");
    EXPECT_EQ(shellLine({"two\nlines"}), "'two lines'");
}

TEST(CommandText, namesThisProgramWithoutItsFolders) {
    EXPECT_THAT(commandText(), testing::StartsWith("unit_core"));
}

TEST(LocalTimeText, isADateWithItsTimeZone) {
    EXPECT_THAT(localTimeText(),
                testing::ContainsRegex("^20[0-9][0-9]-[01][0-9]-[0-3][0-9] [0-2][0-9]:[0-5][0-9]:"
                                       "[0-6][0-9] [+-][0-9][0-9][0-9][0-9]$"));
}

}  // namespace
}  // namespace rgbd_graphslam
