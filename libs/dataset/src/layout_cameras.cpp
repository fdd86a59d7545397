/** Cameras of benchmarks other than TUM's, and calibrations in their formats. */
#include <filesystem>

#include "list_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/intrinsics_file.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr double millimeters = 1000;

CameraSetup pinhole(const std::string& name, double fx, double fy, double cx, double cy,
                    double depth_units) {
    CameraSetup setup;
    setup.name = name;
    setup.camera.fx = fx;
    setup.camera.fy = fy;
    setup.camera.cx = cx;
    setup.camera.cy = cy;
    setup.depth_units = depth_units;
    return setup;
}

/** The camera that the benchmark's page gives for all sequences. */
CameraSetup bonnCamera() {
    CameraSetup setup = pinhole("bonn", 542.822841, 542.576870, 315.593520, 237.756098, 5000);
    setup.camera.lens = BrownLens{{0.039903, -0.099343, -0.000730, -0.000144}};
    return setup;
}

CameraSetup eth3dCamera(const RgbdSequence& sequence) {
    const std::string form = "fx fy cx cy";
    std::optional<CameraSetup> setup;
    const std::string path = fs::path(sequence.folder) / "calibration.txt";
    forEachLine(path, [&](Line& line) {
        double values[4];
        for (double& value : values) value = line.realNumber(form);
        if (values[0] <= 0 || values[1] <= 0) line.refuse("fx and fy must be positive", form);
        setup = pinhole("calibration.txt", values[0], values[1], values[2], values[3], 5000);
    });
    if (!setup) throw Error("'" + path + "' is empty", "its line must be '" + form + "'");
    setup->camera.width = setup->camera.height = 0;
    completeImageSize(sequence, setup->camera);
    return *setup;
}

std::optional<CameraSetup> cameraInFolder(const RgbdSequence& sequence) {
    auto setup = calibrationIn(sequence.folder);
    if (!setup) return std::nullopt;
    completeImageSize(sequence, setup->camera);
    requirePrincipalPoint(setup->camera, setup->name);
    return setup;
}

}  // namespace

void completeImageSize(const RgbdSequence& sequence, Intrinsics& camera) {
    if ((camera.width > 0 && camera.height > 0) || sequence.color.empty()) return;
    const auto image = readColorImage(fs::path(sequence.folder) / sequence.color.front().file);
    if (!image.damage.empty()) throw Error("image " + image.damage, "fetch the sequence again");
    camera.width = image.pixels.cols;
    camera.height = image.pixels.rows;
}

std::optional<CameraSetup> layoutCamera(const RgbdSequence& sequence, SequenceLayout layout) {
    switch (layout) {
        case SequenceLayout::Icl:
            return pinhole("icl", 481.2, 480, 319.5, 239.5, 5000);
        case SequenceLayout::SevenScenes:
            return pinhole("7-scenes", 585, 585, 320, 240, millimeters);
        case SequenceLayout::Bonn:
            return bonnCamera();
        case SequenceLayout::Eth3d:
            return eth3dCamera(sequence);
        case SequenceLayout::RealSense:
        case SequenceLayout::Folders:
        case SequenceLayout::Associations:
            return cameraInFolder(sequence);
        case SequenceLayout::StrayScanner:
        case SequenceLayout::Record3d:
            return sequence.camera;
        default:
            return std::nullopt;
    }
}

}  // namespace rgbd_graphslam
