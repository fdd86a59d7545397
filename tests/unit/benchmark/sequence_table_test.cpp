#include "rgbd_graphslam/benchmark/sequence_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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
    }
    EXPECT_FALSE(findSequence(table, "fr1/des"));
    EXPECT_FALSE(findSequence(table, "tum-fr1-desk-9"));
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

}  // namespace
}  // namespace rgbd_graphslam
