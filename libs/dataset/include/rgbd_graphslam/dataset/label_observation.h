/** Label images in a rawlog. */
#pragma once
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <map>
#include <opencv2/core/mat.hpp>
#include <set>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/label_set.h"

namespace rgbd_graphslam {

/** Ends of sensor labels: `RGBD_LABEL` is of the images of camera `RGBD`. */
inline constexpr const char* label_suffix = "_LABEL";
inline constexpr const char* label_high_suffix = "_LABEL_HIGH";

/** A label image as gray images of 8 bits, which every MRPT tool reads, shows and stores without
 *  loss: the low bytes and, where any is not 0, the high bytes. They come before the frame that
 *  they belong to and have its stamp.
 *  \param labels CV_16UC1 */
std::vector<mrpt::obs::CObservation::Ptr> makeLabelObservations(const std::string& camera_label,
                                                                double stamp_s,
                                                                const cv::Mat& labels);

/** Whether a sensor's label is that of label images. */
bool isLabelSensor(const std::string& sensor_label);

/** The camera whose label images have this sensor label. */
std::string cameraOfLabels(const std::string& sensor_label);

/** Ignores the pixels of an RGB-D frame that have one of these labels, besides those that its mask
 *  leaves out already. \param labels CV_16UC1 of the images' size; of another size: nothing is done
 */
void maskLabels(mrpt::obs::CObservation3DRangeScan& frame, const cv::Mat& labels,
                const std::set<int>& left_out);

/** Puts the label images of a rawlog together while it is read. */
class LabelCollector {
  public:
    /** Takes up a label image or the names in a comment; others are passed over. */
    void note(const mrpt::obs::CObservation& observation);

    /** Of the frame of a camera, CV_16UC1; empty where it has none. \param stamp_s of the frame */
    cv::Mat of(const std::string& camera_label, double stamp_s) const;

    const LabelSet& names() const { return names_; }

  private:
    struct Latest {
        double stamp_s = 0;
        cv::Mat pixels;  // CV_8UC1
    };
    std::map<std::string, Latest> latest_;  // by sensor label
    LabelSet names_;
};

}  // namespace rgbd_graphslam
