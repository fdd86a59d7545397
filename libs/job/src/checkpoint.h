/** The file from which a killed run goes on. */
#pragma once
#include <future>
#include <string>

#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {

/** What tells one rawlog from another without reading all of it. */
struct RawlogMark {
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;  // of its beginning, middle and end
};

/** \throws Error when the file cannot be read */
RawlogMark markOf(const std::string& rawlog);

struct Checkpoint {
    /** Of the file and of `state`; `fuzz_replay` holds a state of it. */
    static constexpr std::uint32_t format = 8;

    /** Where it came to; its settings and its rawlog are the run's. */
    SlamJob job;
    RawlogMark rawlog;
    /** The rest of the job's memory, for the job alone. */
    std::string state;
};

std::string checkpointPath(const std::string& out_folder);

/** \throws Error in one line when there is none, it is damaged, another version of the program
 * wrote it, or the rawlog is not the one that it was written for */
Checkpoint readCheckpoint(const std::string& out_folder);

/** Writes checkpoints in a thread of its own. A disk that takes none is warned of once; the run
 * goes on without. */
class CheckpointWriter {
  public:
    /** \param progress of the run as it begins, as RunState::progress(): what comes makes the next
     *         checkpoint due */
    CheckpointWriter(const SlamJob& job, std::size_t progress);
    /** Waits for the last one to be written. */
    ~CheckpointWriter();

    bool enabled() const { return interval_ > 0; }
    bool due(std::size_t progress) const;
    /** Waits for the one before. \param state as Checkpoint::state */
    void write(std::size_t progress, std::string state);
    /** The job is done. */
    void remove();

  private:
    void wait();

    SlamJob job_;
    RawlogMark rawlog_;
    std::size_t interval_, last_;
    bool warned_ = false;
    std::future<void> writing_;
};

}  // namespace rgbd_graphslam
