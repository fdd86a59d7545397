#include "rgbd_graphslam/evaluation/mover_boxes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

MoverBox boxAt(double stamp_s, double x, double speed_m_s) {
    MoverBox box;
    box.stamp_s = stamp_s;
    box.speed_m_s = speed_m_s;
    box.T_world_box.t = {x, 0, 1};
    box.size_m = {0.4, 0.2, 2};
    return box;
}

TEST(MoverBox, containsPointsInItsOwnAxes) {
    MoverBox box = boxAt(0, 3, 1);
    EXPECT_TRUE(box.contains({3.19, 0.09, 1.9}));
    EXPECT_FALSE(box.contains({3.0, 0.15, 1}));
    box.T_world_box.R = rotationExp({0, 0, std::acos(-1.0) / 2});
    EXPECT_TRUE(box.contains({3.0, 0.15, 1}));
    EXPECT_FALSE(box.contains({3.19, 0, 1}));
}

TEST(MoverWays, areWhereSomethingWasAndIsNoMore) {
    const MoverWays ways({boxAt(0, 0, 0), boxAt(1, 1, 1), boxAt(2, 2, 0)});
    EXPECT_TRUE(ways.contains({0.1, 0, 1}));
    EXPECT_TRUE(ways.contains({1.1, 0, 1}));
    EXPECT_FALSE(ways.contains({2.1, 0, 1})) << "there it stays";
    EXPECT_FALSE(ways.contains({0.5, 0, 1}));
    EXPECT_FALSE(MoverWays({}).contains({0, 0, 0}));
    EXPECT_TRUE(MoverWays({boxAt(0, 0, 0), boxAt(1, 1, 1)}).contains({1.1, 0, 1}))
        << "still on its way at the end";
}

class MoversFile : public testing::Test {
  protected:
    std::vector<MoverBox> read(const std::string& lines) const {
        std::ofstream(path_) << "stamp_s,name,carried,speed_m_s,x_m,y_m,z_m,qx,qy,qz,qw,size_x_m,"
                                "size_y_m,size_z_m\n"
                             << lines;
        return readMoverBoxes(path_);
    }
    void TearDown() override { std::filesystem::remove(path_); }

    const std::string path_ = std::string(RGBD_BINARY_DIR) + "/movers_" +
                              testing::UnitTest::GetInstance()->current_test_info()->name() +
                              ".csv";
};

TEST_F(MoversFile, isRead) {
    const auto boxes = read("1000.5,person 1,0,0.9,1,2,3,0,0,0.6,0.8,0.1,0.2,0.3\n");
    ASSERT_EQ(boxes.size(), 1u);
    EXPECT_EQ(boxes[0].name, "person 1");
    EXPECT_EQ(boxes[0].speed_m_s, 0.9);
    EXPECT_FALSE(boxes[0].carried);
    EXPECT_EQ(boxes[0].T_world_box.t, Eigen::Vector3d(1, 2, 3));
    EXPECT_NEAR(boxes[0].T_world_box.R(1, 0), 0.96, 1e-12);
    EXPECT_EQ(boxes[0].size_m, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST_F(MoversFile, thatIsDamagedIsAnErrorNamingTheLine) {
    for (const char* line : {"1,a,0,1,2,3\n", "1,a,0,x,1,2,3,0,0,0,1,1,1,1\n", "\n"}) {
        try {
            read(line);
            FAIL() << line;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(".csv:2"), std::string::npos) << e.what();
        }
    }
    EXPECT_THROW(readMoverBoxes(path_ + ".absent"), Error);
}

}  // namespace
}  // namespace rgbd_graphslam
