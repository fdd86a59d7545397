/** The rawlog that is written beside a live run. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rgbd_graphslam/core/bounded_queue.h"

namespace rgbd_graphslam {

/** Number of frames that a live run looked at before it began to track, by the comment at the
 *  beginning of its record; 0 for any other observation. */
std::size_t surveyedFrames(const mrpt::obs::CObservation& observation);

/** Writes a rawlog in a thread of its own: what was handed to tracking, in that order, up to the
 *  last frame that was tracked, with comments ("live run: ...")
 *  on what was not. A run over it sees the same. One
 *  thread may note while another commits. */
class LiveRecorder {
  public:
    /** \param survey_frames see surveyedFrames() */
    LiveRecorder(const std::string& path, std::size_t survey_frames);
    /** Gives up the record unless finish() was called. */
    ~LiveRecorder();
    LiveRecorder(const LiveRecorder&) = delete;
    LiveRecorder& operator=(const LiveRecorder&) = delete;

    /** Takes the next observation; it waits until a frame at or after it is tracked. */
    void note(mrpt::obs::CObservation::Ptr observation);
    /** \param text on what happened at this place */
    void comment(const std::string& text);

    /** What was noted up to the image of this label and stamp is written; waits where the disk is
     *  far behind. \return false when the record has failed, which was said */
    bool commit(const std::string& label, mrpt::Clock::time_point stamp);

    /** Completes the file. \throws Error naming the path when it cannot be written */
    void finish();

  private:
    using Batch = std::vector<mrpt::obs::CObservation::Ptr>;
    void write(const std::string& path);

    Batch takeUpTo(const std::string& label, mrpt::Clock::time_point stamp);

    std::mutex noting_;  // guards noted_
    std::deque<mrpt::obs::CObservation::Ptr> noted_;
    BoundedQueue<Batch> batches_;
    std::exception_ptr failure_;  // written by the thread, read once it has ended
    bool said_failed_ = false;
    std::thread writer_;
};

}  // namespace rgbd_graphslam
