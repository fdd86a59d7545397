/** What the first frames of a recording tell before tracking begins. */
#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/depth_statistics.h"
#include "rgbd_graphslam/dataset/registration_check.h"
#include "rgbd_graphslam/features/feature_options.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** Something that makes, or may make, the map wrong. */
struct SurveyWarning {
    std::string text;
    /** Whether the map is wrong for certain: --strict refuses the recording. */
    bool refuses = false;
};

class RecordingSurvey {
  public:
    /** Frames at the beginning of a recording that are looked at, one of `step`. */
    static constexpr std::size_t frames = 40, step = 2;

    /** \param beginning observations of the first frames; those without usable images are passed
     *         over, which is tracking's to complain of */
    explicit RecordingSurvey(const std::vector<mrpt::obs::CObservation3DRangeScan::Ptr>& beginning);

    /** Of all readings, those beyond a depth (m), 0 to 1. */
    double shareBeyond(double depth_m) const;

    /** FeatureOptions::depth_max_m for this recording, where the user leaves it open: the default
     *  unless more than half of the readings lie beyond, then what takes 95 % of them, up to 100 m.
     */
    double suitableDepthMaxM() const;

    /** What does not fit the settings, or cannot be right. \param features with a depth_max_m that
     *  is not left open */
    std::vector<SurveyWarning> warnings(const FeatureOptions& features,
                                        const MapOptions& maps) const;

    DepthSummary depth() const { return summarize(depths_, depth_unit_m_); }

  private:
    std::optional<SurveyWarning> unitsWarning() const;
    std::optional<SurveyWarning> registrationWarning() const;
    void add(const mrpt::obs::CObservation3DRangeScan::Ptr& observation);

    DepthHistogram depths_;
    double depth_unit_m_ = 0.001, focal_length_px_ = 0;
    RegistrationCheck registration_;
    bool stereo_ = false;  // whose depth has no unit that could be wrong
};

}  // namespace rgbd_graphslam
