#include "rgbd_graphslam/benchmark/sequence_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/trajectory.h"

namespace rgbd_graphslam {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(SequenceTable, formulasOfMrptAreRefused) {
    const TestFolder folder;
    folder.write("a.ini", "[fr1/xyz]\nurl = https://$env{HOME}\n");
    EXPECT_THROW(readSequenceTable(folder / "a.ini"), Error);
}

TEST(SequenceTable, theShippedOneIsWhole) {
    const auto table = readSequenceTable(RGBD_SOURCE_DIR "/ini/tum-sequences.ini");
    EXPECT_GE(table.size(), 30u);
    for (const auto& sequence : table) {
        EXPECT_THAT(sequence.url, StartsWith("https://"));
        EXPECT_THAT(sequence.url, EndsWith(".tgz"));
        EXPECT_THAT(sequence.folder(), StartsWith("rgbd_dataset_freiburg"));
        EXPECT_EQ(findSequence(table, sequence.folder()), &sequence);
        EXPECT_FALSE(sequence.good_for.empty());
    }
}

TEST(SequenceTable, aSequenceIsFoundByAllItsNames) {
    const auto table = readSequenceTable(RGBD_SOURCE_DIR "/ini/tum-sequences.ini");
    for (const char* name :
         {"fr1/desk", "fr1_desk", "freiburg1_desk", "rgbd_dataset_freiburg1_desk"}) {
        const auto* found = findSequence(table, name);
        ASSERT_TRUE(found) << name;
        EXPECT_EQ(found->name, "fr1/desk");
        EXPECT_EQ(found->duration_s, 23.40);
        EXPECT_EQ(found->best_ate_m, 0.015);
        EXPECT_TRUE(found->duration_checked && found->length_checked);
    }
    EXPECT_TRUE(findSequence(table, "fr1/room")->duration_checked);
    EXPECT_FALSE(findSequence(table, "fr1/room")->length_checked);
    EXPECT_FALSE(findSequence(table, "fr1/des"));
    EXPECT_FALSE(findSequence(table, "tum-fr1-desk-9"));
}

StampedPose poseNearest(const Trajectory& sorted, double stamp_s) {
    const auto after =
        std::lower_bound(sorted.begin(), sorted.end(), stamp_s,
                         [](const auto& pose, double wanted_s) { return pose.stamp_s < wanted_s; });
    if (after == sorted.end()) return sorted.back();
    if (after == sorted.begin()) return *after;
    const auto before = after - 1;
    return after->stamp_s - stamp_s < stamp_s - before->stamp_s ? *after : *before;
}

std::string complaintAbout(const std::string& text) {
    const TestFolder folder;
    folder.write("t.ini", text);
    try {
        readSequenceTable(folder / "t.ini");
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(SequenceTable, mistakesAreNamed) {
    const std::string good = "[fr1/a]\nurl = http://h/a.tgz\ngood_for = x\nduration_s = 1\n";
    EXPECT_THAT(complaintAbout(good), HasSubstr("[fr1/a]: the key 'length_m' is missing"));
    EXPECT_EQ(complaintAbout(good + "length_m = 2\n"), "no error");
    EXPECT_THAT(complaintAbout(good + "length_m = long\n"), HasSubstr("'long' is no positive"));
    EXPECT_THAT(complaintAbout(good + "length_m = 2\nsize = 3\n"), HasSubstr("key 'size'"));
    EXPECT_THAT(complaintAbout("// nothing\n"), HasSubstr("names no sequence"));
}

TEST(SequenceTable, theListMarksWhatNobodyChecked) {
    const TestFolder folder;
    folder.write("t.ini",
                 "[fr1/a]\nurl = http://h/a.tgz\ngood_for = x\nduration_s = 1\nlength_m = 2\n"
                 "checked = length\nbytes = 3000000\n");
    EXPECT_THAT(toText(readSequenceTable(folder / "t.ini")),
                HasSubstr(" ~   1.0 s   2.00 m     3 MB  x\n"));
}

/** What the table calls checked, where the truth is at hand: the duration, and the length as the
 *  benchmark's page has it. */
TEST(SequenceTable, checkedFiguresAreThoseOfTheTruth) {
    const std::string data = RGBD_SOURCE_DIR "/../shared/data/trajectories/";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no data in " << data;
    const auto table = readSequenceTable(RGBD_SOURCE_DIR "/ini/tum-sequences.ini");
    for (const auto& [name, file] :
         std::map<std::string, std::string>{{"fr1/xyz", "freiburg1_xyz-groundtruth.txt"},
                                            {"fr1/desk", "fr1_desk_lists/groundtruth.txt"},
                                            {"fr2/desk", "fr2_desk_groundtruth.txt"}}) {
        const Trajectory truth = readTumTrajectory(data + file);
        const double duration_s = truth.back().stamp_s - truth.front().stamp_s;
        double sum_m = 0;
        for (const auto& pose : truth) {
            if (pose.stamp_s + 1 > truth.back().stamp_s) break;
            sum_m +=
                (poseNearest(truth, pose.stamp_s + 1).T_world_cam.t - pose.T_world_cam.t).norm();
        }
        const auto* known = findSequence(table, name);
        EXPECT_NEAR(known->duration_s, duration_s, 0.0051) << name;
        EXPECT_NEAR(known->length_m, sum_m * duration_s / static_cast<double>(truth.size() - 1),
                    0.00051)
            << name;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
