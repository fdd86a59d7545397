/** What reads files from outside, each as a function of bytes. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Reads the bytes as a file of its kind and returns, whatever they are, as long as the reader
 *  takes them or refuses them with an Error; all else passes through. */
using FuzzTarget = void (*)(const std::string& bytes);

void fuzzTumList(const std::string& bytes);
/** The bytes are a list of pairs. */
void fuzzAssociations(const std::string& bytes);
void fuzzIntrinsicsJson(const std::string& bytes);
void fuzzIntrinsicsYaml(const std::string& bytes);
/** The bytes are odometry.csv, imu.csv, and camera_matrix.csv. */
void fuzzStrayScanner(const std::string& bytes);
/** The bytes are both cameras' sensor.yaml, and camchain.yaml. */
void fuzzEurocSensor(const std::string& bytes);
/** The bytes are data.csv of a camera, of the IMU, and of the truth. */
void fuzzEurocLists(const std::string& bytes);
/** The bytes are calib.txt, times.txt, and poses.txt. */
void fuzzKittiCalib(const std::string& bytes);
void fuzzSens(const std::string& bytes);
void fuzzIni(const std::string& bytes);
void fuzzCameraIni(const std::string& bytes);
void fuzzTrajectory(const std::string& bytes);
/** frames.csv of a run, as rgbd-eval consistency reads it. */
void fuzzFramesCsv(const std::string& bytes);
/** Every observation, and the images of those that are RGB-D. */
void fuzzRawlog(const std::string& bytes);
/** A map.sparse of that version. */
std::string sparseMapFile(std::uint32_t version, const std::string& payload);
/** The bytes are a map.sparse behind its check sum, which would keep all others out. */
void fuzzSparseMap(const std::string& bytes);
/** The bytes are the state in a checkpoint; a run that takes it up goes on to its end. */
void fuzzCheckpoint(const std::string& bytes);
void fuzzBinaryOcTree(const std::string& bytes);
void fuzzColorOcTree(const std::string& bytes);
void fuzzPoseGraph(const std::string& bytes);
/** Bags as rgbd-import reads them. */
void fuzzRos1Bag(const std::string& bytes);
void fuzzMcap(const std::string& bytes);
void fuzzRos2Database(const std::string& bytes);
/** The bytes behind the first are read as each of ROS's messages; the first tells of which ROS. */
void fuzzRosMessages(const std::string& bytes);
/** The bytes behind the first are a packed depth image; the first tells how it is packed. */
void fuzzCompressedDepth(const std::string& bytes);

struct NamedTarget {
    const char* name;
    FuzzTarget run;
};

/** All of them, by the names of their corpora. */
const std::vector<NamedTarget>& fuzzTargets();

/** States of a run after a few frames, and after more. */
std::vector<std::string> checkpointSeeds();
/** \return the state of a run that has taken up `state` and saved it
 *  \throws Error when it makes no sense */
std::string goneOnAndSaved(const std::string& state);

/** Small valid inputs of a target whose files are not text. \throws Error for another name */
std::vector<std::string> binarySeeds(const std::string& target);

}  // namespace rgbd_graphslam
