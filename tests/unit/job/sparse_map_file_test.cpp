#include "rgbd_graphslam/job/sparse_map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {
using ::testing::HasSubstr;

SparseMap smallMap() {
    Frame frame;
    frame.stamp_s = 12.5;
    frame.keypoints.resize(20);
    frame.descriptors.resize(20, {1, 2, 3, 4});
    SlamMap map(1.25, 6);
    for (int k = 0; k < 3; ++k) map.addKeyframe(frame, SE3());
    for (int i = 0; i < 20; ++i) map.addLandmark({0.1 * i, 0, 2}, i % 3, i);
    SparseMap sparse;
    sparse.snapshot = takeSnapshot(map, rigOf(CameraModel{}), 1.25, {});
    sparse.T_up_world.t = {1, 2, 3};
    sparse.config_hash = "0123456789abcdef";
    sparse.sessions = {{"/data/monday.rawlog", 0}, {"/data/tuesday.rawlog", 2, "REAR"}};
    return sparse;
}

class SparseMapFile : public testing::Test {
  protected:
    SparseMapFile() : path_(folder_ / "map.sparse") {
        writeSparseMap(path_, smallMap());
        bytes_ = readText(path_);
    }
    void expectRefused(const std::string& bytes, const std::string& reason) const {
        folder_.write("map.sparse", bytes);
        try {
            readSparseMap(path_);
            ADD_FAILURE() << "taken; should be refused: " << reason;
        } catch (const Error& e) {
            EXPECT_THAT(e.what(), HasSubstr(path_));
            EXPECT_THAT(e.what(), HasSubstr(reason));
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
        }
    }

    TestFolder folder_;
    std::string path_, bytes_;
};

TEST_F(SparseMapFile, comesBack) {
    const SparseMap map = readSparseMap(path_);
    EXPECT_EQ(map.snapshot.keyframes.size(), 3u);
    EXPECT_EQ(map.snapshot.landmarks.size(), 20u);
    EXPECT_EQ(map.snapshot.keyframes[1].frame.stamp_s, 12.5);
    EXPECT_EQ(map.T_up_world.t, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(map.config_hash, "0123456789abcdef");
    ASSERT_EQ(map.sessions.size(), 2u);
    EXPECT_EQ(map.sessions[1].rawlog, "/data/tuesday.rawlog");
    EXPECT_EQ(map.sessions[1].first_keyframe, 2);
    EXPECT_EQ(map.sessions[0].sensor_label, "");
    EXPECT_EQ(map.sessions[1].sensor_label, "REAR");
}

/** The format is fixed: these bytes are the same on every machine. */
TEST_F(SparseMapFile, startsAsDocumented) {
    EXPECT_EQ(bytes_.substr(0, 8), "RGBDMAP\n");
    EXPECT_EQ(bytes_.substr(8, 4), std::string("\3\0\0\0", 4));
    EXPECT_EQ(
        static_cast<unsigned char>(bytes_[12]) + 256u * static_cast<unsigned char>(bytes_[13]),
        bytes_.size() - 24);
    EXPECT_EQ(bytes_.substr(24, 20), std::string("\x10\0\0\0", 4) + "0123456789abcdef");
}

TEST_F(SparseMapFile, everyFlippedBitIsNoticed) {
    for (std::size_t i = 0; i < bytes_.size(); i += 7) {
        std::string flipped = bytes_;
        flipped[i] = static_cast<char>(flipped[i] ^ (1 << i % 8));
        expectRefused(flipped, i < 8 ? "is no map" : i < 12 ? "version" : "damaged");
    }
}

TEST_F(SparseMapFile, everyCutIsNoticed) {
    expectRefused("", "is no map");
    expectRefused(bytes_.substr(0, 10), "cut off");
    for (std::size_t i = 24; i < bytes_.size(); i += 31)
        expectRefused(bytes_.substr(0, i), "cut off");
    expectRefused(bytes_ + "x", "damaged");
}

TEST_F(SparseMapFile, otherVersionsAndOtherFilesAreNamed) {
    std::string other = bytes_;
    other[8] = 1;
    expectRefused(other, "is of version 1, this program reads versions 2 to 3");
    expectRefused(std::string(1000, 'x'), "is no map of rgbd-slam");
    EXPECT_THROW(readSparseMap(folder_ / "nothing"), Error);
    EXPECT_THROW(readSparseMap(folder_ / ""), Error);
}

/** The check sum is right, the content is not. */
TEST_F(SparseMapFile, sessionsMustMakeSense) {
    SparseMap map = smallMap();
    map.sessions[1].first_keyframe = 4;
    writeSparseMap(path_, map);
    expectRefused(readText(path_), "after the last keyframe");
    map.sessions[0].first_keyframe = 3;
    map.sessions[1].first_keyframe = 2;
    writeSparseMap(path_, map);
    expectRefused(readText(path_), "not in order");
}

}  // namespace
}  // namespace rgbd_graphslam
