/** Where observations come from. */
#pragma once
#include <mrpt/obs/CObservation.h>

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
};

}  // namespace rgbd_graphslam
