/** Folders, lists and calibrations that other programs wrote. */
#include <opencv2/imgcodecs.hpp>

#include "../support/tum_folder.h"
#include "fuzz_targets.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/intrinsics_file.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
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
    folder().write("stray/camera_matrix.csv", bytes);
    readDetected("stray");
}

void fuzzSens(const std::string& bytes) {
    setVerbosity(Verbosity::Quiet);
    folder().write("a.sens", bytes);
    mayRefuse([&] { UnpackedSens(folder() / "a.sens", folder() / "", 30); });
}

}  // namespace rgbd_graphslam
