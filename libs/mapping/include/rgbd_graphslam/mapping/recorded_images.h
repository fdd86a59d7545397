/** Keyframe images of a rawlog. */
#pragma once
#include <string>
#include <utility>

#include "rgbd_graphslam/mapping/frame_entries.h"
#include "rgbd_graphslam/mapping/keyframe_images.h"

namespace rgbd_graphslam {

/** An RGB-D camera of a rawlog. */
struct RecordedCamera {
    RecordedCamera(std::string path, std::string label = {}, FrameEntries frame_entries = {})
        : rawlog(std::move(path)),
          sensor_label(std::move(label)),
          entries(std::move(frame_entries)) {}

    std::string rawlog;
    std::string sensor_label;  // empty = of the first frame
    /** Where the frames are; empty where that is not known. */
    FrameEntries entries;
};

/** Reads images from the entries of the rawlog in which the run found the frames, in one pass. Runs
 *  of earlier versions and rawlogs that take the place of the run's own have no list of entries:
 *  their frames are known by their stamps. */
class RecordedImages final : public KeyframeImages {
  public:
    explicit RecordedImages(RecordedCamera camera) : camera_(std::move(camera)) {}

    std::size_t forEach(const Trajectory& keyframes, const std::string& label,
                        const Consume& consume, const Note& note = {}) const override;

  private:
    const RecordedCamera camera_;
};

}  // namespace rgbd_graphslam
