/** Bags written by ROS's own Python library, read by ours. */
#include "rgbd_graphslam/dataset/unpacked_bag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;
using small_sequence::colorStamp;
using small_sequence::depthStamp;
using small_sequence::stampText;
using ::testing::HasSubstr;

constexpr int frames = 4;
const std::string camera_frame = "/openni_rgb_optical_frame";

/** Depth in metres as the benchmark's bags have it, without reading where the PNG has 0. */
cv::Mat inMetres(const cv::Mat& depth) {
    cv::Mat1f metres;
    depth.convertTo(metres, CV_32F, 1.0 / 5000);
    metres.setTo(std::numeric_limits<float>::quiet_NaN(), depth == 0);
    return metres;
}

cv::Mat inRgb(const cv::Mat& color) {
    cv::Mat rgb;
    cv::cvtColor(color, rgb, cv::COLOR_BGR2RGB);
    return rgb;
}

/** Of the camera's mount in the world; exact in few digits. */
std::string mountPose(int i) {
    return std::to_string(i) + " 0.5 1.25 0 0 0.6 0.8";
}

class Bag : public ::testing::Test {
  protected:
    void SetUp() override {
        if (std::system("/usr/bin/python3 -c 'import rosbag, sensor_msgs.msg, tf2_msgs.msg'"
                        " 2>/dev/null") != 0) {
            GTEST_SKIP() << "python3-rosbag, python3-sensor-msgs and python3-tf2-msgs are needed";
        }
    }

    std::string bag() const { return folder_ / "rgbd.bag"; }

    void addImage(const std::string& topic, double stamp_s, const std::string& encoding,
                  const cv::Mat& pixels) {
        const std::string file = "pixels" + std::to_string(images_++);
        folder_.write(file, std::string(reinterpret_cast<const char*>(pixels.data),
                                        pixels.total() * pixels.elemSize()));
        lines_ += "image " + topic + " " + camera_frame + " " + stampText(stamp_s) + " " +
                  encoding + " " + std::to_string(pixels.cols) + " " + std::to_string(pixels.rows) +
                  " " + folder_ / file + "\n";
    }

    /** The small sequence with accelerometer and truth: its folder, and the lines of its bag. */
    void makeSequence() {
        small_sequence::make(folder_, "f/rgbd", frames);
        folder_.write("f/rgbd/camera.ini",
                      "[CAMERA_PARAMS]\nresolution = [32 24]\nfx = 30\nfy = 31\ncx = 15.5\n"
                      "cy = 11.5\ndist = [0.1 -0.2 0.001 -0.002 0.05]\n");
        std::string acceleration, truth;
        for (int i = 0; i < frames; ++i) {
            const std::string stamp = stampText(colorStamp(i));
            acceleration += stamp + " 0.25 " + std::to_string(i) + " -9.5\n";
            // The camera is 0.1 m before its mount, which is turned by 2 acos(0.8) about z.
            truth += stamp + " " + std::to_string(i + 0.028) + " 0.596 1.25 0 0 0.6 0.8\n";
            lines_ += "camera_info /camera/rgb/camera_info " + camera_frame + " " + stamp +
                      " 32 24 30 31 15.5 11.5 0.1 -0.2 0.001 -0.002 0.05\n";
            addImage("/camera/rgb/image_color", colorStamp(i), "rgb8",
                     inRgb(small_sequence::color(i)));
            addImage("/camera/depth/image", depthStamp(i), "32FC1",
                     inMetres(small_sequence::depth(i)));
            addImage("/other/image", depthStamp(i), "rgb8", small_sequence::color(9));
            lines_ += "imu /imu " + stamp + " 0.25 " + std::to_string(i) + " -9.5\n";
            lines_ += "tf /tf " + stamp + " /world /kinect " + mountPose(i) + "\n";
            lines_ += "tf /tf " + stamp + " /kinect " + camera_frame + " 0.1 0 0 0 0 0 1\n";
        }
        folder_.write("f/rgbd/accelerometer.txt", acceleration);
        folder_.write("f/rgbd/groundtruth.txt", truth);
    }

