#include "rgbd_graphslam/report/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>

#include "rgbd_graphslam/core/error.h"
#include "run_folder_files.h"

namespace rgbd_graphslam {
namespace {

using testing::HasSubstr;
using testing::Not;

/** A name that would be markup and a template. */
constexpr const char* hostile = "/data/<script>document.title=1</script>{{title}}&.rawlog";

std::string reportOf(const MadeRun& run) {
    const TestFolder folder;
    makeRunFolder(folder, run);
    writeRunReport(folder / "", folder / "");
    return readText(folder / "report.html");
}

TEST(RunReport, showsEverySection) {
    const std::string page = reportOf({});
    for (const char* title :
         {"Map from above", "Trajectory from above", "Loop closure", "Error over time", "Inliers",
          "CPU time by stage", "About this run"}) {
        EXPECT_THAT(page, HasSubstr(title));
    }
}

TEST(RunReport, leavesOutWhatThereIsNot) {
    MadeRun run;
    run.with_truth = run.with_maps = run.with_loop = false;
    const std::string page = reportOf(run);
    for (const char* title :
         {"Map from above", "3-D map", "Loop closure", "Error over time", "intrinsics"}) {
        EXPECT_THAT(page, Not(HasSubstr(title)));
    }
}

TEST(RunReport, tellsTheQualityThatNeedsNoTruth) {
    MadeRun run;
    EXPECT_THAT(reportOf(run), Not(HasSubstr("Quality without ground truth")));  // of before
    run.quality = R"({"inliers": {"median": 412, "p05": 77}, "depth_coverage": null,
        "surface_spread": {"surfaces": 900, "median_mm": 3.14, "p95_mm": 9.2},
        "drift_before_loops": {"gap_m": 0.05, "path_m": 10, "percent": 0.5}})";
    const std::string page = reportOf(run);
    EXPECT_THAT(page, HasSubstr("Quality without ground truth"));
    EXPECT_THAT(page, HasSubstr("3.1 mm, 95 % within 9.2 mm"));
    EXPECT_THAT(page, HasSubstr("0.050 m (0.50 % of 10.0 m)"));
    EXPECT_THAT(page, HasSubstr("412, in 95 % of the frames above 77"));
    EXPECT_THAT(page, Not(HasSubstr("pixels with depth")));
}

TEST(RunReport, hasItsPictureOfLoopsInAFile) {
    const TestFolder folder;
    makeRunFolder(folder, {});
    writeRunReport(folder / "", folder / "");
    const std::string page = readText(folder / "report.html");
    const std::string picture = readText(folder / "loops.svg");
    for (const char* line : {"before", "after", "loop"}) {
        const std::string drawn = "<polyline class=\"" + std::string(line) + "\" points=";
        const std::size_t from = picture.find(drawn);
        ASSERT_NE(from, std::string::npos) << line;
        EXPECT_THAT(page, HasSubstr(picture.substr(from, picture.find("/>", from) - from)));
        EXPECT_THAT(picture, HasSubstr("." + std::string(line) + " { stroke: #"));
    }
    EXPECT_THAT(picture, testing::StartsWith("<svg xmlns=\"http:"
                                             "//www.w3.org/2000/svg\" viewBox"));
    MadeRun without;
    without.with_loop = false;
    makeRunFolder(folder, without);
    writeRunReport(folder / "", folder / "");
    EXPECT_FALSE(std::filesystem::exists(folder / "loops.svg"));
}

TEST(RunReport, tellsTheSameErrorAsTheRun) {
    EXPECT_THAT(reportOf(MadeRun()), HasSubstr("<b>12.3 mm</b><span>ATE RMSE"));
}

TEST(RunReport, tellsCommandDateAndCamera) {
    MadeRun run;
    run.origin = R"({"command": "rgbd-slam a.ini b.rawlog -o 'my out'", "date": "2024-05-01 14:03",
        "camera": {"width": 640, "height": 480, "fx": 517.3, "fy": 516.5, "cx": 318.6,
                   "cy": 255.3, "distortion": [0.26, -0.95, -0.005, 0.002, 1.16]}})";
    const std::string page = reportOf(run);
    EXPECT_THAT(page, HasSubstr("rgbd-slam a.ini b.rawlog -o &#39;my out&#39;"));
    EXPECT_THAT(page, HasSubstr("2024-05-01 14:03"));
    EXPECT_THAT(page, HasSubstr("640 x 480 px, pinhole with Brown-Conrady distortion"));
    EXPECT_THAT(page, HasSubstr("fx 517.30, fy 516.50, cx 318.60, cy 255.30 px; k1 0.26"));
}

