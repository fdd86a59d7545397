#include "rgbd_graphslam/core/printable_text.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

TEST(PrintableText, textStays) {
    const std::string names = "a b~ \u00e4\u00df \u5730\u56f3 \U0001F916";
    EXPECT_EQ(printableLine(names), names);
    EXPECT_EQ(printableLine(""), "");
}

TEST(PrintableText, controlBytesAndLineEndsGo) {
    EXPECT_EQ(printableLine("a\nb\x1b[2Jc\x7f"), "a?b?[2Jc?");
    EXPECT_EQ(printableLine(std::string("\0x", 2)), "?x");
    EXPECT_EQ(printableLine("\xc2\x9b"), "??") << "a control character of two bytes";
}

TEST(PrintableText, bytesThatAreNoUtf8Go) {
    EXPECT_EQ(printableLine("\xff\x80 \xc3"), "?? ?");
    EXPECT_EQ(printableLine("\xc0\xaf"), "??") << "overlong";
    EXPECT_EQ(printableLine("\xed\xa0\x80"), "???") << "surrogate";
    EXPECT_EQ(printableLine("\xf4\x90\x80\x80"), "????") << "beyond Unicode";
}

TEST(PrintableText, longTextIsCutBetweenCharacters) {
    EXPECT_EQ(printableLine("abcdef", 6), "abcdef");
    EXPECT_EQ(printableLine("abcdefg", 6), "abcdef...");
    EXPECT_EQ(printableLine("\u00e4\u00e4\u00e4", 3), "\u00e4\u00e4...");
}

}  // namespace
}  // namespace rgbd_graphslam
