/** rgbd-import: an RGB-D sequence in folders becomes an MRPT rawlog. */
#include <cstdio>
#include <filesystem>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/foreign_file.h"
#include "rgbd_graphslam/dataset/intrinsics_file.h"
#include "rgbd_graphslam/dataset/sensor_hints.h"
#include "rgbd_graphslam/dataset/sensor_import.h"
#include "rgbd_graphslam/dataset/sensor_units.h"
#include "rgbd_graphslam/dataset/sequence_archive.h"
#include "rgbd_graphslam/dataset/sequence_import.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
#include "rgbd_graphslam/dataset/stereo_import.h"
#include "rgbd_graphslam/dataset/unpacked_bag.h"
#include "rgbd_graphslam/dataset/unpacked_sens.h"

namespace rgbd_graphslam {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string source, rawlog, camera, depth_camera, layout = "auto";
    double rate_hz = 30;
    double depth_units = 0, depth_scale = 0;
    bool compact = false, small = false;
    std::string accel_unit = "m/s2", gyro_unit = "rad/s", odometry_unit = "m", heading_unit = "rad";
    ImportOptions import;
    BagOptions bag;
};

/** Each takes a unit's name or a number, which may be negative. */
void declareSensorUnits(CLI::App& app, Arguments& args) {
    app.add_option("--imu-accel-unit", args.accel_unit,
                   "Unit of the accelerometer: m/s2, g, mg, cm/s2, mm/s2, or what one unit is in "
                   "m/s2 (=-1 if it is negated)")
        ->type_name("UNIT")
        ->capture_default_str();
    app.add_option("--imu-gyro-unit", args.gyro_unit,
                   "Unit of the gyroscope: rad/s, deg/s, mrad/s, mdeg/s, rpm, or a number as above")
        ->type_name("UNIT")
        ->capture_default_str();
    app.add_option("--odometry-unit", args.odometry_unit,
                   "Unit of the odometry's x and y: m, cm, mm, in, ft, or a number as above")
        ->type_name("UNIT")
        ->capture_default_str();
    app.add_option("--odometry-heading-unit", args.heading_unit,
                   "Unit of the odometry's heading: rad, deg, or a number as above")
        ->type_name("UNIT")
        ->capture_default_str();
}

SensorUnitValues sensorUnits(const Arguments& args) {
    return {unitValue(accelerationUnits(), args.accel_unit),
            unitValue(angularVelocityUnits(), args.gyro_unit),
            unitValue(lengthUnits(), args.odometry_unit),
            unitValue(angleUnits(), args.heading_unit)};
}

void declareSource(CLI::App& app, Arguments& args) {
    app.add_option("DIR", args.source,
                   "Folder of the sequence (RGB-D; EuRoC, KITTI or other stereo), its archive, "
                   "ScanNet's .sens, or a ROS bag: .bag "
                   "(ROS 1, RealSense), .db3, .mcap or folder (ROS 2)")
        ->required();
    app.add_option("OUT.rawlog", args.rawlog, "Rawlog to write")->required();
    std::vector<std::string> layouts = layoutNames();
    layouts.insert(layouts.begin(), "auto");
    app.add_option("--layout", args.layout, "Layout of the folder")
        ->check(CLI::IsMember(layouts))
        ->type_name("NAME")
        ->capture_default_str();
    app.add_option("--rate", args.rate_hz,
                   "Frames per second of layouts whose images are numbered, not stamped")
        ->check(positive())
        ->capture_default_str();
}

void declareCalibration(CLI::App& app, Arguments& args) {
    app.add_option(
        "--camera", args.camera,
        "fr1, fr2, fr3, ros, an ini file with [CAMERA_PARAMS], or a calibration of librealsense, "
        "Open3D or Azure Kinect (.json) or of ROS or Kalibr (.yaml); default: DIR/camera.ini, else "
        "the layout's, else inferred from the folder's name");
    app.add_option(
           "--depth-units", args.depth_units,
           "Depth units per meter (1000 for millimeters, 5000 for TUM); default: the camera "
           "file's, else 5000")
        ->check(positive());
    app.add_option("--depth-scale", args.depth_scale,
                   "Factor on depth; default: the camera file's, else 1")
        ->check(positive());
    app.add_option(
           "--register", args.depth_camera,
           "Ini file of the depth camera, when depth is not registered to color: depth is "
           "warped to the color camera. sensor_pose in both files gives the cameras' poses, "
           "depth_units the unit of the depth images")
        ->excludes("--depth-units")
        ->excludes("--depth-scale");
    app.add_option("--no-reading", args.import.no_reading,
                   "Raw depth value that means no reading, besides 0; 0: none does; default: "
                   "detected")
        ->type_name("VALUE");
}