TEST(RunReport, figuresHaveNoNeedlessDecimals) {
    EXPECT_THAT(reportOf(MadeRun()),
                HasSubstr("<td>60</td><td>3.0</td><td>2.5</td><td>4.0</td><td>9.0</td>"));
    EXPECT_THAT(reportOf(MadeRun()), HasSubstr("<b>7.0 ms</b><span>CPU per frame"));
}

TEST(RunReport, tellsTheShareOfAStage) {
    EXPECT_THAT(reportOf(MadeRun()), HasSubstr("<td>100 %</td><td class=\"bar\">"));
}

TEST(RunReport, drawsNothingFromOneSessionToTheNext) {
    const std::regex before("<polyline class=\"before\"");
    const auto pieces = [&](const std::string& earlier_sessions) {
        MadeRun run;
        run.earlier_sessions = earlier_sessions;
        const std::string page = reportOf(run);
        return std::distance(std::sregex_iterator(page.begin(), page.end(), before), {});
    };
    EXPECT_EQ(pieces("[]"), 1);
    EXPECT_EQ(pieces("[{\"rawlog\": \"a.rawlog\", \"keyframes\": 3}]"), 2);
}

TEST(RunReport, namesItsLinesWhereTheFirstPieceIsAPoint) {
    MadeRun run;
    run.first_lost = 1;
    run.end_lost = 4;
    const std::string page = reportOf(run);
    EXPECT_THAT(page, HasSubstr(">estimate</text>"));
    EXPECT_THAT(page, HasSubstr(">after loop closure</text>"));
}

TEST(RunReport, drawsNothingAcrossLostFrames) {
    const std::regex estimate("<polyline class=\"estimate\"");
    const auto pieces = [&](const MadeRun& run) {
        const std::string page = reportOf(run);
        return std::distance(std::sregex_iterator(page.begin(), page.end(), estimate), {});
    };
    MadeRun run;
    EXPECT_EQ(pieces(run), 1);
    run.first_lost = 20;
    run.end_lost = 35;
    EXPECT_EQ(pieces(run), 2);
}

TEST(RunReport, showsTheWorstLoopsAndMarksFalseOnes) {
    MadeRun run;
    run.loop_edges = "[[0, 5, 40, 0.012], [1, 5, 33, 0.7], [1, 4, 21, null]]";
    run.false_loops = "1";
    const std::string page = reportOf(run);
    const auto worst = page.find(
        "<tr class=\"false\"><td>1 and 5</td><td>1.0 s and 5.0 s</td>"
        "<td>33</td><td>700 mm, false</td></tr>");
    const auto good = page.find(
        "<tr><td>0 and 5</td><td>0.0 s and 5.0 s</td><td>40</td>"
        "<td>12.0 mm</td></tr>");
    ASSERT_NE(worst, std::string::npos);
    EXPECT_GT(good, worst);
    EXPECT_LT(good, page.find("<td>1 and 4</td>"));
    EXPECT_THAT(
        page, HasSubstr("(known for 2 of 3 loops) it is 356 mm in the median and 700 mm at most"));
    EXPECT_THAT(page, HasSubstr("1 of 3 loops is false"));
}

TEST(RunReport, saysThatLoopsCannotBeCheckedWithoutTruth) {
    MadeRun run;
    run.loop_edges = "[[0, 5, 40]]";  // as earlier versions wrote it
    run.false_loops = "null";
    const std::string page = reportOf(run);
    EXPECT_THAT(page, HasSubstr("Without ground truth the loops cannot be checked."));
    EXPECT_THAT(page, HasSubstr("<td>not known</td>"));
}

