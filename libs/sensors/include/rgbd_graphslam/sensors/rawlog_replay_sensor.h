/** A sensor that is a recording. */
#pragma once
#include <mrpt/hwdrivers/CGenericSensor.h>

#include <memory>

namespace rgbd_graphslam {

/** Replays a rawlog in real time, with the faults that sensors have, so that all that reads sensors
 *  runs without hardware. Made by CGenericSensor::createSensor("CRawlogReplaySensor") after
 *  doRegister(). Sections that replay one rawlog begin together, with the first one started.
 *  Settings beside those of every CGenericSensor, times in s of the replay:
 *
 *  | key | default | |
 *  |---|---|---|
 *  | `rawlog` | | file, relative to the working directory |
 *  | `labels` | all | sensors to replay, separated by commas |
 *  | `speed` | 1 | factor, 0.01 to 100 |
 *  | `repeat` | 1 | how often the rawlog is replayed, one after the other |
 *  | `stamps` | recorded | or `now`: the present time |
 *  | `jitter_ms` | 0 | each measurement is delayed by up to this |
 *  | `loss` | 0 | share of the measurements that are lost |
 *  | `reorder`, `reorder_ms` | 0, 50 | share of the measurements that are delayed by so much more |
 *  | `seed` | 1 | of jitter, loss and reordering |
 *  | `silent_at_s`, `silent_s` | never, 0 = to the end | sends nothing, without an error |
 *  | `unplug_every_s`, `unplugged_s` | never, 1 | fails, and again and again |
 *  | `clock_jump_at_s`, `clock_jump_s` | never, 0 | stamps change by so much |
 *
 *  Measurements due while it is silent or unplugged are lost. */
class CRawlogReplaySensor final : public mrpt::hwdrivers::CGenericSensor {
    DEFINE_GENERIC_SENSOR(CRawlogReplaySensor)

  public:
    CRawlogReplaySensor();
    ~CRawlogReplaySensor() override;

    /** \throws Error for a rawlog that cannot be read, std::runtime_error while unplugged */
    void initialize() override;
    /** Waits for the next measurement, a hundredth of a second at most. \throws as initialize() */
    void doProcess() override;

    /** Whether all has been replayed. From the thread that calls doProcess(). */
    bool ended() const;

  protected:
    /** \throws Error naming the key that is unknown or whose value makes no sense */
    void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& config,
                                   const std::string& section) override;

  private:
    class Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
