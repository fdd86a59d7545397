#include "rgbd_graphslam/report/run_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_folder_files.h"

namespace rgbd_graphslam {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> findings(const MadeRun& made, Finding::Kind kind) {
    const TestFolder folder;
    makeRunFolder(folder, made);
    const RunRecord run = readRunRecord(folder / "", folder / "");
    std::optional<AteResult> ate;
    if (!run.truth.empty()) ate = evaluateAte(run.trajectory, run.truth);
    std::vector<std::string> texts;
    for (const Finding& finding : findingsOf(run, ate)) {
        if (finding.kind == kind) texts.push_back(finding.text);
    }
    return texts;
}

std::vector<std::string> warnings(const MadeRun& made) {
    return findings(made, Finding::Kind::Warning);
}

TEST(Findings, aGoodRunHasNoWarning) {
    EXPECT_THAT(warnings({}), IsEmpty());
}

TEST(Findings, lostFramesAreNamedByTheirTime) {
    MadeRun run;
    run.first_lost = 20;
    run.end_lost = 35;
    EXPECT_THAT(warnings(run), Contains("15 frames lost between 2.0 s and 3.4 s, recovered"));
    run.end_lost = run.frames;
    EXPECT_THAT(warnings(run), Contains("40 frames lost between 2.0 s and 5.9 s, not found again"));
    run.end_lost = 21;
    EXPECT_THAT(warnings(run), Contains("1 frame lost at 2.0 s, recovered"));
}

TEST(Findings, manyLostSpansAreSummedUp) {
    RunRecord run;
    for (int i = 0; i < 400; ++i) {
        run.frames.push_back(
            {0.1 * i, i % 20 == 3 ? FrameState::Lost : FrameState::Tracked, 300, false});
    }
    std::vector<std::string> texts;
    for (const Finding& finding : findingsOf(run, std::nullopt)) texts.push_back(finding.text);
    EXPECT_THAT(texts, Contains("1 frame lost at 0.3 s, recovered"));
    EXPECT_THAT(texts, Contains("15 frames lost in 15 shorter spans"));
}

TEST(Findings, depthScaleIsSaidInPercentAndAsAFactor) {
    MadeRun run;
    run.depth_factor = 1.035;
    EXPECT_THAT(warnings(run), Contains(HasSubstr("depth scale looks 3.5 % too large")));
    EXPECT_THAT(warnings(run), Contains(HasSubstr("0.966")));
    run.depth_factor = 0.95;
    EXPECT_THAT(warnings(run), Contains(HasSubstr("depth scale looks 5.0 % too small")));
}

TEST(Findings, whatTheRunHasSaidOfDepthIsNotSaidTwice) {
    MadeRun run;
    run.depth_factor = 1.035;
    run.warnings = R"(["depth scale looks 3.4 % too large: multiply"])";
    const auto all = warnings(run);
    EXPECT_EQ(std::count_if(all.begin(), all.end(),
                            [](const auto& text) { return text.find("depth scale") == 0; }),
              1);
}

TEST(Findings, depthScaleIsNotBlamedForOtherErrors) {
    AteResult ate;
    ate.fitted_scale = 1.03;
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d place(std::cos(i), std::sin(i), 0);
        ate.pairs.push_back({0.1 * i, place, place + Eigen::Vector3d(0, 0, i % 2 ? 0.5 : -0.5)});
    }
    EXPECT_FALSE(depthScaleError(ate));
}

/** A scale that fits better explains 41 % of the squared error, as on a healthy walk along blank
 *  walls. */
TEST(Findings, depthScaleIsNotBlamedForDrift) {
    AteResult ate;
    ate.fitted_scale = 1.05;
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d place(std::cos(i), std::sin(i), 0);
        ate.pairs.push_back(
            {0.1 * i, place, 1.05 * place + Eigen::Vector3d(0, 0, i % 2 ? 0.06 : -0.06)});
    }
    EXPECT_FALSE(depthScaleError(ate));
    for (AtePair& pair : ate.pairs) pair.truth_m.z() /= 3;
    EXPECT_TRUE(depthScaleError(ate));
}

TEST(Findings, fewLandmarksAreSaid) {
    RunRecord run;
    for (int i = 0; i < 100; ++i) {
        run.frames.push_back({0.1 * i, FrameState::Tracked, i < 30 ? 20 : 300, false});
    }
    std::vector<std::string> texts;
    for (const Finding& finding : findingsOf(run, std::nullopt)) texts.push_back(finding.text);
    EXPECT_THAT(texts, Contains(HasSubstr("30 % of the tracked frames have fewer than 50")));
}

TEST(Findings, warningsOfTheRunAreRepeated) {
    MadeRun run;
    run.warnings = R"(["up is taken from the first camera"])";
    EXPECT_THAT(warnings(run), Contains("up is taken from the first camera"));
}

TEST(Findings, loopsAndMissingMapsAreNotes) {
    MadeRun run;
    EXPECT_THAT(findings(run, Finding::Kind::Note), Contains(HasSubstr("1 loop closed")));
    run.with_loop = run.with_maps = false;
    const auto notes = findings(run, Finding::Kind::Note);
    EXPECT_THAT(notes, Contains(HasSubstr("no loop was closed")));
    EXPECT_THAT(notes, Contains(HasSubstr("no dense maps")));
    EXPECT_THAT(notes, Not(Contains(HasSubstr("1 loop closed"))));
}

}  // namespace
}  // namespace rgbd_graphslam
