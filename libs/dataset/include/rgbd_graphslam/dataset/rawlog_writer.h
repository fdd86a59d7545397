/** Writing rawlogs that appear whole or not at all. */
#pragma once
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <functional>
#include <memory>
#include <string>

namespace rgbd_graphslam {

/** Where a rawlog keeps its images. */
enum class RawlogStorage {
    /** Everything in one file, pixels raw: the fastest to read and write. */
    Embedded,
    /** Color as PNG or JPEG files, depth as MRPT's compressed files, in `<name>_Images`. */
    Compact,
    /** One gz file with color as JPEG of quality 90, depth exact: for handing samples out. */
    Small
};

/** Takes the entries of one rawlog in order. */
class RawlogWriter {
  public:
    virtual ~RawlogWriter() = default;

    virtual void write(mrpt::obs::CObservation& observation) = 0;

    /** \param color_file what the color image was decoded from; compact storage copies it, if it
     * is PNG or JPEG, instead of encoding the pixels again. Empty when there is none */
    virtual void writeFrame(mrpt::obs::CObservation3DRangeScan& frame,
                            const std::string& color_file) = 0;

    /** \param left_file, right_file as color_file above */
    virtual void writePair(mrpt::obs::CObservationStereoImages& pair, const std::string& left_file,
                           const std::string& right_file) = 0;
};

/** Calls `fill` with a writer. The rawlog and its images folder replace older ones of that name
 *  only when all is written.
 *  \throws Error naming the path when it cannot be written; what fill throws passes through */
void writeRawlog(const std::string& path, RawlogStorage storage,
                 const std::function<void(RawlogWriter&)>& fill);

}  // namespace rgbd_graphslam
