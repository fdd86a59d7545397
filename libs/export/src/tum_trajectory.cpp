#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "run_trajectory.h"

namespace rgbd_graphslam {
namespace {

class TumExporter : public Exporter {
  public:
    const char* name() const override { return "tum"; }
    const char* about() const override { return "trajectory, TUM RGB-D benchmark"; }
    const char* fileName() const override { return "trajectory_tum.txt"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const Trajectory trajectory = readRunTrajectory(run_folder);
        writeTextAtomically(path, toTumText(trajectory));
        return poseCount(trajectory);
    }
};

}  // namespace

std::unique_ptr<const Exporter> tumExporter() {
    return std::make_unique<TumExporter>();
}

}  // namespace rgbd_graphslam
