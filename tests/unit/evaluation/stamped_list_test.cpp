#include "rgbd_graphslam/evaluation/stamped_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::vector<StampedLine> listOf(const std::string& text) {
    const TestFolder folder;
    folder.write("list.txt", text);
    return readStampedList(folder / "list.txt");
}

TEST(StampedList, isSortedAndKeepsTheLastOfEqualStamps) {
    const auto lines = listOf("# a comment\r\n2.0 b.png\r\n\r\n1.0, a.png\tx # y\n2.0 c.png\n");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].stamp_s, 1);
    EXPECT_EQ(lines[0].rest, "a.png x");
    EXPECT_EQ(lines[1].rest, "c.png");
}

TEST(StampedList, errorsNameTheLine) {
    try {
        listOf("1.0 a\nnonsense b\n");
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr("list.txt:2: 'nonsense'"));
    }
    EXPECT_THROW(listOf("# nothing\n"), Error);
    EXPECT_THROW(listOf("nan a\n"), Error);
    EXPECT_THROW(readStampedList(TestFolder() / "absent.txt"), Error);
}

TEST(Association, printsPairsAsTheTumToolDoes) {
    const auto rgb = listOf("1.00 rgb/1.png\n1.10 rgb/2.png\n");
    const auto depth = listOf("1.005 depth/1.png\n1.50 depth/2.png\n");
    EXPECT_EQ(associationText(rgb, depth), "1.000000 rgb/1.png 1.005000 depth/1.png\n");
    AssociationOptions first_only;
    first_only.first_only = true;
    EXPECT_EQ(associationText(rgb, depth, first_only), "1.000000 rgb/1.png\n");
}

TEST(Association, offsetIsAddedToTheSecondList) {
    AssociationOptions options;
    options.offset_s = -0.4;
    EXPECT_EQ(associationText(listOf("1.10 a\n"), listOf("1.50 b\n"), options),
              "1.100000 a 1.500000 b\n");
}

TEST(Association, ofStrangersIsAnError) {
    EXPECT_THROW(associationText(listOf("1 a\n"), listOf("2 b\n")), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
