/** Reading rawlogs one observation at a time. */
#pragma once
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <memory>
#include <string>

namespace rgbd_graphslam {

/** One pass over a rawlog file, plain or gz, in file order. Memory stays at one entry. Images
 *  stored outside the rawlog are looked for in `<name>_Images` beside it (MRPT keeps one such
 *  folder a process: do not load external images of two rawlogs in turn while one of them is
 *  read by another thread). */
class RawlogReader {
  public:
    /** \throws Error when the file is missing, empty or does not start like a rawlog */
    explicit RawlogReader(const std::string& path);
    ~RawlogReader();
    RawlogReader(const RawlogReader&) = delete;
    RawlogReader& operator=(const RawlogReader&) = delete;

    /** The next observation, those inside sensory frames one by one; nullptr at the end. The
     * motions of actions are summed up and handed out as a CObservationOdometry 'ODOMETRY' before
     * the sensory frame that they lead to, with its stamp. \throws Error naming entry and byte
     * where the file is cut off or damaged; everything before has been handed out by then */
    mrpt::obs::CObservation::Ptr next();

    /** Share of the file that is read, 0 to 1. */
    double progress() const;

    /** Folder of the images that are stored outside `rawlog_path`. */
    static std::string imagesFolder(const std::string& rawlog_path);

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
