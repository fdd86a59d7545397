/** How well masks of moving things agree with true ones. */
#pragma once
#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rgbd_graphslam/evaluation/mover_boxes.h"
#include "rgbd_graphslam/evaluation/report.h"

namespace rgbd_graphslam {

/** Which pictures are scored, and what counts as good. */
struct MaskAccuracyOptions {
    /** Only pictures are scored of which movers take up this share at least ... */
    double min_share = 0.02;
    /** ... and whose fastest mover has this speed, where speeds are known. */
    double min_speed_m_s = 0.2;
    /** A picture whose intersection over union reaches this is good. */
    double good_iou = 0.7;
    double max_difference_s = 0.005;
};

/** How well estimated masks agree with the true ones. */
struct MaskAccuracy {
    std::size_t pictures = 0;  // with an estimate and a truth
    std::size_t missing = 0;   // true masks without an estimate
    std::size_t scored = 0;    // with movers large and fast enough
    /** Intersection over union of the scored pictures: the mean, the median, the share of good
     *  ones, and that of all their pixels together. */
    double mean_iou = 0, median_iou = 0, good = 0, total_iou = 0;
    /** Share that is masked of the pixels that show nothing that moves, over all pictures. */
    double falsely_masked = 0;
};

/** Collects pictures. Masks are CV_8UC1, anything but 0 is masked. */
class MaskScore {
  public:
    explicit MaskScore(const MaskAccuracyOptions& options = {}) : options_(options) {}
    /** \param fast_enough whether the picture's movers are worth a score
     *  \throws Error when the sizes differ */
    void add(const cv::Mat& estimated, const cv::Mat& truth, bool fast_enough = true);
    void addMissing() { ++missing_; }
    MaskAccuracy result() const;

  private:
    MaskAccuracyOptions options_;
    std::size_t pictures_ = 0, missing_ = 0;
    std::vector<double> ious_;
    double common_ = 0, together_ = 0, false_ = 0, still_ = 0;  // pixels
};

/** Masks whose names are stamps, such as "1000.033333.png", paired by stamp.
 *  \param movers boxes by stamps, of the film that the true masks belong to; empty: not known
 *  \throws Error when a folder holds no such mask, none has a partner or one cannot be read */
MaskAccuracy evaluateMasks(const std::string& estimated_folder, const std::string& true_folder,
                           const std::vector<MoverBox>& movers,
                           const MaskAccuracyOptions& options = {});

Report reportOf(const std::string& masks, const MaskAccuracy& accuracy);

}  // namespace rgbd_graphslam
