#include "rgbd_graphslam/benchmark/sequence_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

std::vector<std::string> namesOf(const std::vector<FoundSequence>& sequences) {
    std::vector<std::string> names;
    for (const auto& sequence : sequences) names.push_back(sequence.name);
    return names;
}

class Search : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const char* folder : {"all/fr1_desk/", "all/two/a/"}) {
            folder_.write(folder + std::string("rgb.txt"), "");
            folder_.write(folder + std::string("depth.txt"), "");
        }
        folder_.write("all/fr1_desk/rgb/1.png", "");
        folder_.write("all/fr1_desk.tgz", "");
        folder_.write("all/two/b.tgz", "");
        folder_.write("all/c.rawlog", "");
        folder_.write("all/two/d.bag", "");
        folder_.write("all/notes.txt", "");
        folder_.write("all/out/x/sequence.rawlog", "");
    }
    std::vector<FoundSequence> find(const std::vector<std::string>& roots) const {
        return findSequences(roots, folder_ / "all/out");
    }
    TestFolder folder_;
};

TEST_F(Search, foldersArchivesAndRawlogsAtAnyDepth) {
    const auto found = find({folder_ / "all"});
    EXPECT_THAT(namesOf(found), ::testing::ElementsAre("c", "fr1_desk", "two_a", "two_b", "two_d"));
    EXPECT_EQ(found[1].source, folder_ / "all/fr1_desk") << "the folder goes before its archive";
}

TEST_F(Search, aRootMayBeASequence) {
    EXPECT_THAT(namesOf(find({folder_ / "all/two/a"})), ::testing::ElementsAre("a"));
    EXPECT_THAT(namesOf(find({folder_ / "all/two/", folder_ / "all/two/b.tgz"})),
                ::testing::ElementsAre("a", "b", "d"));
}

TEST_F(Search, onlyArchivesOfFoldersCount) {
    folder_.write("packed/x.tar.gz", "");
    folder_.write("packed/rosout.log.gz", "");
    EXPECT_THAT(namesOf(find({folder_ / "packed"})), ::testing::ElementsAre("x"));
}

TEST_F(Search, linksMayLeadAnywhere) {
    std::filesystem::create_directory_symlink(folder_ / "all", folder_ / "all/two/loop");
    std::filesystem::create_directory_symlink(folder_ / "all/two", folder_ / "linked");
    EXPECT_EQ(find({folder_ / "all"}).size(), 5u);
    EXPECT_THAT(namesOf(find({folder_ / "linked"})), ::testing::IsSupersetOf({"a", "b", "d"}));
}

TEST_F(Search, nothingAndDoubleNamesAreErrors) {
    folder_.write("other/c.rawlog", "");
    EXPECT_THROW(find({folder_ / "all", folder_ / "other"}), Error);
    EXPECT_THROW(find({folder_ / "all/fr1_desk/rgb"}), Error);
    EXPECT_THROW(find({folder_ / "nowhere"}), Error);
}

TEST_F(Search, sharesPartTheWork) {
    const auto all = find({folder_ / "all"});
    std::multiset<std::string> together;
    for (const char* share : {"1/3", "2/3", "3/3"}) {
        for (const auto& name : namesOf(shareOf(all, parseShare(share)))) together.insert(name);
    }
    EXPECT_THAT(together, ::testing::ElementsAreArray(namesOf(all)));
    EXPECT_TRUE(shareOf(all, parseShare("6/6")).empty());
    for (const char* wrong : {"0/3", "4/3", "1", "1/3x", "-1/3", "a/b", ""}) {
        EXPECT_THROW(parseShare(wrong), Error) << wrong;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
