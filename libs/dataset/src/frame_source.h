/** The images of an import, brought to one size and to the color camera's view. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame_pairs.h"
#include "image_masks.h"
#include "label_images.h"
#include "rgbd_graphslam/dataset/depth_registration.h"
#include "rgbd_graphslam/dataset/sequence_import.h"

namespace rgbd_graphslam {

/** A frame on its way from disk to rawlog; without images when `damage` says why. */
struct LoadedFrame {
    std::string color_file;
    cv::Mat color, depth;
    std::string damage;
    /** Depth came in meters. */
    bool converted = false;
    /** See ImageMasks. */
    cv::Mat mask;
    /** See LabelImages. */
    cv::Mat labels;
};

class FrameSource {
  public:
    /** Looks at the sizes of the first images and at some depth images' readings.
     *  \throws Error when calibration, color and depth do not fit each other */
    FrameSource(const RgbdSequence& sequence, const CameraSetup& setup,
                const ImportOptions& options, const std::vector<FramePair>& pairs);

    /** Of the frames that load() gives. */
    const CameraSetup& setup() const { return setup_; }
    /** What was changed, a line each. */
    const std::vector<std::string>& notes() const { return notes_; }

    /** Of the values of label images; empty without any. */
    const LabelSet& labelNames() const { return labels_.names(); }

    /** Units per meter of the depth images. */
    double depthUnits() const;

    /** Safe to be called by several threads at once.
     *  \throws Error for an image of the wrong kind or size */
    LoadedFrame load(const FramePair& pair) const;

  private:
    void fitSizes(const std::vector<FramePair>& pairs);
    void fitColor(const std::string& file, cv::Size size);
    void fitDepth(const std::string& file, cv::Size size);
    void findNoReading(const std::vector<FramePair>& pairs);
    std::string pathOf(const ListedImage& image) const;

    const RgbdSequence& sequence_;
    ImageMasks masks_;
    LabelImages labels_;
    CameraSetup setup_;
    std::optional<CameraSetup> depth_setup_;
    std::optional<DepthRegistration> registration_;
    cv::Size depth_size_;
    std::vector<std::uint16_t> no_reading_;
    std::vector<std::string> notes_;
};

}  // namespace rgbd_graphslam
