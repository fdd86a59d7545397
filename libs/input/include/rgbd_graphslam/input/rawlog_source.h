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

    mrpt::obs::CObservation::Ptr next() override { return reader_.next(); }
    std::optional<double> progress() const override { return reader_.progress(); }
    std::string name() const override { return "the rawlog '" + path_ + "'"; }

  private:
    const std::string path_;
    RawlogReader reader_;
};

}  // namespace rgbd_graphslam
