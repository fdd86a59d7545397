/** Sensors that run now as a source of observations. */
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "rgbd_graphslam/input/live_options.h"
#include "rgbd_graphslam/input/live_recorder.h"
#include "rgbd_graphslam/input/live_statistics.h"
#include "rgbd_graphslam/input/observation_source.h"

namespace rgbd_graphslam {

/** Takes measurements from the threads of sensors and hands them to tracking in one order:
 *
 *  - Images in order of their stamps. Where tracking is behind, the oldest that wait are dropped;
 *    more may wait until tracking has caught up for the first time, two seconds at most.
 *  - Before an image, the readings of other sensors up to its stamp, by their stamps. An image
 *    waits for those that are due by then, at most LiveOptions::wait_ms.
 *  - A reading that comes later than that goes before the next image, unless it is older than the
 *    one before by more than LiveOptions::late_s or than one of its own sensor: then it is dropped.
 *  - Where no image comes, readings are handed out once they have waited for LiveOptions::late_s.
 *  - Stamps of a clock that is set while the run goes on are corrected, so that time goes on.
 *
 *  All that is dropped is counted, told and, with a recorder, noted in the record. What was handed
 *  out is the record: a run over it needs no clock. */
class LiveSource final : public ObservationSource {
  public:
    using Clock = std::chrono::steady_clock;

    /** Frames looked at before tracking begins: a third of a second at 30 Hz. */
    static constexpr std::size_t survey_frames = 10;

    /** \param name as ObservationSource::name() */
    LiveSource(const LiveOptions& options, const std::string& name);
    ~LiveSource() override;

    /** Writes a record of the run, see LiveRecorder. Before the first push(). */
    void recordTo(const std::string& path);
    /** Ends so long after the first image. Before the first push(). */
    void endAfter(double seconds);
    /** Ends once `wanted` tells so; it is asked at least every 50 ms. */
    void endWhen(std::function<bool()> wanted);

    /** Takes a measurement; never waits. The observation may get another stamp. From any thread.
     *  \param arrival when it came */
    void push(mrpt::obs::CObservation::Ptr observation, Clock::time_point arrival = Clock::now());
    /** Notes that a driver failed and reports it. From any thread. */
    void noteFailure(const std::string& text);
    /** Reports sensors that have sent nothing for long. To be called a few times a second. */
    void reportSilence(Clock::time_point now = Clock::now());
    /** Nothing more comes: what waits is handed out, then the source is at its end. */
    void close();
    /** Ends at once. */
    void end();
    /** Whether close() or end() was called, or its time is over. */
    bool isClosed() const;

    /** Waits for the next observation. */
    mrpt::obs::CObservation::Ptr next() override;
    std::optional<double> progress() const override { return std::nullopt; }
    std::string name() const override { return name_; }
    std::string cameraRemedy() const override;
    std::size_t surveyFrames(std::size_t) const override { return survey_frames; }
    void notePose(const std::string& label, mrpt::Clock::time_point stamp) override;
    void noteTracked(const std::string& label, mrpt::Clock::time_point stamp) override;

    /** Completes the record. \return whether there is one, whole; why not has been said */
    bool finishRecord();

    LiveStatistics statistics() const;

  private:
    class Implementation;
    const std::string name_;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
