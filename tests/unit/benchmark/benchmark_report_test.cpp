#include "rgbd_graphslam/benchmark/benchmark_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SequenceResult desk() {
    SequenceResult result;
    result.name = "rgbd_dataset_freiburg1_desk";
    result.fingerprint = "abc";
    result.version = "1.2.3";
    result.frames = 573;
    result.ate_rmse_m = 0.01234;
    result.matched_poses = 570;
    result.cpu_ms_a_frame = 7.25;
    return result;
}

SequenceResult broken() {
    SequenceResult result;
    result.name = "broken";
    result.problem = "rgbd-slam: error: 'a<b' is cut off; fetch it again";
    return result;
}

const std::vector<KnownSequence> table =
    readSequenceTable(RGBD_SOURCE_DIR "/ini/tum-sequences.ini");

class Report : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_.write("out/" + desk().name + "/result.json", toJson(desk()));
        folder_.write("out/" + desk().name + "/ate.png", "Man");
        folder_.write("out/broken/result.json", toJson(broken()));
        folder_.write("out/unfinished/rgbd-slam.log", "");
    }
    TestFolder folder_;
};

TEST(SequenceResult, jsonReadsBackToTheSame) {
    const auto back = resultFromJson(toJson(desk()), "x");
    EXPECT_EQ(toJson(back), toJson(desk()));
    EXPECT_EQ(back.ate_rmse_m, desk().ate_rmse_m);
    EXPECT_FALSE(back.rpe_rmse_m);
    EXPECT_THROW(resultFromJson("{}", "x"), Error);
    EXPECT_THROW(resultFromJson("nonsense", "x"), Error);
}

TEST_F(Report, ourFigureStandsBesideTheBestPublished) {
    EXPECT_EQ(writeReport(folder_ / "out", table).size(), 2u);
    const std::string text = readText(folder_ / "out/report.md");
    EXPECT_THAT(text, HasSubstr("| rgbd_dataset_freiburg1_desk | 573 | 0 | 0 | 0 | 0.0123 | "
                                "0.0150 | 570 | – | – | 7.2 |"));
    EXPECT_THAT(text, HasSubstr("2 sequences with rgbd-graphslam 1.2.3, 1 failed; 1 of 1 at least "
                                "as good as the best published."));
    EXPECT_THAT(text, HasSubstr("Failed: " + broken().problem));
}

TEST_F(Report, theBestPublishedIsFoundAtAnyDepth) {
    SequenceResult deep = desk();
    deep.name = "handheld_freiburg1_" + deep.name;
    folder_.write("deep/" + deep.name + "/result.json", toJson(deep));
    writeReport(folder_ / "deep", table);
    EXPECT_THAT(readText(folder_ / "deep/report.md"), HasSubstr("| 0.0123 | 0.0150 |"));
}

TEST_F(Report, theHtmlFileNeedsNothingElse) {
    writeReport(folder_ / "out", table);
    const std::string text = readText(folder_ / "out/report.html");
    EXPECT_THAT(text, HasSubstr("<td>0.0123</td><td>0.0150</td>"));
    EXPECT_THAT(text, HasSubstr("data:image/png;base64,TWFu"));
    EXPECT_THAT(text, HasSubstr("a&lt;b"));
    EXPECT_THAT(text, Not(HasSubstr("http")));
}

TEST_F(Report, aFolderWithoutResultsIsAnError) {
    folder_.write("empty/notes.txt", "");
    EXPECT_THROW(writeReport(folder_ / "empty", table), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
