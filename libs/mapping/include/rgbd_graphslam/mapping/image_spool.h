/** Keyframe images of a run that has no recording. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <exception>
#include <string>
#include <thread>

#include "rgbd_graphslam/core/bounded_queue.h"
#include "rgbd_graphslam/mapping/recorded_images.h"

namespace rgbd_graphslam {

/** Of the file in a run's output folder. */
inline constexpr const char* image_spool_name = "keyframes.rawlog";

/** Writes a rawlog of what maps need, while the run goes on and in a thread of its own: the images
 *  of keyframes, about 1.5 MB each at 640x480, and readings of sensors. */
class ImageSpool {
  public:
    explicit ImageSpool(const std::string& path);
    /** Leaves no file unless finish() was called. */
    ~ImageSpool();
    ImageSpool(const ImageSpool&) = delete;
    ImageSpool& operator=(const ImageSpool&) = delete;

    /** Takes a reading; it must not change any more. Waits where the disk is far behind.
     *  \return false when the file cannot be written */
    bool note(mrpt::obs::CObservation::Ptr reading);
    /** The same for the images of a keyframe: RGB-D, or a StereoFrame. */
    bool add(const mrpt::obs::CObservation3DRangeScan::Ptr& frame);

    /** Completes the file. \return what RecordedImages reads it with
     *  \throws Error naming the path when it cannot be written */
    RecordedCamera finish();

  private:
    void write();
    bool push(mrpt::obs::CObservation::Ptr observation);

    RecordedCamera spooled_;
    std::size_t entries_ = 0;
    BoundedQueue<mrpt::obs::CObservation::Ptr> queue_;
    std::exception_ptr failure_;  // written by the thread, read once it has ended
    std::thread writer_;
};

}  // namespace rgbd_graphslam
