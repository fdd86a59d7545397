/** Oriented FAST corners with rotated BRIEF descriptors. */
#pragma once
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/features/descriptor.h"
#include "rgbd_graphslam/features/feature_options.h"
#include "rgbd_graphslam/features/patch.h"

namespace rgbd_graphslam {

/** A corner as detected, in pixels of the (distorted) full-size image. */
struct Corner {
    float u = 0, v = 0;
    float angle_rad = 0;
    int octave = 0;
};

/** Corners with a descriptor and an image patch each, in the same order. */
struct OrbFeatures {
    std::vector<Corner> corners;
    std::vector<Descriptor> descriptors;
    std::vector<Patch> patches;
};

/** FAST-9 (Rosten and Drummond, ECCV 2006) on an image pyramid, spread evenly over cells, with
 *  sub-pixel position from the corner response, orientation by intensity centroid and BRIEF
 *  (Calonder et al., ECCV 2010) steered by it (Rublee et al., "ORB", ICCV 2011). */
class OrbExtractor {
  public:
    explicit OrbExtractor(const FeatureOptions& options);
    ~OrbExtractor();

    /** Thread-safe. \param gray CV_8UC1 of any size; too small levels are left out */
    OrbFeatures extract(const cv::Mat& gray) const;

  private:
    FeatureOptions options_;
    std::vector<float> scale_;
    std::vector<int> quota_;
};

}  // namespace rgbd_graphslam
