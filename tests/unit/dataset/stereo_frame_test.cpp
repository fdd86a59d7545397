/** Stereo pairs as frames: rectified by their calibration, of any lens. */
#include "rgbd_graphslam/dataset/stereo_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "../../support/problem_of.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

constexpr int width = 160, height = 120;

Intrinsics pinhole() {
    return {width, height, 140, 140, 79.5, 59.5, {}};
}

/** Two unequal cameras of a lens model, not parallel and not level. */
struct Head {
    Intrinsics left, right;
    SE3 T_left_right{rotationExp({0.01, -0.03, 0.02}), {0.12, 0.004, -0.006}};
};

Head crookedHead(const Lens& lens) {
    Head head{pinhole(), pinhole()};
    head.left.lens = head.right.lens = lens;
    head.right.fx = 143;
    head.right.fy = 142;
    head.right.cx = 83;
    head.right.cy = 57;
    return head;
}

std::vector<Head> crookedHeads() {
    return {crookedHead(BrownLens{}), crookedHead(BrownLens{{-0.28, 0.07, 0.0002, 0.0001, 0}}),
            crookedHead(BrownLens{{0.6, -0.2, 0.0003, -0.0002, 0.01, 0.9, -0.1, 0.02}}),
            crookedHead(KannalaBrandtLens{{0.0034, 0.0007, -0.002, 0.0002}})};
}

/** The gray value tells the direction: smooth, so that interpolation is right. */
double brightness(const Eigen::Vector3d& ray) {
    return 128 + 60 * std::sin(6 * ray.x() / ray.z()) + 50 * std::cos(5 * ray.y() / ray.z());
}

/** What a camera sees of a picture at infinity. */
cv::Mat film(const Intrinsics& camera, const Eigen::Matrix3d& R_world_cam) {
    const CameraModel model(camera);
    cv::Mat1b image(camera.height, camera.width);
    for (int v = 0; v < image.rows; ++v) {
        for (int u = 0; u < image.cols; ++u) {
            image(v, u) =
                cv::saturate_cast<std::uint8_t>(brightness(R_world_cam * model.unproject(u, v, 1)));
        }
    }
    return image;
}

TEST(StereoRectifier, bringsAPointIntoTheSameRow) {
    for (const Head& head : crookedHeads()) {
        const StereoRectifier rectifier(head.left, head.right, head.T_left_right);
        const CameraModel camera(rectifier.camera());
        const double baseline_m = head.T_left_right.t.norm();
        EXPECT_NEAR(rectifier.disparityInMeterPixels(), rectifier.camera().fx * baseline_m, 1e-9);
        const SE3 T_rectified_left = rectifier.T_left_rectified().inverse();
        const Eigen::Vector3d right_at = T_rectified_left * head.T_left_right.t;
        EXPECT_NEAR(right_at.x(), baseline_m, 1e-12);
        EXPECT_NEAR(right_at.tail<2>().norm(), 0, 1e-12);
    }
}

TEST(StereoRectifier, picturesAreThoseOfTheRectifiedCamera) {
    for (const Head& head : crookedHeads()) {
        const StereoRectifier rectifier(head.left, head.right, head.T_left_right);
        const Eigen::Matrix3d R = rectifier.T_left_rectified().R;
        const cv::Mat expected = film(rectifier.camera(), R);
        EXPECT_GT(expected.total(), 0.6 * width * height);
        const cv::Mat left = rectifier.left(film(head.left, Eigen::Matrix3d::Identity()));
        const cv::Mat right = rectifier.right(film(head.right, head.T_left_right.R));
        EXPECT_LT(cv::norm(left, expected, cv::NORM_INF), 3) << lensModel(head.left.lens);
        EXPECT_LT(cv::norm(right, expected, cv::NORM_INF), 3) << lensModel(head.left.lens);
    }
}

TEST(StereoRectifier, leavesRectifiedPairsAlone) {
    const StereoRectifier rectifier(pinhole(), pinhole(),
                                    SE3(Eigen::Matrix3d::Identity(), {0.5, 0, 0}));
    const cv::Mat image = film(pinhole(), Eigen::Matrix3d::Identity());
    EXPECT_EQ(rectifier.left(image).data, image.data);
    EXPECT_EQ(rectifier.right(image).data, image.data);
    EXPECT_EQ(rectifier.disparityInMeterPixels(), 70);
    EXPECT_TRUE(rectifier.camera() == pinhole());
}

TEST(StereoRectifier, refusesWhatIsNoStereoHead) {
    const auto problem = [](const SE3& T_left_right) {
        return problemOf([&] { StereoRectifier(pinhole(), pinhole(), T_left_right); });
    };
    EXPECT_THAT(problem(SE3(Eigen::Matrix3d::Identity(), {-0.5, 0, 0})),
                HasSubstr("not to the right"));
    EXPECT_THAT(problem(SE3(Eigen::Matrix3d::Identity(), {0.1, 0.5, 0})),
                HasSubstr("not to the right"));
    EXPECT_THAT(problem(SE3(rotationExp({0, 1.5, 0}), {0.5, 0, 0})), HasSubstr("in common"));
}