/** Which images make a frame, and which recordings are refused. */
void declareFrames(CLI::App& app, Arguments& args) {
    app.add_option("--max-difference", args.import.max_difference_s,
                   "Maximum time difference between paired color and depth images [s]")
        ->check(positive())
        ->capture_default_str();
    app.add_option("--depth-offset", args.import.depth_offset_s,
                   "Added to the depth images' stamps, for depth that comes early or late [s]")
        ->check(finite());
    app.add_option(
           "--mask", args.import.mask_file,
           "Image that is black where every frame is to be ignored, such as the robot's own "
           "arm; default: DIR/mask.png if present. DIR/mask/ may hold one PNG per frame, "
           "named like its color image")
        ->type_name("FILE");
    app.add_flag("--strict", args.import.strict,
                 "Refuse a recording with missing files, or with depth that seems wrong: its unit, "
                 "its place in the color image or its time");
    app.add_flag("--allow-loss", args.import.allow_loss,
                 "Import even when more than half of the frames are lost");
    app.add_flag("--skip-damaged", args.import.skip_damaged,
                 "Skip frames with a damaged image instead of stopping");
}

void declareStorage(CLI::App& app, Arguments& args) {
    app.add_option("--threads", args.import.threads, "Threads that decode images")
        ->check(between(1, 256))
        ->capture_default_str();
    app.add_flag("--compact", args.compact,
                 "Keep images lossless in files beside the rawlog: smaller, slower to read");
    app.add_flag("--small", args.small,
                 "One compressed file, color as JPEG: smallest, slower to read, color not exact")
        ->excludes("--compact");
}

void declareBag(CLI::App& app, Arguments& args) {
    app.add_option("--color-topic", args.bag.color_topic,
                   "Bags: image topic for color; default: the best one")
        ->type_name("TOPIC");
    app.add_option("--depth-topic", args.bag.depth_topic,
                   "Bags: image topic for depth; default: registered depth, else raw depth")
        ->type_name("TOPIC");
    app.add_flag("--no-camera", args.bag.no_camera,
                 "Bags: import IMU, odometry, laser scans and GPS alone");
}

void declare(CLI::App& app, Arguments& args) {
    declareSource(app, args);
    declareCalibration(app, args);
    declareFrames(app, args);
    declareStorage(app, args);
    declareSensorUnits(app, args);
    declareBag(app, args);
    declareCommonOptions(app);
    declareExamples(app, {"rgbd-import rgbd_dataset_freiburg1_desk.tgz desk.rawlog",
                          "rgbd-import recording.bag recording.rawlog --camera camera.ini"});
}

CameraSetup guessedCamera(const RgbdSequence& sequence, SequenceLayout layout) {
    if (const auto camera = layoutCamera(sequence, layout)) {
        sayInfo("camera: that of " + camera->name);
        return *camera;
    }
    if (layout == SequenceLayout::RealSense) {
        throw Error(
            "'" + sequence.folder +
                "' has no calibration (camera.ini, camera_intrinsic.json, intrinsic.json or "
                "camera_info.yaml)",
            "give the camera with --camera");
    }
    if (const auto guess = cameraByFolderName(fs::canonical(sequence.folder).filename())) {
        sayInfo("camera: " + guess->name + ", by the folder's name");
        return *guess;
    }
    sayWarning(
        "cannot infer the camera from the folder's name; using generic intrinsics (f = 525 px) and "
        "5000 depth units per meter. Pass --camera FILE.ini");
    CameraSetup setup = *cameraByName("ros");
    setup.depth_units_assumed = true;
    return setup;
}

CameraSetup chooseCamera(const Arguments& args, const RgbdSequence& sequence,
                         SequenceLayout layout) {
    if (!args.camera.empty()) {
        const auto known = cameraByName(args.camera);
        return known ? *known : readCalibration(args.camera);
    }
    const fs::path file = fs::path(sequence.folder) / "camera.ini";
    if (fs::exists(file)) {
        sayInfo("camera: " + file.string());
        return readCameraFile(file);
    }
    return sequence.camera ? *sequence.camera : guessedCamera(sequence, layout);
}

/** A recorded depth camera stays where it is beside the color camera, wherever --camera puts that
 *  on the robot. */
std::optional<CameraSetup> besideCamera(const RgbdSequence& sequence, const CameraSetup& color) {
    if (!sequence.depth_camera || !sequence.camera) return sequence.depth_camera;
    CameraSetup depth = *sequence.depth_camera;
    depth.T_base_sensor = color.T_base_sensor * sequence.camera->T_base_sensor.inverse() *
                          sequence.depth_camera->T_base_sensor;
    return depth;
}

