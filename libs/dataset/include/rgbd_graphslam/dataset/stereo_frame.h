/** Stereo pairs where RGB-D frames are expected. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include <memory>

#include "rgbd_graphslam/dataset/stereo_rectifier.h"
#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** An RGB-D observation whose depth is yet to be found in a stereo pair: stamp, label, calibration
 *  and pose are those of the rectified left camera; the images are made when they are asked for. */
class StereoFrame : public mrpt::obs::CObservation3DRangeScan {
  public:
    /** \throws Error naming the stamp when there is no right image or the calibration is unusable
     */
    explicit StereoFrame(mrpt::obs::CObservationStereoImages::Ptr pair);

    /** The rectified pair without `depth`. `gray` is there always, `color` of color cameras.
     *  \throws Error naming the stamp when an image is missing, unreadable or not of its size */
    RgbdImage images() const;
    /** As it was taken. */
    const mrpt::obs::CObservationStereoImages::Ptr& pair() const { return pair_; }
    /** Focal length times baseline, m px. */
    double disparityInMeterPixels() const { return rectifier_->disparityInMeterPixels(); }

  private:
    mrpt::obs::CObservationStereoImages::Ptr pair_;
    std::shared_ptr<const StereoRectifier> rectifier_;
};

/** The observation itself if it is an RGB-D frame, a StereoFrame for a stereo pair, else nullptr.
 *  \throws Error as StereoFrame() */
mrpt::obs::CObservation3DRangeScan::Ptr asRgbdFrame(
    const mrpt::obs::CObservation::Ptr& observation);

}  // namespace rgbd_graphslam
