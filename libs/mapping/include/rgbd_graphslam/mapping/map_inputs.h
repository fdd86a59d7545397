/** Poses and rawlogs that maps are made of. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/frame_entries.h"

namespace rgbd_graphslam {

/** A loop between two keyframes, by their index in MapInputs::keyframes. */
struct MapLoopEdge {
    int from = 0, to = 0;
    int inliers = 0;
};

/** A rawlog of an earlier session and how many keyframes are its. */
struct EarlierSession {
    std::string rawlog;
    std::size_t keyframes = 0;
    std::string sensor_label = {};  // of its camera; empty = that of the first frame
    FrameEntries entries = {};      // where its frames are, if that is known
};

/** What maps are made of. Poses are of the camera's optical frame. */
struct MapInputs {
    std::string rawlog;        // where the images are
    std::string sensor_label;  // of their camera; empty = that of the first frame
    FrameEntries entries;      // where its frames are, if that is known
    Trajectory keyframes;      // the maps are made of these; in order of time within a session
    /** Every frame; places depth images between color stamps, and accelerometer readings. */
    Trajectory trajectory;
    /** Stamps of the frames that have no pose, rising; paths are not drawn across them. */
    std::vector<double> unplaced_s;
    std::vector<MapLoopEdge> loops;
    /** Keyframes as they were without loops; may be empty. */
    Trajectory keyframes_before_loops;
    /** Where the first keyframes come from; the rest is of `rawlog`. */
    std::vector<EarlierSession> earlier;
    /** Keyframes, by rising index, whose place relative to the others is unknown. */
    std::vector<int> disconnected;
    /** Names, separated by spaces, of classes in the recordings' label images that are no part of
     *  the maps: see MaskedImages. */
    std::string moving_classes;
    /** z is hardly up: pictures cut no ceiling off. */
    bool up_is_guessed = false;
};

/** How many keyframes each earlier session has: paths are not drawn from one to the next. */
std::vector<std::size_t> sessionLengths(const MapInputs& inputs);

/** \throws Error when there is no keyframe, or something names one that is not there */
void checkInputs(const MapInputs& inputs);

/** The inputs without the disconnected keyframes, the others counted anew. */
MapInputs withoutDisconnected(const MapInputs& inputs);

/** All poses of the inputs in the frame a of T_a_world. */
MapInputs transformed(const SE3& T_a_world, MapInputs inputs);

}  // namespace rgbd_graphslam
