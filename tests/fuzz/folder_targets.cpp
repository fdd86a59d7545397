/** Folders, lists and calibrations that other programs wrote. */
#include <opencv2/imgcodecs.hpp>

#include "../support/stereo_folders.h"
#include "fuzz_targets.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/intrinsics_file.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
#include "rgbd_graphslam/dataset/stereo_sequence.h"
#include "rgbd_graphslam/dataset/unpacked_sens.h"

namespace rgbd_graphslam {
namespace {

/** One folder a process, with an image of each kind. */
const TestFolder& folder() {
    static const TestFolder* const only = [] {
        auto* made = new TestFolder;  // for the life of the process
        for (const char* sequence : {"pairs", "stray"}) {
            for (const char* kind : {"rgb", "depth"}) {
                const std::string path = std::string(sequence) + "/" + kind + "/000000.png";
                made->write(path, "");
                cv::imwrite(*made / path, cv::Mat(2, 3, CV_8UC3, cv::Scalar::all(9)));
            }
        }
        return made;
    }();
    return *only;
}

template <class Read>
void mayRefuse(Read read) {
    try {
        read();
    } catch (const Error&) {
        return;
    }
}

void readStereo(const std::string& name) {
    mayRefuse([&] { readStereoFolder(folder() / name, 30); });
}

void readDetected(const std::string& name) {
    mayRefuse([&] {
        const std::string path = folder() / name;
        readSequence(path, detectLayout(path), 30);
    });
}

}  // namespace

void fuzzAssociations(const std::string& bytes) {
    folder().write("pairs/associations.txt", bytes);
    readDetected("pairs");
}

void fuzzIntrinsicsJson(const std::string& bytes) {
    folder().write("a.json", bytes);
    mayRefuse([&] { toIniText(readCalibration(folder() / "a.json")); });
}

void fuzzIntrinsicsYaml(const std::string& bytes) {
    folder().write("a.yaml", bytes);
    mayRefuse([&] { toIniText(readCalibration(folder() / "a.yaml")); });
}

void fuzzStrayScanner(const std::string& bytes) {
    folder().write("stray/odometry.csv", bytes);
    folder().write("stray/camera_matrix.csv", "30, 0, 15\n0, 30, 11\n0, 0, 1\n");
    readDetected("stray");
    folder().write("stray/odometry.csv", "timestamp, frame\n1.5, 000000\n");
    folder().write("stray/imu.csv", bytes);
    readDetected("stray");
    folder().write("stray/camera_matrix.csv", bytes);
    readDetected("stray");
}

void fuzzEurocSensor(const std::string& bytes) {
    for (const char* camera : {"cam0", "cam1"}) {
        folder().write("euroc/mav0/" + std::string(camera) + "/data/0.png", "");
        folder().write("euroc/mav0/" + std::string(camera) + "/sensor.yaml", bytes);
    }
    readStereo("euroc");
    folder().write("chain/mav0/cam0/data/0.png", "");
    folder().write("chain/mav0/cam1/data/0.png", "");
    folder().write("chain/dso/camchain.yaml", bytes);
    readStereo("chain");
}

void fuzzEurocLists(const std::string& bytes) {
    static const bool made = (stereo_folder::makeEuroc(folder(), "lists"), true);
    for (const char* sensor : {"cam0", "imu0", "state_groundtruth_estimate0"}) {
        const std::string list = std::string("lists/mav0/") + sensor + "/data.csv";
        const std::string whole = readText(folder() / list);
        folder().write(list, bytes);
        if (made) readStereo("lists");
        folder().write(list, whole);
    }
}

void fuzzKittiCalib(const std::string& bytes) {
    static const bool made = (stereo_folder::makeKitti(folder(), "kitti", 0), true);
    for (const char* file : {"calib.txt", "times.txt", "poses.txt"}) {
        const std::string path = std::string("kitti/") + file, whole = readText(folder() / path);
        folder().write(path, bytes);
        if (made) readStereo("kitti");
        folder().write(path, whole);
    }
}

void fuzzSens(const std::string& bytes) {
    setVerbosity(Verbosity::Quiet);
    folder().write("a.sens", bytes);
    mayRefuse([&] { UnpackedSens(folder() / "a.sens", folder() / "", 30); });
}

}  // namespace rgbd_graphslam
