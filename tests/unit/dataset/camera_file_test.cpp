#include "rgbd_graphslam/dataset/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFile.h>
#include <mrpt/img/TCamera.h>

#include "../../support/tum_folder.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

TEST(CameraFile, formulasOfMrptAreRefused) {
    const TestFolder folder;
    folder.write("camera.ini", "[CAMERA_PARAMS]\nfx = $env{HOME}\n");
    try {
        readCameraFile(folder / "camera.ini");
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("camera.ini:2: '$env{}' is not evaluated"));
    }
}

void expectSame(const CameraSetup& a, const CameraSetup& b) {
    EXPECT_EQ(a.camera.width, b.camera.width);
    EXPECT_EQ(a.camera.height, b.camera.height);
    EXPECT_EQ(a.camera.fx, b.camera.fx);
    EXPECT_EQ(a.camera.fy, b.camera.fy);
    EXPECT_EQ(a.camera.cx, b.camera.cx);
    EXPECT_EQ(a.camera.cy, b.camera.cy);
    EXPECT_TRUE(a.camera.lens == b.camera.lens);
    EXPECT_EQ(a.depth_units, b.depth_units);
    EXPECT_EQ(a.depth_scale, b.depth_scale);
    EXPECT_LT((a.T_base_sensor.R - b.T_base_sensor.R).norm(), 1e-12);
    EXPECT_LT((a.T_base_sensor.t - b.T_base_sensor.t).norm(), 1e-12);
    EXPECT_LT((a.T_sensor_imu.R - b.T_sensor_imu.R).norm(), 1e-12);
    EXPECT_LT((a.T_sensor_imu.t - b.T_sensor_imu.t).norm(), 1e-12);
}

CameraSetup readText(const std::string& text) {
    const TestFolder folder;
    folder.write("camera.ini", text);
    return readCameraFile(folder / "camera.ini");
}

const std::string minimal =
    "[CAMERA_PARAMS]\nresolution = [640 480]\nfx = 525\nfy = 525\ncx = 319.5\ncy = 239.5\n";

