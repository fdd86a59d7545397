/** The evaluations against figures and lists of the TUM benchmark's own tools. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <sstream>

#include "../support/tum_folder.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"
#include "rgbd_graphslam/evaluation/commands.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

class EvaluationData : public testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("RGBD_DATA");
        data_ = folder ? fs::path(folder) : fs::path(RGBD_SOURCE_DIR) / "../shared/data";
        if (!fs::exists(data_ / "trajectories")) GTEST_SKIP() << "no data in " << data_;
    }
    std::string file(const std::string& name) const { return data_ / name; }
    std::string trajectory(const std::string& name) const { return file("trajectories/" + name); }
    fs::path data_;
};

/** What one of the benchmark's tools printed. */
struct ToolRun {
    std::vector<std::string> command;  // tool, truth, estimate, options
    std::vector<std::string> lines;
};

std::vector<std::string> wordsOf(const std::string& line) {
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

std::vector<ToolRun> toolRuns(const std::string& path) {
    std::vector<ToolRun> runs;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
        const auto words = wordsOf(line);
        if (words.empty()) continue;
        if (words.front() == "$") {
            runs.push_back({{words.begin() + 1, words.end()}, {}});
        } else {
            runs.back().lines.push_back(line);
        }
    }
    return runs;
}

/** What our tool prints for the same command. */
std::string ourText(const ToolRun& run, const std::string& estimate, const std::string& truth) {
    if (run.command[0] == "evaluate_ate.py") {
        AteRequest request;
        request.files = {estimate, truth};
        return runAte(request);
    }
    RpeRequest request;
    request.files = {estimate, truth};
    request.options.fixed_delta = true;
    request.options.max_pairs = 0;
    const auto unit = std::find(run.command.begin(), run.command.end(), "--delta_unit") + 1;
    request.options.unit = *unit == "f" ? DeltaUnit::Frames : DeltaUnit::Seconds;
    return runRpe(request);
}

TEST_F(EvaluationData, digitsAreThoseOfTheTumTools) {
    std::size_t compared = 0;
    for (const auto& run : toolRuns(trajectory("expected_tum_tools_output.txt"))) {
        const auto truth = trajectory(run.command[1]), estimate = trajectory(run.command[2]);
        if (!fs::exists(estimate)) continue;
        const std::string text = "\n" + ourText(run, estimate, truth);
        for (const auto& line : run.lines) {
            EXPECT_THAT(text, testing::HasSubstr("\n" + line + "\n")) << run.command[2];
        }
        ++compared;
    }
    EXPECT_GE(compared, 9u);
}

TEST_F(EvaluationData, truthOfARawlogGivesTheSameDigits) {
    const TestFolder folder;
    const std::string rawlog = folder / "truth.rawlog";
    importSequence(readTumSequence(file("tum-fr1-xyz-4")), CameraSetup(), rawlog, {});
    AteRequest request;
    request.files = {trajectory("freiburg1_xyz-rgbdslam.txt"),
                     trajectory("freiburg1_xyz-groundtruth.txt")};
    const auto expected = runAte(request);
    request.files.back() = rawlog;
    EXPECT_EQ(runAte(request), expected);
}

std::vector<std::string> linesOf(const std::string& path) {
    std::vector<std::string> lines;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        lines.push_back(line);
    }
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const auto& line : lines) text += line + "\n";
    return text;
}

/** One half of each line of a list of pairs. */
std::vector<StampedLine> halfOf(const std::vector<std::string>& pairs, std::size_t first_word) {
    std::vector<StampedLine> half;
    for (const auto& pair : pairs) {
        const auto words = wordsOf(pair);
        half.push_back({std::stod(words[first_word]), words[first_word + 1]});
    }
    return half;
}

TEST_F(EvaluationData, associationOfWholeListsIsTheReference) {
    const AssociateRequest request{
        trajectory("fr1_desk_lists/rgb.txt"), trajectory("fr1_desk_lists/depth.txt"), {}};
    EXPECT_EQ(runAssociate(request),
              joined(linesOf(trajectory("associations_reference/fr1_desk.txt"))));
}

/** Of fr1/xyz the list of color images is known only as far as they found a partner, which takes
 *  nothing away from the others. */
TEST_F(EvaluationData, associationWithAWholeDepthListIsTheReference) {
    const auto reference = linesOf(trajectory("associations_reference/fr1_xyz.txt"));
    const auto depth = readStampedList(trajectory("fr1_xyz_lists/depth.txt"));
    EXPECT_GT(depth.size(), reference.size());
    EXPECT_EQ(associationText(halfOf(reference, 0), depth), joined(reference));
}

TEST_F(EvaluationData, everyReferenceAssociatesToItself) {
    std::size_t lists = 0;
    for (const auto& entry : fs::directory_iterator(trajectory("associations_reference"))) {
        const auto reference = linesOf(entry.path());
        EXPECT_EQ(associationText(halfOf(reference, 0), halfOf(reference, 2)), joined(reference))
            << entry.path();
        ++lists;
    }
    EXPECT_EQ(lists, 10u);
}

TEST_F(EvaluationData, oneImageBecomesOnePointAReading) {
    const TestFolder folder;
    PointCloudRequest request;
    request.color = file("tum-fr1-xyz-4/rgb/1305031102.175304.png");
    request.depth = file("tum-fr1-xyz-4/depth/1305031102.160407.png");
    request.camera = "fr1";
    request.output = folder / "image.ply";
    runPointCloud(request);
    const auto image = readRgbdImage(request.color, request.depth, 1 / 5000.0);
    const auto cloud = readPly(request.output);
    EXPECT_EQ(cloud.vertices.size(), static_cast<std::size_t>(cv::countNonZero(image.depth)));
    EXPECT_EQ(cloud.colors.size(), cloud.vertices.size());
}

/** Every second image of a rendered room, put where its true pose says, lies on the others. */
TEST_F(EvaluationData, posedImagesFitTogether) {
    const TestFolder folder;
    PointCloudRequest request;
    request.color = file("icl-livingroom-110/rgb.txt");
    request.depth = file("icl-livingroom-110/depth.txt");
    request.trajectory = file("icl-livingroom-110/groundtruth.txt");
    request.depth_units = 1000;
    request.options.every_pixel = 4;
    request.output = folder / "all.ply";
    EXPECT_THAT(runPointCloud(request), testing::HasSubstr("images 110\n"));
    request.every_image = 109;
    request.options.every_pixel = 1;
    MapRequest map;
    map.map = request.output;
    map.surface = request.output = folder / "two.ply";
    EXPECT_THAT(runPointCloud(request), testing::HasSubstr("images 2\n"));
    const auto accuracy = evaluateMap(readPly(map.map), readPly(map.surface));
    EXPECT_LT(accuracy.distance_m.median, 0.01);
    EXPECT_GT(accuracy.completeness, 0.95);
}

}  // namespace
}  // namespace rgbd_graphslam
