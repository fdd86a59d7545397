#include "fuzz_targets.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <zlib.h>

#include <functional>

#include "../support/tum_folder.h"
#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/options.h"
#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/dataset/tum_sequence.h"
#include "rgbd_graphslam/evaluation/consistency.h"
#include "rgbd_graphslam/export/pose_graph_text.h"
#include "rgbd_graphslam/features/feature_options.h"
#include "rgbd_graphslam/job/sparse_map_file.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/slam/slam_options.h"

namespace rgbd_graphslam {
namespace {

/** One folder a process: making one for each input would be most of the work. */
const TestFolder& folder() {
    static const TestFolder only;
    return only;
}

std::string fileOf(const std::string& name, const std::string& bytes) {
    folder().write(name, bytes);
    return folder() / name;
}

void mayRefuse(const std::function<void()>& read) {
    try {
        read();
    } catch (const Error&) {
        return;
    }
}

/** Reads all entries; one without usable images does not end the file. */
void readWholeRawlog(const std::string& path) {
    RawlogReader reader(path);
    while (const auto observation = reader.next()) {
        const auto frame =
            std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(observation);
        if (frame) mayRefuse([&] { toRgbdImage(frame); });
    }
}

}  // namespace

std::string sparseMapFile(std::uint32_t version, const std::string& payload) {
    ByteWriter header;
    header.put(version);
    header.put(static_cast<std::uint64_t>(payload.size()));
    header.put(static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(payload.data()), payload.size())));
    return "RGBDMAP\n" + header.bytes() + payload;
}

void fuzzTumList(const std::string& bytes) {
    fileOf("sequence/depth.txt", bytes);
    for (const char* list : {"rgb.txt", "groundtruth.txt", "accelerometer.txt"}) {
        std::filesystem::remove(folder() / "sequence/groundtruth.txt");
        fileOf("sequence/rgb.txt", "1.0 rgb/1.png\n");
        fileOf(std::string("sequence/") + list, bytes);
        mayRefuse([&] { stampOrder(readTumSequence(folder() / "sequence").color); });
    }
}

void fuzzIni(const std::string& bytes) {
    mayRefuse([&] {
        FeatureOptions features;
        TrackerOptions tracker;
        const IniFile ini = IniFile::fromFile(fileOf("settings.ini", bytes));
        ini.loadKnown({&features});
        ini.load({&features, &tracker});
    });
}

void fuzzCameraIni(const std::string& bytes) {
    mayRefuse([&] { toIniText(readCameraFile(fileOf("camera.ini", bytes))); });
}

void fuzzTrajectory(const std::string& bytes) {
    mayRefuse([&] { toTumText(readTumTrajectory(fileOf("trajectory.txt", bytes))); });
}

void fuzzFramesCsv(const std::string& bytes) {
    fileOf("run/trajectory.txt", "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n");
    fileOf("run/frames.csv", bytes);
    mayRefuse([&] { readClaimedPoses(folder() / "run"); });
}

void fuzzRawlog(const std::string& bytes) {
    mayRefuse([&] { readWholeRawlog(fileOf("a.rawlog", bytes)); });
}

void fuzzSparseMap(const std::string& bytes) {
    for (auto version = oldest_sparse_map_version; version <= sparse_map_version; ++version) {
        mayRefuse([&] { readSparseMap(fileOf("map.sparse", sparseMapFile(version, bytes))); });
    }
}

void fuzzBinaryOcTree(const std::string& bytes) {
    mayRefuse([&] { loadBinaryOcTree(fileOf("tree.bt", bytes)); });
}

void fuzzColorOcTree(const std::string& bytes) {
    mayRefuse([&] { loadColorOcTree(fileOf("tree.ot", bytes)); });
}

void fuzzPoseGraph(const std::string& bytes) {
    mayRefuse([&] { toG2oText(parseMrptGraph(bytes, "graph.graph")); });
}

const std::vector<NamedTarget>& fuzzTargets() {
    static const std::vector<NamedTarget> targets = {{"tum_list", fuzzTumList},
                                                     {"ini", fuzzIni},
                                                     {"camera_ini", fuzzCameraIni},
                                                     {"trajectory", fuzzTrajectory},
                                                     {"rawlog", fuzzRawlog},
                                                     {"sparse_map", fuzzSparseMap},
                                                     {"checkpoint", fuzzCheckpoint},
                                                     {"binary_octree", fuzzBinaryOcTree},
                                                     {"color_octree", fuzzColorOcTree},
                                                     {"pose_graph", fuzzPoseGraph},
                                                     {"frames_csv", fuzzFramesCsv},
                                                     {"associations", fuzzAssociations},
                                                     {"intrinsics_json", fuzzIntrinsicsJson},
                                                     {"intrinsics_yaml", fuzzIntrinsicsYaml},
                                                     {"stray_scanner", fuzzStrayScanner},
                                                     {"euroc_sensor", fuzzEurocSensor},
                                                     {"euroc_lists", fuzzEurocLists},
                                                     {"kitti_calib", fuzzKittiCalib},
                                                     {"sens", fuzzSens},
                                                     {"ros1_bag", fuzzRos1Bag},
                                                     {"mcap", fuzzMcap},
                                                     {"ros2_database", fuzzRos2Database},
                                                     {"ros_messages", fuzzRosMessages},
                                                     {"compressed_depth", fuzzCompressedDepth}};
    return targets;
}

}  // namespace rgbd_graphslam
