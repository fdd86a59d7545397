#include "rgbd_graphslam/core/console.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <new>
#include <stdexcept>

namespace rgbd_graphslam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(WarningRecord, keepsWhatIsSaidWhileItLives) {
    sayWarning("before");
    const WarningRecord record;
    EXPECT_THAT(record.warnings(), IsEmpty());
    sayWarning("one");
    {
        const WarningRecord inner;
        sayWarning("two");
        EXPECT_THAT(inner.warnings(), ElementsAre("two"));
    }
    EXPECT_THAT(record.warnings(), ElementsAre("one", "two"));
}

struct Problem {
    const char* name;
    std::function<int()> body;
    const char* line;
};

class RunMain : public testing::TestWithParam<Problem> {};

TEST_P(RunMain, saysOneLineAndEndsWithOne) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(runMain("tool", GetParam().body), 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              std::string("tool: error: ") + GetParam().line + "\n");
}

const Problem problems[] = {
    {"memory", []() -> int { throw std::bad_alloc(); },
     "out of memory; use fewer frames or a coarser map"},
    {"length", []() -> int { throw std::length_error("vector::reserve"); },
     "a file asks for more memory than there can be; make it again"},
    {"other", []() -> int { throw std::runtime_error("no\x1b[2Jsuch\nfile"); }, "no?[2Jsuch?file"},
};

INSTANTIATE_TEST_SUITE_P(Problems, RunMain, testing::ValuesIn(problems),
                         [](const auto& problem) { return std::string(problem.param.name); });

TEST(RunMainDeathTest, saysALineOfACrash) {
    EXPECT_EXIT(runMain("tool", [] { return raise(SIGSEGV); }), testing::KilledBySignal(SIGSEGV),
                "^tool: error: crashed; a damaged input file or too little memory");
}

TEST(Verbosity, tellsWhatIsSaid) {
    const auto said = [](Verbosity verbosity) {
        setVerbosity(verbosity);
        testing::internal::CaptureStderr();
        sayDetail("detail");
        sayInfo("info");
        sayWarning("trouble");
        setVerbosity(Verbosity::Normal);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(said(Verbosity::Quiet), "warning: trouble\n");
    EXPECT_EQ(said(Verbosity::Normal), "info\nwarning: trouble\n");
    EXPECT_EQ(said(Verbosity::Verbose), "detail\ninfo\nwarning: trouble\n");
}

}  // namespace
}  // namespace rgbd_graphslam
