#include "rgbd_graphslam/core/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct SampleOptions : Options {
    double size_m = 0.1;
    int count = 7;
    bool fast = true;
    std::string mode = "near";
    const char* section() const override { return "SampleOptions"; }
    const char* about() const override { return "For the test"; }
    void describe(OptionVisitor& v) override {
        v.renamed("width_m", "size_m");
        v.real("size_m", size_m, 0, 1, "m", "Size");
        v.integer("count", count, 1, 9, "", "Count");
        v.flag("fast", fast, "Speed");
        v.choice("mode", mode, {"near", "far"}, "Mode");
    }
};

std::string problemOf(const std::string& text) {
    SampleOptions options;
    try {
        IniFile::fromText(text, "a.ini").load({&options});
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

TEST(IniFile, formulasOfMrptAreRefusedWithTheirLine) {
    ASSERT_EQ(setenv("RGBD_SIZE", "0.7", 1), 0);
    for (const char* line : {"size_m = $env{RGBD_SIZE}", "size_m = $eval{0.1 + 0.2}",
                             "# $env{RGBD_SIZE}", "size_m = $env{RGBD_SIZE"}) {
        const std::string problem = problemOf(std::string("[SampleOptions]\n") + line + "\n");
        EXPECT_THAT(problem, StartsWith("a.ini:2: '$e")) << line;
        EXPECT_THAT(problem, EndsWith("; write the value itself")) << line;
        EXPECT_THAT(problem, Not(HasSubstr("0.7"))) << line;
    }
}

TEST(IniFile, overridesAreNotEvaluated) {
    SampleOptions options;
    IniFile ini = IniFile::fromText("", "");
    ini.override("SampleOptions.size_m=$eval{0.1 + 0.2}");
    EXPECT_THROW(ini.load({&options}), Error);
}

TEST(IniFile, bytesOfOtherFilesAreNotQuoted) {
    EXPECT_EQ(problemOf(std::string("\x1f\x8b\x08\0rest", 8)),
              "'a.ini' is not a text file; name an ini file here");
    EXPECT_EQ(problemOf("[SampleOptions]\r\n\tsize_m = 0.5\r\n"), "");
}

TEST(IniFile, readsEveryKindOfValueAndComment) {
    SampleOptions options;
    IniFile::fromText(
        "; note\n[SampleOptions]\nsize_m = 0.25 // [m]\ncount=3\nfast=false\nmode=far\n", "a.ini")
        .load({&options});
    EXPECT_EQ(options.size_m, 0.25);
    EXPECT_EQ(options.count, 3);
    EXPECT_FALSE(options.fast);
    EXPECT_EQ(options.mode, "far");
}

struct TextOptions : Options {
    std::string words = "wall floor";
    const char* section() const override { return "TextOptions"; }
    const char* about() const override { return "For the test"; }
    void describe(OptionVisitor& v) override { v.choice("words", words, {}, "Any words"); }
};

TEST(IniFile, aTextMayHaveSeveralWordsOrNone) {
    for (const char* words : {"", "person", "dining table // no", "a;b"}) {
        TextOptions written, read;
        written.words = words;
        IniFile::fromText(toIniText({&written}), "a.ini").load({&read});
        EXPECT_EQ(read.words, std::string(words).substr(0, std::string(words).find(" //")));
    }
}

TEST(IniFile, printedTextReadsBackToTheSameValues) {
    SampleOptions written, read;
    written.size_m = 1.0 / 3;
    written.count = 2;
    written.fast = false;
    IniFile::fromText(toIniText({&written}), "b.ini").load({&read});
    EXPECT_EQ(read.size_m, written.size_m);
    EXPECT_EQ(read.count, written.count);
    EXPECT_EQ(read.fast, written.fast);
}

TEST(IniFile, namesLineAndRemedyOfMistakes) {
    using testing::AllOf;
    using testing::HasSubstr;
    EXPECT_THAT(problemOf("[SampleOptions]\ncuont = 3"),
                AllOf(HasSubstr("a.ini:2"), HasSubstr("'count'")));
    EXPECT_THAT(problemOf("[SampleOption]\ncount = 3"), HasSubstr("SampleOptions"));
    EXPECT_THAT(problemOf("[SampleOptions]\ncount = 30"), HasSubstr("from 1 to 9"));
    EXPECT_THAT(problemOf("[SampleOptions]\nsize_m = nan"), HasSubstr("cannot be used"));
    EXPECT_THAT(problemOf("[SampleOptions]\nsize_m = 0.5x"), HasSubstr("cannot be used"));
    EXPECT_THAT(problemOf("[SampleOptions]\nmode = middle"), HasSubstr("near|far"));
    EXPECT_THAT(problemOf("[SampleOptions]\njust words"), HasSubstr("a.ini:2"));
    EXPECT_THAT(problemOf("[SampleOptions]\ncount=1\ncount=2"), HasSubstr("twice"));
}

TEST(IniFile, formerNamesAreReadWithANotice) {
    SampleOptions options;
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    IniFile::fromText("[SampleOptions]\nwidth_m = 0.7\n", "a.ini").load({&options});
    const std::string said =
        testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
    EXPECT_EQ(options.size_m, 0.7);
    EXPECT_THAT(said, HasSubstr("a.ini:2: 'width_m' is now called 'size_m'"));
}

TEST(IniFile, bothNamesOfOneKeyAreRefused) {
    const std::string problem = problemOf("[SampleOptions]\nwidth_m = 0.7\nsize_m = 0.6\n");
    EXPECT_THAT(problem, StartsWith("a.ini:2: 'width_m' and its new name 'size_m' are both set"));
}

TEST(IniFile, overrideWins) {
    SampleOptions options;
    auto ini = IniFile::fromText("[SampleOptions]\ncount = 3", "a.ini");
    ini.override("SampleOptions.count=4");
    ini.load({&options});
    EXPECT_EQ(options.count, 4);
    EXPECT_THROW(ini.override("count=4"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
