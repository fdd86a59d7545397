#include "rgbd_graphslam/dataset/intrinsics_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../support/problem_of.h"
#include "../../support/tum_folder.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

class IntrinsicsFile : public ::testing::Test {
  protected:
    CameraSetup read(const std::string& name, const std::string& text) const {
        folder_.write(name, text);
        return readCalibration(folder_ / name);
    }
    std::string problem(const std::string& name, const std::string& text) const {
        return problemOf([&] { read(name, text); });
    }
    static void expectCamera(const Intrinsics& camera, double cx = 320.5) {
        EXPECT_EQ(camera.width, 640);
        EXPECT_EQ(camera.height, 480);
        EXPECT_EQ(camera.fx, 600);
        EXPECT_EQ(camera.fy, 601);
        EXPECT_EQ(camera.cx, cx);
        EXPECT_EQ(camera.cy, 240.5);
    }

    TestFolder folder_;
};

const std::string open3d = R"({"width": 640, "height": 480,
    "intrinsic_matrix": [600, 0, 0, 0, 601, 0, 320.5, 240.5, 1]})";

TEST_F(IntrinsicsFile, librealsense) {
    const std::string one = R"({"width": 640, "height": 480, "fx": 600, "fy": 601, "ppx": 320.5,
        "ppy": 240.5, "model": "distortion.inverse_brown_conrady", "coeffs": [0, 0, 0, 0, 0]})";
    expectCamera(read("a.json", one).camera);
    EXPECT_FALSE(read("a.json", one).camera.hasDistortion());
    const std::string depth = R"({"width": 848, "height": 480, "fx": 420, "fy": 420, "ppx": 424,
        "ppy": 240})";
    const CameraSetup both =
        read("a.json", R"({"depth": )" + depth + R"(, "depth_scale": 0.001, "rgb": )" + one + "}");
    expectCamera(both.camera);
    EXPECT_NEAR(both.depth_units, 1000, 1e-9);
    EXPECT_FALSE(both.depth_units_assumed);
    std::string bent = one;
    bent.replace(bent.find("[0,"), 3, "[0.1,");
    EXPECT_THAT(problem("a.json", bent), HasSubstr("'distortion.inverse_brown_conrady' with"));
    bent.replace(bent.find("inverse_"), 8, "");
    EXPECT_EQ(lensCoefficients(read("a.json", bent).camera.lens)[0], 0.1);
}

TEST_F(IntrinsicsFile, open3dFlatAndNested) {
    expectCamera(read("a.json", open3d).camera);
    expectCamera(read("A.JSON", R"({"class_name": "PinholeCameraParameters", "extrinsic": [1, 0],
        "intrinsic": )" + open3d + "}")
                     .camera);
    expectCamera(read("a.json", R"({"class_name": "PinholeCameraTrajectory", "parameters": [
        {"extrinsic": [1], "intrinsic": )" +
                                    open3d + R"(}, {"intrinsic": {"fx": 1}}]})")
                     .camera);
    EXPECT_EQ(read("a.json", open3d).depth_units, 1000);
    EXPECT_TRUE(read("a.json", open3d).depth_units_assumed);
}

TEST_F(IntrinsicsFile, matricesByRowsAndDepthUnits) {
    expectCamera(read("a.json", R"({"w": 640, "h": 480, "scale": 6553.5,
        "K": [[600, 0, 320.5], [0, 601, 240.5], [0, 0, 1]]})")
                     .camera);
    EXPECT_EQ(read("a.json", R"({"w": 640, "h": 480, "scale": 6553.5,
        "K": [600, 0, 320.5, 0, 601, 240.5, 0, 0, 1]})")
                  .depth_units,
              6553.5);
    const CameraSetup setup = read("a.json", R"({"camera": {"w": 640, "h": 480, "fx": 600,
        "fy": 601, "cx": 320.5, "cy": 240.5, "depth_scale": 0.00025}})");
    EXPECT_NEAR(setup.depth_units, 4000, 1e-6);
    EXPECT_FALSE(setup.depth_units_assumed);
}