    void record(const std::string& compression = "none") {
        folder_.write("lines", lines_);
        const std::string command = "/usr/bin/python3 '" RGBD_SOURCE_DIR
                                    "/tests/support/make_bag.py' '" +
                                    bag() + "' " + compression + " <'" + folder_ / "lines" + "'";
        ASSERT_EQ(std::system(command.c_str()), 0);
    }

    static void import(const std::string& sequence, const std::string& rawlog) {
        importSequence(readTumSequence(sequence), readCameraFile(sequence + "/camera.ini"), rawlog,
                       {});
    }

    std::string complaint() const {
        try {
            UnpackedBag(bag(), folder_ / "");
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    }

    TestFolder folder_;
    std::string lines_;
    int images_ = 0;
};

TEST_F(Bag, givesTheSameRawlogAsTheFolder) {
    makeSequence();
    import(folder_ / "f/rgbd", folder_ / "folder.rawlog");
    const std::string expected = readText(folder_ / "folder.rawlog");
    for (const char* compression : {"none", "bz2"}) {
        record(compression);
        const UnpackedBag unpacked(bag(), folder_ / "");
        import(unpacked.sequenceFolder(), folder_ / "bag.rawlog");
        EXPECT_EQ(readText(unpacked.sequenceFolder() + "/rgb.txt").size(),
                  readText(folder_ / "f/rgbd/rgb.txt").size() - std::strlen("# color images\n"));
        EXPECT_TRUE(readText(folder_ / "bag.rawlog") == expected) << compression;
    }
}

TEST_F(Bag, theTemporaryFolderGoes) {
    makeSequence();
    record();
    std::string folder;
    {
        const UnpackedBag unpacked(bag(), folder_ / "");
        folder = unpacked.sequenceFolder();
        EXPECT_TRUE(fs::exists(folder + "/rgb.txt"));
        EXPECT_FALSE(fs::exists(folder + "/gyroscope.txt")) << "its covariance says there is none";
    }
    EXPECT_FALSE(fs::exists(fs::path(folder).parent_path()));
}

TEST_F(Bag, millimetresAreUnderstoodToo) {
    addImage("/d", 1.5, "16UC1", cv::Mat(24, 32, CV_16UC1, cv::Scalar(1500)));
    addImage("/c", 1.5, "bgr8", small_sequence::color(0));
    record();
    const UnpackedBag unpacked(bag(), folder_ / "");
    const cv::Mat depth =
        cv::imread(unpacked.sequenceFolder() + "/depth/1.500000.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_16UC1);
    EXPECT_EQ(cv::norm(depth, cv::Mat(24, 32, CV_16UC1, cv::Scalar(7500)), cv::NORM_INF), 0);
    const cv::Mat color = cv::imread(unpacked.sequenceFolder() + "/rgb/1.500000.png");
    EXPECT_EQ(cv::norm(color, small_sequence::color(0), cv::NORM_INF), 0);
}

TEST_F(Bag, whatLacksIsSaid) {
    addImage("/c", 1, "bgr8", small_sequence::color(0));
    record();
    EXPECT_THAT(complaint(), HasSubstr("holds no depth images"));
    lines_.clear();
    addImage("/c", 1, "yuv422", small_sequence::color(0));
    record();
    EXPECT_THAT(complaint(), HasSubstr("'yuv422' are not understood"));
}

TEST_F(Bag, anImageThatLacksPixelsIsRefused) {
    addImage("/c", 1, "bgr8", small_sequence::color(0));
    lines_.replace(lines_.find(" 32 24 "), 7, " 99 24 ");
    record();
    EXPECT_THAT(complaint(), HasSubstr("image at 1.000000 is not whole"));
}

TEST_F(Bag, damageIsSaidAndNothingLeftBehind) {
    folder_.write("rgbd.bag", "no bag");
    EXPECT_THAT(complaint(), HasSubstr("is no ROS 1 bag of format 2.0"));
    makeSequence();
    for (const char* compression : {"none", "bz2"}) {
        for (const double share : {0.3, 0.6, 0.9}) {
            record(compression);
            cutFile(bag(), share);
            EXPECT_THAT(complaint(), HasSubstr("is damaged or cut off")) << compression << share;
        }
    }
    for (const auto& entry : fs::directory_iterator(folder_ / "")) {
        EXPECT_NE(entry.path().filename().string().rfind(".tmp", 0), 0u) << entry;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
