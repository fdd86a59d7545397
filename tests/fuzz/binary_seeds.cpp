#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include "../support/small_sens.h"
#include "../support/tum_folder.h"
#include "../support/unpacked.h"
#include "bag_seeds.h"
#include "fuzz_targets.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/job/sparse_map_file.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t sparse_map_header_bytes = 24;

mrpt::obs::CObservation3DRangeScan::Ptr smallFrame(double stamp_s) {
    CameraSetup setup;
    setup.camera = Intrinsics{8, 6, 9, 9, 3.5, 2.5, BrownLens{{0.1, -0.2, 0, 0, 0.1}}};
    auto frame = makeRgbdObservation(setup, stamp_s);
    setColor(*frame, cv::Mat(6, 8, CV_8UC3, cv::Scalar(10, 20, 30)));
    setDepth(*frame, cv::Mat(6, 8, CV_16UC1, cv::Scalar(5000)));
    return frame;
}

/** MRPT's observations start with the time of now: a seed of another moment would have other bytes,
 *  and what a random change finds in it would not come again. */
template <class Observation>
Observation observedAt(double stamp_s) {
    Observation observation;
    observation.timestamp = mrpt::Clock::fromDouble(stamp_s);
    return observation;
}

void writeSmallRawlog(const std::string& path, RawlogStorage storage) {
    writeRawlog(path, storage, [](RawlogWriter& writer) {
        auto truth = observedAt<mrpt::obs::CObservationRobotPose>(1);
        truth.sensorLabel = ground_truth_label;
        writer.write(truth);
        writer.write(*smallFrame(1));
        auto imu = observedAt<mrpt::obs::CObservationIMU>(1.5);
        writer.write(imu);
        writer.write(*smallFrame(2));
    });
}

/** Three keyframes, one of them culled, with a landmark and a loop. */
SparseMap smallMap() {
    SlamMap map(1.25, 6);
    Frame frame;
    frame.keypoints.resize(2);
    frame.descriptors.resize(2);
    for (int k = 0; k < 3; ++k) {
        map.addKeyframe(frame, {Eigen::Matrix3d::Identity(), {0.1 * k, 0, 0}});
    }
    map.addLandmark({0, 0, 1}, 0, 0);
    map.cull(2, 1);
    PoseEdge loop;
    loop.kind = EdgeKind::Loop;
    loop.from = 0;
    loop.to = 1;
    loop.information = Eigen::Matrix<double, 6, 6>::Identity();
    return {
        takeSnapshot(map, rigOf(CameraModel{}), 1.25, {loop}), SE3(), "hash", {{"/a.rawlog", 0}}};
}

template <class Tree>
Tree smallTree() {
    Tree tree(0.1);
    for (const float x : {0.05f, 0.15f, 0.95f}) tree.updateNode(octomap::point3d(x, 0, 0), true);
    tree.updateNode(octomap::point3d(0, 0.55f, 0), false);
    return tree;
}

octomap::ColorOcTree smallColorTree() {
    auto tree = smallTree<octomap::ColorOcTree>();
    tree.setNodeColor(0.05f, 0, 0, 200, 100, 50);
    tree.updateInnerOccupancy();
    return tree;
}

}  // namespace

std::vector<std::string> binarySeeds(const std::string& target) {
    const TestFolder folder;
    const std::string path = folder / "seed";
    if (target == "rawlog") {
        writeSmallRawlog(path + ".rawlog", RawlogStorage::Embedded);
        writeSmallRawlog(path + "_jpeg.rawlog", RawlogStorage::Small);
        return {readText(path + ".rawlog"), unpacked(path + "_jpeg.rawlog")};
    }
    if (target == "sparse_map") {
        writeSparseMap(path, smallMap());
        return {readText(path).substr(sparse_map_header_bytes)};
    }
    if (target == "checkpoint") return checkpointSeeds();
    if (target == "binary_octree") {
        saveBinaryOcTree(path, smallTree<octomap::OcTree>());
        return {readText(path)};
    }
    if (target == "color_octree") {
        saveColorOcTree(path, smallColorTree());
        return {readText(path)};
    }
    if (target == "sens") {
        SmallSens sens;
        for (int i = 0; i < 2; ++i) {
            sens.frames.push_back({cv::Mat(2, 3, CV_8UC3, cv::Scalar::all(10 * i)),
                                   cv::Mat(2, 3, CV_16UC1, cv::Scalar(1000 + i))});
        }
        return {sens.bytes()};
    }
    if (target == "ros1_bag") return ros1BagSeeds();
    if (target == "mcap") return mcapSeeds();
    if (target == "ros2_database") return ros2DatabaseSeeds();
    if (target == "ros_messages") return rosMessageSeeds();
    if (target == "compressed_depth") return compressedDepthSeeds();
    throw Error("the corpus of '" + target + "' is text");
}

}  // namespace rgbd_graphslam