TEST_F(IntrinsicsFile, rosCameraInfo) {
    const CameraSetup setup = read("a.yaml", R"(%YAML:1.0
---
image_width: 640
image_height: 480
camera_name: head  # of the robot
camera_matrix:
  rows: 3
  cols: 3
  data: [600.0, 0.0, 320.5, 0.0, 601.0,
         240.5, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients: !!opencv-matrix
  rows: 1
  cols: 5
  data: [0.1, -0.2, 0.001, 0.002, 0.]
)");
    expectCamera(setup.camera);
    EXPECT_EQ(lensCoefficients(setup.camera.lens)[1], -0.2);
}

TEST_F(IntrinsicsFile, rosMessagesAsTheyAreEchoed) {
    expectCamera(read("a.yml",
                      "height: 480\nwidth: 640\ndistortion_model: \"plumb_bob\"\n"
                      "D: [0.0, 0.0]\nK: [600, 0, 320.5, 0, 601, 240.5, 0, 0, 1]\n"
                      "P: [1, 0]\n---\n")
                     .camera);
    expectCamera(read("a.yml",
                      "header:\n  stamp:\n    sec: 1\nheight: 480\nwidth: 640\n"
                      "d:\n- 0.0\n- 0.0\nk:\n- 600.0\n- 0\n- 320.5\n- 0\n- 601\n- 240.5\n"
                      "- 0\n- 0\n- 1\nr:\n- 1\n")
                     .camera);
}

TEST_F(IntrinsicsFile, kalibr) {
    const CameraSetup setup = read("camchain.yaml", R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [0.1, -0.2, 0.001, 0.002]
  distortion_model: radtan
  intrinsics: [600, 601, 320.5, 240.5]
  resolution: [640, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0]
  - [0.0, 1.0]
  intrinsics: [1, 1, 1, 1]
)");
    expectCamera(setup.camera);
    EXPECT_EQ(lensCoefficients(setup.camera.lens)[3], 0.002);
}

TEST_F(IntrinsicsFile, iniFilesAsEver) {
    EXPECT_EQ(read("camera.ini", small_sequence::cameraIni()).camera.fy, 31);
}

TEST_F(IntrinsicsFile, fisheyeAndRationalLenses) {
    const CameraSetup kalibr = read("a.yaml",
                                    "cam0:\n  camera_model: pinhole\n"
                                    "  intrinsics: [458, 457, 367, 248]\n  resolution: [752, 480]\n"
                                    "  distortion_model: equidistant\n"
                                    "  distortion_coeffs: [0.1, 0.02, 0, -0.01]\n");
    EXPECT_TRUE(kalibr.camera.lens == Lens(KannalaBrandtLens{{0.1, 0.02, 0, -0.01}}));
    const CameraSetup azure =
        read("a.json", R"({"w": 1280, "h": 720, "fx": 605, "fy": 605, "cx": 640,
        "cy": 366, "distortion_model": "rational_polynomial",
        "D": [0.52, -2.74, 0.0004, -0.0003, 1.59, 0.40, -2.55, 1.51]})");
    EXPECT_EQ(lensModel(azure.camera.lens), "rational");
    EXPECT_EQ(lensCoefficients(azure.camera.lens)[7], 1.51);
}

TEST_F(IntrinsicsFile, whatCannotBeUsedIsNamed) {
    EXPECT_THAT(problemOf([] { readCalibration("/nowhere/a.json"); }), HasSubstr("cannot read"));
    EXPECT_THAT(problem("a.json", "{\"fx\": "), HasSubstr("a.json' is not JSON"));
    EXPECT_THAT(problem("a.json", "{\"fy\": 3}"), HasSubstr("has no camera"));
    EXPECT_THAT(problem("a.json", "{\"fx\": 600, \"fy\": 600}"), HasSubstr("no usable fx"));
    EXPECT_THAT(problem("a.json", R"({"w": 1e9, "h": 1, "fx": 6, "fy": 6, "cx": 1, "cy": 1})"),
                HasSubstr("no such size"));
    EXPECT_THAT(problem("a.yaml",
                        "intrinsics: [458, 457, 367, 248]\nresolution: [752, 480]\n"
                        "distortion_model: omnidirectional\n"
                        "distortion_coefficients: [0.1, 0, 0, 0]\n"),
                HasSubstr("'omnidirectional' with 4 coefficients is not supported"));
    EXPECT_THAT(
        problem("a.json", R"({"w": 640, "h": 480, "fx": 600, "fy": 600, "cx": 320, "cy": 240,
        "coeffs": [0.1, 0, 0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0]})"),
        HasSubstr("12 coefficients is not supported"));
    EXPECT_THAT(problem("a.yaml", "K: " + std::string(5000, '[')), HasSubstr("no usable fx"));
    EXPECT_THAT(
        problem("a.json", "{\"K\": " + std::string(5000, '[') + std::string(5000, ']') + "}"),
        HasSubstr("no usable fx"));
}

}  // namespace
}  // namespace rgbd_graphslam
