/** Frames of a source, read and prepared ahead of tracking. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/input/observation_source.h"
#include "rgbd_graphslam/input/sensor_census.h"
#include "rgbd_graphslam/slam/stage_times.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {

/** One frame with its features, and the readings of other sensors before it. */
struct StreamedFrame {
    /** All else that the source holds between the frame before and this one. */
    std::vector<mrpt::obs::CObservation::Ptr> before;
    /** Counts the RGB-D frames of the camera from 0. */
    std::size_t index = 0;
    /** Of the camera with the lowest number among those that took part. */
    mrpt::obs::CObservation3DRangeScan::Ptr observation;
    /** Which of the source's observations that is, counted from 0. */
    std::size_t entry = 0;
    /** Number of that camera in the rig. */
    int camera = 0;
    /** What other cameras took at the same moment, by rising number of the camera. */
    std::vector<std::pair<int, mrpt::obs::CObservation3DRangeScan::Ptr>> others;
    Frame prepared;
    /** Go into the prepared frame. */
    DeadReckoning reckoning;
    MotionReadings readings;
};

/** How many threads the process may use, the one that fetches frames included, and how many frames
 *  may wait to be fetched. */
struct ReadAhead {
    int threads = 2, frames = 8;
};

/** Gives the RGB-D frames of a source in its order, whatever the number of threads. With one thread
 *  all happens in next(); else the others read and prepare up to `ReadAhead::frames` frames, and
 *  wait when these are not fetched. */
class FrameStream {
  public:
    using Prepare = std::function<Frame(const std::vector<CameraImage>&)>;

    /** Observations further apart are different frames, s. */
    static constexpr double same_moment_s = 0.004;

    /** Reads the first RGB-D frames. Cameras that begin within three frames of the first one form a
     *  rig with it: their observations of one moment are one frame. Of cameras that claim to be in
     *  the same place only the first is taken, which is said.
     *  \param sensor_label of the only camera to take; empty = all
     *  \throws Error when the source has no RGB-D frame of that camera */
    FrameStream(std::shared_ptr<ObservationSource> source, const ReadAhead& ahead,
                const std::string& sensor_label = {});
    ~FrameStream();
    FrameStream(const FrameStream&) = delete;
    FrameStream& operator=(const FrameStream&) = delete;

    const Rig& rig() const;
    /** Of the rig's first camera. */
    const mrpt::obs::CObservation3DRangeScan& firstFrame() const;

    /** See ObservationSource. */
    std::size_t surveyFrames(std::size_t usual) const;

    /** Reads the next frames, or as many as there are, which next() hands out all the same; only
     *  before start(). Damage in them is next()'s to tell.
     *  \return their observations */
    std::vector<mrpt::obs::CObservation3DRangeScan::Ptr> lookAhead(std::size_t frames);

    /** Reads over a frame; only before start(). \return it, not prepared, or nothing at the end
     *  \throws Error as next() */
    std::optional<StreamedFrame> skip();

    /** \param prepare thread-safe */
    void start(Prepare prepare);

    /** The next frame; nothing at the end.
     *  \throws Error naming the frame where the source is cut off or damaged, or a frame has no
     *          usable images; there is nothing after it */
    std::optional<StreamedFrame> next();

    /** The source is told that the pose of a frame is known, see ObservationSource. */
    void notePose(const StreamedFrame& frame);
    /** The source is told that a frame is done, see ObservationSource. */
    void noteTracked(const StreamedFrame& frame);

    /** Waits until no frame is being prepared and ends reading ahead: what `prepare` uses may go.
     */
    void stop();

    /** Number of frames in the whole source, estimated from what is read. */
    std::size_t expectedFrames() const;

    /** Ground truth read so far, robot poses in the truth's world. */
    Trajectory truth() const;

    /** All that the source holds as far as it is read. */
    std::vector<SensorRecord> sensors() const;

    /** "read" and "decode". */
    const StageTimes& times() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
