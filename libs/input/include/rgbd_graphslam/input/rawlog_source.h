/** A rawlog as a source of observations. */
#pragma once
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/input/observation_source.h"

namespace rgbd_graphslam {

/** Observations of a rawlog in the order of the file. */
class RawlogSource final : public ObservationSource {
  public:
    /** \throws Error when the file is missing, empty or does not start like a rawlog */
    explicit RawlogSource(const std::string& path) : path_(path), reader_(path) {}

    mrpt::obs::CObservation::Ptr next() override;
    std::optional<double> progress() const override { return reader_.progress(); }
    std::string name() const override { return "the rawlog '" + path_ + "'"; }
    /** The record of a live run is looked at as the run did. */
    std::size_t surveyFrames(std::size_t usual) const override {
        return live_survey_frames_ > 0 ? live_survey_frames_ : usual;
    }

  private:
    const std::string path_;
    RawlogReader reader_;
    std::size_t live_survey_frames_ = 0;
};

}  // namespace rgbd_graphslam