std::string complaintAbout(const std::string& text) {
    try {
        readText(text);
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

class ShippedCamera : public ::testing::TestWithParam<const char*> {};

TEST_P(ShippedCamera, fileHoldsTheBuiltInCalibration) {
    const std::string name = GetParam();
    expectSame(readCameraFile(RGBD_SOURCE_DIR "/ini/camera_" + name + ".ini"), *cameraByName(name));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedCamera, ::testing::Values("fr1", "fr2", "fr3", "ros"));

TEST(CameraFile, textReadsBackToTheSameNumbers) {
    CameraSetup setup = *cameraByName("fr1");
    setup.depth_units = 1000;
    setup.depth_scale = 1.0 / 3;
    setup.T_base_sensor = SE3(rotationExp({0.1, 0.3, -0.2}), {0.1, 0.02, 0.6});
    setup.T_sensor_imu = SE3(rotationExp({1.1, -0.3, 0.2}), {0, 0.01, 0});
    expectSame(readText(toIniText(setup)), setup);
    expectSame(readText(toIniText(CameraSetup())), CameraSetup());
}

TEST(CameraFile, textIsUnderstoodByMrpt) {
    const TestFolder folder;
    folder.write("camera.ini", toIniText(*cameraByName("fr1")));
    mrpt::img::TCamera camera;
    camera.loadFromConfigFile("CAMERA_PARAMS", mrpt::config::CConfigFile(folder / "camera.ini"));
    EXPECT_EQ(camera.fx(), 517.3);
    EXPECT_EQ(camera.k3(), 1.1633);
    EXPECT_EQ(camera.distortion, mrpt::img::DistortionModel::plumb_bob);
}

TEST(CameraFile, coefficientsCountWithoutTheNameOfTheModel) {
    EXPECT_EQ(lensCoefficients(readText(minimal + "dist = [0.1 0 0 0 0]\n").camera.lens)[0], 0.1);
    EXPECT_FALSE(readText(minimal).camera.hasDistortion());
    EXPECT_FALSE(readText(minimal + "distortion_model = none\ndist = [0.1 0 0 0 0]\n")
                     .camera.hasDistortion());
}

TEST(CameraFile, sensorPoseIsInMetresAndDegrees) {
    const SE3 T = readText(minimal + "sensor_pose = [0.1 0 0.6 90 0 0]\n").T_base_sensor;
    EXPECT_LT((T * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0.1, 1, 0.6)).norm(), 1e-12);
}

TEST(CameraFile, keysThatDifferInCaseAreOneAndRefusedTwice) {
    EXPECT_THAT(complaintAbout(minimal + "Fx = 900\n"),
                HasSubstr("'Fx' in line 7 repeats 'fx' of line 3"));
    EXPECT_THAT(complaintAbout(minimal + "fx = 525\n"), HasSubstr("in line 7 repeats"));
    EXPECT_EQ(readText("[other]\nfx = 3\n" + minimal + "; fx = 3\n# fx = 4\n").camera.fx, 525);
}

TEST(CameraFile, fourCoefficientsAreThoseWithoutK3) {
    const Lens expected = BrownLens{{0.1, -0.2, 0.001, 0.002}};
    EXPECT_TRUE(readText(minimal + "dist = [0.1 -0.2 0.001 0.002]\n").camera.lens == expected);
}

TEST(CameraFile, rationalAndFisheyeLensesComeBackAsTheyWere) {
    for (const std::string text :
         {"dist = [0.5 -2.7 0.001 -0.002 1.6 0.4 -2.5 1.5]\n",
          "distortion_model = kannala_brandt\ndist = [0.1 0 0.02 -0.01]\n"}) {
        const TestFolder folder;
        const CameraSetup setup = readText(minimal + text);
        EXPECT_TRUE(setup.camera.hasDistortion());
        folder.write("camera.ini", toIniText(setup));
        expectSame(readCameraFile(folder / "camera.ini"), setup);
    }
}

TEST(CameraFile, principalPointsOutsideTheImageAreRefused) {
    const auto with = [](const std::string& size, const std::string& cx) {
        return "[CAMERA_PARAMS]\nresolution = [" + size + "]\nfx = 525\nfy = 525\ncx = " + cx +
               "\ncy = 119.5\n";
    };
    EXPECT_THAT(complaintAbout(with("320 240", "319.9")),
                HasSubstr("outside the image of 320x240"));
    EXPECT_THAT(complaintAbout(with("320 240", "-1")), HasSubstr("it should be near 159.5, 119.5"));
    EXPECT_TRUE(doubtsOf(readText(with("320 240", "100")).camera).empty());
    EXPECT_THAT(doubtsOf(readText(with("320 240", "50")).camera),
                ::testing::ElementsAre(HasSubstr("far from the center of the image")));
}

TEST(CameraFile, fieldsOfViewThatNoUsualCameraHasAreDoubted) {
    Intrinsics camera{640, 480, 525, 525, 319.5, 239.5, {}};
    EXPECT_TRUE(doubtsOf(camera).empty());
    camera.fx = 3000;
    EXPECT_THAT(doubtsOf(camera), ::testing::ElementsAre(HasSubstr("12 degrees")));
    camera.fx = 52.5;
    EXPECT_THAT(doubtsOf(camera), ::testing::ElementsAre(HasSubstr("161 degrees")));
}

TEST(CameraFile, calibrationsFitImagesOfAnExactFraction) {
    const Intrinsics camera{640, 480, 520, 521, 325.1, 249.7, BrownLens{{0.1, 0, 0, 0, 0}}};
    const auto half = resizedTo(camera, 320, 240);
    ASSERT_TRUE(half);
    EXPECT_EQ(half->fx, 260);
    EXPECT_NEAR(half->cx, 162.3, 1e-9);
    const Eigen::Vector3d point(0.3, -0.2, 1.5);
    const Eigen::Vector2d full = CameraModel(camera).project(point);
    const Eigen::Vector2d small = CameraModel(*half).project(point);
    EXPECT_LT((small - ((full.array() + 0.5) / 2 - 0.5).matrix()).norm(), 1e-9);
    EXPECT_TRUE(resizedTo(camera, 1280, 960));
    EXPECT_TRUE(resizedTo(camera, 640, 480));
    for (const auto& [width, height] : {std::pair(640, 360), {424, 240}, {32, 24}, {0, 0}}) {
        EXPECT_FALSE(resizedTo(camera, width, height));
    }
}

TEST(CameraFile, mistakesAreNamed) {
    EXPECT_THAT(complaintAbout("[OTHER]\nfx = 1\n"), HasSubstr("no section [CAMERA_PARAMS]"));
    EXPECT_THAT(complaintAbout(minimal + "focal = 3\n"), HasSubstr("unknown key 'focal'"));
    EXPECT_THAT(complaintAbout("[CAMERA_PARAMS]\nfx = 525\n"), HasSubstr("'fy' is missing"));
    EXPECT_THAT(complaintAbout(minimal + "dist = [0.1 zero 0 0 0]\n"),
                HasSubstr("'zero' is not a number"));
    EXPECT_THAT(complaintAbout(minimal + "dist = [0.1 0]\n"), HasSubstr("dist must be"));
    EXPECT_THAT(complaintAbout(minimal + "distortion_model = kannala_brandt\ndist = [1 1]\n"),
                HasSubstr("dist must be [k1 k2 k3 k4]"));
    EXPECT_THAT(complaintAbout(minimal + "distortion_model = kannala_brandt\ndist = [-4 0 0 0]\n"),
                HasSubstr("cannot be undone"));
    EXPECT_THAT(complaintAbout(minimal + "distortion_model = curly\n"),
                HasSubstr("distortion_model must be"));
    EXPECT_THAT(complaintAbout(minimal + "dist = [-3 0 0 0 0]\n"),
                HasSubstr("dist: this distortion cannot be undone in the image"));
    EXPECT_THAT(complaintAbout(minimal + "depth_units = -5\n"), HasSubstr("depth_units"));
    EXPECT_THAT(complaintAbout(minimal + "sensor_pose = [1 2 3]\n"), HasSubstr("sensor_pose"));
    EXPECT_THROW(readCameraFile("/nowhere/camera.ini"), Error);
}

TEST(CameraFile, folderNamesTellTheCamera) {
    EXPECT_EQ(cameraByFolderName("rgbd_dataset_freiburg1_desk")->name, "fr1");
    EXPECT_EQ(cameraByFolderName("rgbd_dataset_freiburg2_pioneer_360")->name, "fr2");
    EXPECT_EQ(cameraByFolderName("TUM-FR3-office")->name, "fr3");
    EXPECT_FALSE(cameraByFolderName("kitchen-300"));
    EXPECT_FALSE(cameraByFolderName("fr10"));
}

}  // namespace
}  // namespace rgbd_graphslam
