/** Small stereo recordings in the layouts that are imported, made on the spot. */
#pragma once
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tum_folder.h"

namespace rgbd_graphslam::stereo_folder {

constexpr int width = 32, height = 24, pairs = 4;

/** Another one for each frame and camera. */
inline cv::Mat gray(int frame, int camera) {
    cv::Mat1b image(height, width);
    cv::RNG generator(100 * camera + frame + 1);
    generator.fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
}

inline void image(const TestFolder& folder, const std::string& name, const cv::Mat& pixels) {
    folder.write(name, "");
    cv::imwrite(folder / name, pixels);
}

/** At 20 Hz. */
inline std::string stampNs(int frame) {
    return std::to_string(1403636579763555584LL + frame * 50000000LL);
}

/** As EuRoC writes it. \param x_m of the camera on the body */
inline std::string sensorYaml(double x_m, const std::string& model = "radial-tangential",
                              const std::string& coefficients = "[-0.2, 0.05, 0.001, -0.002]") {
    return "#Default camera\nsensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n"
           "  data: [0.0, -1.0, 0.0, " +
           std::to_string(x_m) +
           ",\n         1.0, 0.0, 0.0, 0.02,\n         0.0, 0.0, 1.0, 0.03,\n"
           "         0.0, 0.0, 0.0, 1.0]\nrate_hz: 20\nresolution: [32, 24]\n"
           "camera_model: pinhole\nintrinsics: [30.0, 31.0, 15.5, 11.5] #fu, fv, cu, cv\n"
           "distortion_model: " +
           model + "\ndistortion_coefficients: " + coefficients + "\n";
}

inline std::string imuYaml() {
    return "sensor_type: imu\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1.0, 0.0, 0.0, 0.5, 0.0, 1.0, "
           "0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]\n";
}

/** Images, stamps, one IMU reading and one true pose per pair; no calibration. */
inline void eurocLists(const TestFolder& folder, const std::string& name,
                       const std::string& truth) {
    std::string list = "#timestamp [ns],filename\r\n", imu = "#timestamp [ns],w,a\n",
                poses = "#timestamp, p_RS_R, q_RS\n";
    for (int i = 0; i < pairs; ++i) {
        list += stampNs(i) + "," + stampNs(i) + ".png\r\n";
        imu += stampNs(i) + ",0.1,0.2,0.3,0.4,0.5,9.8\n";
        poses += stampNs(i) + ",1." + std::to_string(i) + ",2,3,1,0,0,0,0,0,0,0,0,0,0,0,0\n";
        for (int camera : {0, 1}) {
            image(folder,
                  name + "/mav0/cam" + std::to_string(camera) + "/data/" + stampNs(i) + ".png",
                  gray(i, camera));
        }
    }
    folder.write(name + "/mav0/cam0/data.csv", list);
    folder.write(name + "/mav0/cam1/data.csv", list);
    folder.write(name + "/mav0/imu0/data.csv", imu);
    folder.write(name + "/mav0/" + truth + "/data.csv", poses);
}

inline void makeEuroc(const TestFolder& folder, const std::string& name) {
    eurocLists(folder, name, "state_groundtruth_estimate0");
    folder.write(name + "/mav0/cam0/sensor.yaml", sensorYaml(0.1));
    folder.write(name + "/mav0/cam1/sensor.yaml", sensorYaml(0.1));
    folder.write(name + "/mav0/imu0/sensor.yaml", imuYaml());
    folder.write(name + "/mav0/leica0/data.csv", "#none\n");
}

/** As TUM-VI's export: fisheyes, calibrated by Kalibr, truth of the IMU by motion capture. */
inline void makeTumVi(const TestFolder& folder, const std::string& name) {
    eurocLists(folder, name, "mocap0");
    const std::string lens =
        "  camera_model: pinhole\n  distortion_coeffs: [0.0034, 0.0007, -0.002, 0.0002]\n"
        "  distortion_model: equidistant\n  intrinsics: [12.5, 12.6, 15.5, 11.5]\n"
        "  resolution: [32, 24]\n";
    folder.write(name + "/dso/camchain.yaml",
                 "cam0:\n  T_cam_imu:\n  - [1.0, 0.0, 0.0, 0.25]\n  - [0.0, 1.0, 0.0, 0.0]\n"
                 "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n" +
                     lens +
                     "cam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.101]\n  - [0.0, 1.0, 0.0, 0.0]\n"
                     "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n" +
                     lens);
}

inline std::string kittiCalib() {
    return "P0: 30 0 15.5 0 0 30 11.5 0 0 0 1 0\nP1: 30 0 15.5 -16.1 0 30 11.5 0 0 0 1 0\n"
           "P2: 30 0 15.5 1.8 0 30 11.5 0 0 0 1 0\nP3: 30 0 15.5 -14.4 0 30 11.5 0 0 0 1 0\n"
           "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";
}

/** \param left 0 for the gray cameras, 2 for the colored ones */
inline void makeKitti(const TestFolder& folder, const std::string& name, int left) {
    std::string times, poses;
    for (int i = 0; i < pairs; ++i) {
        times += std::to_string(0.1 * i) + "e+00\n";
        poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(i) + "\n";
        for (int camera : {left, left + 1}) {
            char file[64];
            std::snprintf(file, sizeof file, "/image_%d/%06d.png", camera, i);
            image(folder, name + file, gray(i, camera));
        }
    }
    folder.write(name + "/times.txt", times);
    folder.write(name + "/poses.txt", poses);
    folder.write(name + "/calib.txt", kittiCalib());
}

inline std::string stereoIni() {
    const std::string lens = "resolution = [32 24]\nfx = 30\nfy = 30\ncx = 15.5\ncy = 11.5\n";
    return "[CAMERA_PARAMS]\n" + lens + "[CAMERA_PARAMS_RIGHT]\n" + lens +
           "[STEREO]\nbaseline = 0.537\n";
}

/** The right list's stamps are 1 ms later. */
inline void makeLeftRight(const TestFolder& folder, const std::string& name) {
    std::string left, right;
    for (int i = 0; i < pairs; ++i) {
        const std::string file = "/" + std::to_string(i) + ".png";
        image(folder, name + "/left" + file, gray(i, 0));
        image(folder, name + "/right" + file, gray(i, 1));
        left += std::to_string(0.1 * i) + " left" + file + "\n";
        right += std::to_string(0.1 * i + 0.001) + " right" + file + "\n";
    }
    folder.write(name + "/left.txt", left);
    folder.write(name + "/right.txt", right);
    folder.write(name + "/groundtruth.txt", "0 0 0 0 0 0 0 1\n0.3 0 0 3 0 0 0 1\n");
    folder.write(name + "/camera.ini", stereoIni());
}

}  // namespace rgbd_graphslam::stereo_folder