class StereoFrames : public ::testing::Test {
  protected:
    void SetUp() override { setVerbosity(Verbosity::Quiet); }

    static mrpt::obs::CObservationStereoImages::Ptr pairOf(const Head& head) {
        auto pair = mrpt::obs::CObservationStereoImages::Create();
        pair->sensorLabel = "STEREO";
        pair->timestamp = toMrptTime(1234.5);
        pair->leftCamera = toTCamera(head.left);
        pair->rightCamera = toTCamera(head.right);
        pair->rightCameraPose = mrpt::poses::CPose3DQuat(toCPose3D(head.T_left_right));
        pair->cameraPose = mrpt::poses::CPose3DQuat(toCPose3D(T_base_left()));
        pair->imageLeft =
            mrpt::img::CImage(film(head.left, Eigen::Matrix3d::Identity()), mrpt::img::DEEP_COPY);
        pair->imageRight =
            mrpt::img::CImage(film(head.right, head.T_left_right.R), mrpt::img::DEEP_COPY);
        pair->hasImageRight = true;
        return pair;
    }
    static SE3 T_base_left() { return {rotationExp({-1.5, 0.1, -0.2}), {0.3, 0.1, 0.5}}; }
};

TEST_F(StereoFrames, standForTheirPairs) {
    const Head head = crookedHeads()[1];
    const StereoRectifier rectifier(head.left, head.right, head.T_left_right);
    const auto frame = asRgbdFrame(pairOf(head));
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->sensorLabel, "STEREO");
    const SE3 difference =
        (T_base_left() * rectifier.T_left_rectified()).inverse() * cameraOnRobot(*frame);
    EXPECT_LT(difference.t.norm(), 1e-9);
    EXPECT_LT(difference.angle(), 1e-7);
    const RigCamera camera = rigCameraOf(*frame);
    EXPECT_NEAR(camera.model.intrinsics().fx, rectifier.camera().fx, 1e-12);
    EXPECT_EQ(camera.disparity_m_px, rectifier.disparityInMeterPixels());

    const RgbdImage tracked = toTrackingImage(frame);
    EXPECT_TRUE(tracked.depth.empty());
    EXPECT_EQ(tracked.stamp_s, 1234.5);
    EXPECT_EQ(tracked.gray.size(), tracked.right.size());
    EXPECT_EQ(tracked.gray.cols, camera.model.width);
    const RgbdImage mapped = toRgbdImage(frame);
    EXPECT_EQ(mapped.depth.size(), tracked.gray.size());
    EXPECT_FLOAT_EQ(static_cast<float>(mapped.depth_unit_m), frame->rangeUnits);
}

TEST_F(StereoFrames, ofColorCamerasAreGrayAndColored) {
    const auto pair = pairOf(crookedHeads()[0]);
    for (mrpt::img::CImage* image : {&pair->imageLeft, &pair->imageRight}) {
        cv::Mat channels[] = {image->asCvMatRef(), image->asCvMatRef(), image->asCvMatRef()}, all;
        cv::merge(channels, 3, all);
        *image = mrpt::img::CImage(all, mrpt::img::DEEP_COPY);
    }
    const RgbdImage image = toTrackingImage(asRgbdFrame(pair));
    EXPECT_EQ(image.color.type(), CV_8UC3);
    EXPECT_EQ(image.gray.type(), CV_8UC1);
    EXPECT_EQ(image.right.type(), CV_8UC1);
}

TEST_F(StereoFrames, otherObservationsStayWhatTheyAre) {
    const auto rgbd = mrpt::obs::CObservation3DRangeScan::Create();
    EXPECT_EQ(asRgbdFrame(rgbd), rgbd);
    EXPECT_FALSE(asRgbdFrame(mrpt::obs::CObservationIMU::Create()));
}

TEST_F(StereoFrames, brokenPairsAreRefusedByStamp) {
    const auto with = [](const auto& change) {
        const auto pair = pairOf(crookedHeads()[0]);
        change(*pair);
        return problemOf([&] { toTrackingImage(asRgbdFrame(pair)); });
    };
    EXPECT_THAT(with([](auto& pair) { pair.hasImageRight = false; }), HasSubstr("no right image"));
    EXPECT_THAT(with([](auto& pair) { pair.leftCamera = {}; }),
                HasSubstr("stereo pair at stamp 1234.5"));
    EXPECT_THAT(with([](auto& pair) { pair.imageRight = mrpt::img::CImage(40, 30); }),
                HasSubstr("right image does not fit"));
    EXPECT_THAT(with([](auto& pair) { pair.imageLeft = {}; }), HasSubstr("left image"));
}

}  // namespace
}  // namespace rgbd_graphslam
