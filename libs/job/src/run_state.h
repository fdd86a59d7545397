/** What the stages of a job hand on to each other. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "recording_survey.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/graphslam/graph_slam_session.h"
#include "rgbd_graphslam/input/frame_stream.h"
#include "rgbd_graphslam/job/slam_job.h"
#include "rgbd_graphslam/job/sparse_map_file.h"
#include "rgbd_graphslam/mapping/gravity_aligner.h"
#include "rgbd_graphslam/report/keyframe_sheet.h"
#include "sensor_watch.h"

namespace rgbd_graphslam {

/** A job's memory: tracking fills it, a checkpoint saves it, the description completes the report,
 *  and the outputs are made of it. */
struct RunState {
    /** \param start_map the map that the job starts from, if any; its snapshot goes to the session
     *  \throws Error when the rawlog has no RGB-D frame or the map does not fit it */
    RunState(const SlamJob& slam_job, std::optional<SparseMap> start_map);
    /** Frames read ahead are prepared by the session, which goes before the stream. */
    ~RunState();
    RunState(const RunState&) = delete;
    RunState& operator=(const RunState&) = delete;

    /** Notes how tracking placed a new keyframe. */
    void noteKeyframe(int keyframe);
    /** Remembers where the images of a frame are. */
    void noteEntry(const StreamedFrame& frame);
    /** Of the frame last looked at: what report and maps will need. */
    void keepPictures(int keyframe, const mrpt::obs::CObservation3DRangeScan::Ptr& observation);

    std::vector<std::string> allWarnings() const;
    /** The earlier ones' and this one. */
    std::vector<MapSession> sessions() const;
    /** Whether a submap is not the one that is written. */
    bool disconnected(int other) const { return other != submap; }
    /** Whether where it was seen from is known in the map that is written. */
    bool hasPlace(const TrackedFrame& frame) const;
    /** What a kill would lose, in keyframes: a place known already makes none, but tracking goes
     * on. */
    std::size_t progress() const { return T_previous_keyframe.size() + frames_read / 100; }
    /** Frames that have a place. */
    Trajectory located() const;
    /** Stamps of all other frames, rising. */
    std::vector<double> unplaced() const;

    SlamJob job;  // with what its settings leave open decided
    std::optional<SparseMap> start;
    FrameStream stream;
    RecordingSurvey survey;
    GraphSlamSession session;
    WarningRecord warnings;
    std::vector<std::string> earlier_warnings;  // before the checkpoint
    JobReport report;
    std::optional<double> first_stamp_s, last_stamp_s;
    std::size_t frames_read = 0;           // tracked or left out
    int first_keyframe = 0;                // of this rawlog
    int submap = 0;                        // of the map that is written
    std::vector<SE3> T_previous_keyframe;  // one per keyframe, the identity for the first
    std::vector<double> depth_shares;      // of the pixels of each keyframe
    KeyframeSheet keyframe_sheet;
    GravityAligner level;
    SensorWatch sensors;
    FrameEntries entries;              // of the first camera's frames
    Trajectory truth;  // beside the estimate, in its world
};

}  // namespace rgbd_graphslam