TEST(RunReport, needsNoOtherFile) {
    const std::string page = reportOf({});
    const std::regex reference("(src|href|url)\\s*[=(]\\s*\"?([^\"> ]{0,5})");
    for (std::sregex_iterator it(page.begin(), page.end(), reference), end; it != end; ++it) {
        EXPECT_EQ((*it)[2], "data:");
    }
    EXPECT_THAT(page, Not(HasSubstr("//")));
}

TEST(RunReport, escapesNames) {
    MadeRun run;
    run.rawlog = hostile;
    const std::string page = reportOf(run);
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(page, HasSubstr("&lt;script&gt;document.title=1"));
    EXPECT_THAT(page, HasSubstr("{{title}}&amp;.rawlog"));
}

TEST(RunReport, namesTheFileThatMakesNoSense) {
    const TestFolder folder;
    makeRunFolder(folder, {});
    folder.write("frames.csv", "stamp_s,origin,inliers,keyframe\n1,tracked,7,\n2,found,7,\n");
    try {
        writeRunReport(folder / "", folder / "");
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("frames.csv:3"));
    }
    folder.write("summary.json", "{}");
    EXPECT_THROW(writeRunReport(folder / "", folder / ""), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "report.html"));
}

/** The page in a real browser. */
class ReportInChromium : public testing::Test {
  protected:
    void SetUp() override {
        if (std::system("command -v chromium >/dev/null 2>&1") != 0) {
            GTEST_SKIP() << "chromium is not installed (apt-get install chromium)";
        }
    }
    /** \return what it printed */
    std::string chromium(const std::string& arguments, const char* page = "report.html") const {
        const std::string command =
            "timeout 60 chromium --headless --no-sandbox --disable-gpu --hide-scrollbars "
            "--window-size=1160,1900 --user-data-dir='" +
            folder_ / "profile" + "' " + arguments + " 'file://" + folder_ / page + "' >'" +
            folder_ / "out" + "' 2>'" + folder_ / "err" + "' </dev/null";
        const int status = std::system(command.c_str());
        EXPECT_EQ(status, 0) << readText(folder_ / "err");
        return readText(folder_ / "out");
    }
    TestFolder folder_;
};

int pixelsLike(const cv::Mat& picture, const cv::Scalar& bgr) {
    cv::Mat mask;
    cv::inRange(picture, bgr - cv::Scalar::all(6), bgr + cv::Scalar::all(6), mask);
    return cv::countNonZero(mask);
}

TEST_F(ReportInChromium, isDrawn) {
    makeRunFolder(folder_, {});
    writeRunReport(folder_ / "", folder_ / "");
    chromium("--screenshot='" + folder_ / "page.png" + "'");
    const cv::Mat picture = cv::imread(folder_ / "page.png");
    ASSERT_EQ(picture.size(), cv::Size(1160, 1900));
    EXPECT_GT(pixelsLike(picture, {255, 0, 255}), 100000);  // the map
    EXPECT_GT(pixelsLike(picture, {31, 102, 217}), 300);    // the path
    EXPECT_GT(pixelsLike(picture, {180, 119, 31}), 300);    // keyframes, landmarks, times
}

TEST_F(ReportInChromium, fitsTheScreenOfATelephone) {
    makeRunFolder(folder_, {});
    writeRunReport(folder_ / "", folder_ / "");
    // In a frame of that width: windows of a browser have a least width.
    folder_.write("frame.html",
                  "<iframe id=f style='width:420px;height:3000px' src=report.html></iframe><script>"
                  "f.onload=()=>document.title=f.contentDocument.documentElement.scrollWidth"
                  "</script>");
    const std::string dom = chromium("--allow-file-access-from-files --dump-dom", "frame.html");
    EXPECT_THAT(dom, HasSubstr("<title>420</title>"));
}

TEST_F(ReportInChromium, takesAHostileNameForText) {
    MadeRun run;
    run.rawlog = hostile;
    makeRunFolder(folder_, run);
    writeRunReport(folder_ / "", folder_ / "");
    const std::string dom = chromium("--dump-dom");
    EXPECT_THAT(dom, HasSubstr("<h1>script&gt;{{title}}&amp;.rawlog</h1>"));
    EXPECT_THAT(dom, Not(HasSubstr("<script")));
    EXPECT_THAT(dom, Not(HasSubstr("<title>1</title>")));
}

}  // namespace
}  // namespace rgbd_graphslam
