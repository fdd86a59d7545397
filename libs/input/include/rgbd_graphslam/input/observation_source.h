/** Where observations come from. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Hands out observations one after the other, in the order in which SLAM is to see them: a
 * recording from a file, sensors that are read live, messages of another process. */
class ObservationSource {
  public:
    virtual ~ObservationSource() = default;

    /** The next observation; nullptr at the end. Called by one thread at a time.
     *  \throws Error naming the place where the source is cut off or damaged */
    virtual mrpt::obs::CObservation::Ptr next() = 0;

    /** Share that has been read, 0 to 1; nothing where the end is not known. */
    virtual std::optional<double> progress() const = 0;

    /** As error messages call it: "the rawlog 'walk.rawlog'". */
    virtual std::string name() const = 0;

    /** What to do where it has no camera. */
    virtual std::string cameraRemedy() const { return "import a sequence with rgbd-import"; }

    /** Number of frames to look at before tracking begins, asked once there was a first frame.
     *  \param usual of a recording */
    virtual std::size_t surveyFrames(std::size_t usual) const { return usual; }

    /** The pose of an image that was handed out is known. As noteTracked(), and before it. */
    virtual void notePose(const std::string& /*label*/, mrpt::Clock::time_point /*stamp*/) {}

    /** An image that was handed out has its pose, or was passed over, and all that it set off is
     *  done. Called by the tracking thread, beside next(). */
    virtual void noteTracked(const std::string& /*label*/, mrpt::Clock::time_point /*stamp*/) {}
};

}  // namespace rgbd_graphslam