int importRead(const Arguments& args, const RgbdSequence& recorded, SequenceLayout layout) {
    const RgbdSequence sequence = inOurUnits(recorded, sensorUnits(args));
    CameraSetup setup = chooseCamera(args, sequence, layout);
    completeImageSize(sequence, setup.camera);
    const bool from_file = !args.camera.empty() && !cameraByName(args.camera);
    if (from_file) requirePrincipalPoint(setup.camera, setup.name);
    if (sequence.depth_units) {
        setup.depth_units = *sequence.depth_units;
        setup.depth_units_assumed = false;
    }
    if (args.depth_units > 0) {
        setup.depth_units = args.depth_units;
        setup.depth_units_assumed = false;
    }
    if (args.depth_scale > 0) setup.depth_scale = args.depth_scale;
    ImportOptions options = args.import;
    options.depth_camera = besideCamera(sequence, setup);
    const fs::path beside = fs::path(sequence.folder) / "camera_depth.ini";
    if (!args.depth_camera.empty()) {
        options.depth_camera = readCalibration(args.depth_camera);
    } else if (!options.depth_camera && fs::exists(beside)) {
        options.depth_camera = readCameraFile(beside);
        sayInfo("depth is registered to color by " + beside.string());
    }
    if (args.depth_units > 0 && options.depth_camera) {
        options.depth_camera->depth_units = args.depth_units;
        options.depth_camera->depth_units_assumed = false;
    }
    const ImportReport report = importSequence(sequence, setup, args.rawlog, options);
    std::fputs(toText(report).c_str(), stdout);
    return 0;
}

int importStereoFolder(const Arguments& args, const std::string& folder) {
    if (!args.depth_camera.empty() || args.depth_units > 0 || args.depth_scale > 0) {
        throw Error("'" + folder + "' is a stereo recording without depth images",
                    "leave --register, --depth-units and --depth-scale out");
    }
    StereoSequence sequence = readStereoFolder(folder, args.rate_hz, args.camera);
    sequence.motion = inOurUnits(sequence.motion, sensorUnits(args));
    const StereoReport report = importStereo(sequence, args.rawlog, args.import);
    std::fputs(toText(report).c_str(), stdout);
    return 0;
}

int importFolder(const Arguments& args, const std::string& folder) {
    if (args.layout == "auto" && fs::is_directory(folder) && !layoutOf(folder) &&
        isStereoFolder(folder)) {
        return importStereoFolder(args, folder);
    }
    const SequenceLayout layout =
        args.layout == "auto" ? detectLayout(folder) : layoutByName(args.layout);
    return importRead(args, readSequence(folder, layout, args.rate_hz), layout);
}

int importSens(const Arguments& args) {
    const UnpackedSens unpacked(args.source, fs::absolute(args.rawlog).parent_path(), args.rate_hz);
    return importRead(args, unpacked.sequence(), SequenceLayout::Folders);
}

int importBag(const Arguments& args) {
    const UnpackedBag unpacked(args.source, fs::absolute(args.rawlog).parent_path(), args.bag);
    if (!args.bag.no_camera) {
        return importRead(args, unpacked.sequence(), SequenceLayout::Tum);
    }
    const SensorReport report =
        importSensors(inOurUnits(unpacked.sequence(), sensorUnits(args)), args.rawlog);
    std::fputs(toText(report).c_str(), stdout);
    return 0;
}

/** \throws Error for the first that is given for something else than a bag */
void refuseBagOptions(const Arguments& args) {
    const auto refuse = [&](const std::string& option, bool given) {
        if (!given) return;
        throw Error(option + " is for ROS bags, and '" + args.source + "' is not one",
                    "leave it out");
    };
    refuse("--no-camera", args.bag.no_camera);
    refuse("--color-topic", !args.bag.color_topic.empty());
    refuse("--depth-topic", !args.bag.depth_topic.empty());
}

int run(Arguments& args) {
    if (args.compact) args.import.storage = RawlogStorage::Compact;
    if (args.small) args.import.storage = RawlogStorage::Small;
    if (isBag(args.source)) return importBag(args);
    refuseBagOptions(args);
    if (isSens(args.source)) return importSens(args);
    if (!isSequenceArchive(args.source)) {
        if (fs::is_regular_file(args.source)) refuseForeignFile(args.source);
        return importFolder(args, args.source);
    }
    const std::string beside = fs::absolute(args.rawlog).parent_path();
    sayInfo("unpacking '" + args.source + "'");
    const UnpackedArchive unpacked(args.source, beside);
    return importFolder(args, unpacked.sequenceFolder());
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    using namespace rgbd_graphslam;
    CLI::App app(
        "Imports an RGB-D or stereo recording (image folders of many layouts, archives, ROS bags, "
        ".sens) "
        "into an MRPT rawlog",
        "rgbd-import");
    Arguments args;
    declare(app, args);
    return runProgram(app, argc, argv, [&] { return run(args); });
}
