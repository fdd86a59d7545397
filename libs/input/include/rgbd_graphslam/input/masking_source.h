/** Frames without what moves by itself. */
#pragma once
#include <memory>
#include <string>

#include "rgbd_graphslam/dataset/label_observation.h"
#include "rgbd_graphslam/input/observation_source.h"

namespace rgbd_graphslam {

/** Masks the pixels of some classes in the frames of another source, by the label images that come
 *  before them. */
class MaskingSource final : public ObservationSource {
  public:
    /** \param moving_classes names separated by spaces */
    MaskingSource(std::shared_ptr<ObservationSource> source, std::string moving_classes)
        : source_(std::move(source)), moving_classes_(std::move(moving_classes)) {}

    mrpt::obs::CObservation::Ptr next() override;
    std::optional<double> progress() const override { return source_->progress(); }
    std::string name() const override { return source_->name(); }
    std::string cameraRemedy() const override { return source_->cameraRemedy(); }
    std::size_t surveyFrames(std::size_t usual) const override {
        return source_->surveyFrames(usual);
    }
    void noteTracked(const std::string& label, mrpt::Clock::time_point stamp) override {
        source_->noteTracked(label, stamp);
    }

  private:
    std::shared_ptr<ObservationSource> source_;
    std::string moving_classes_;
    LabelCollector labels_;
};

}  // namespace rgbd_graphslam
