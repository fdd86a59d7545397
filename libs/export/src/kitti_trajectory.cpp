#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/formatted.h"
#include "run_trajectory.h"

namespace rgbd_graphslam {
namespace {

/** The upper three rows of the 4x4 matrix, by rows. */
std::string kittiLine(const SE3& pose) {
    std::string line;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) line += formatted("%.9g ", pose.R(row, column));
        line += formatted(row < 2 ? "%.9g " : "%.9g\n", pose.t(row));
    }
    return line;
}

class KittiExporter : public Exporter {
  public:
    const char* name() const override { return "kitti"; }
    const char* about() const override { return "trajectory, KITTI odometry benchmark"; }
    const char* fileName() const override { return "trajectory_kitti.txt"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const Trajectory trajectory = readRunTrajectory(run_folder);
        const SE3 T_first_world = trajectory.front().T_world_cam.inverse();
        std::string text;
        for (const StampedPose& pose : trajectory)
            text += kittiLine(T_first_world * pose.T_world_cam);
        writeTextAtomically(path, text);
        if (const std::size_t missing = framesWithoutPose(run_folder, trajectory)) {
            sayWarning(std::to_string(missing) +
                       " frames have no pose and no line in the KITTI file, so its line numbers "
                       "are not frame numbers; the TUM and EuRoC formats have time stamps");
        }
        return poseCount(trajectory) + ", relative to the first camera";
    }
};

}  // namespace

std::unique_ptr<const Exporter> kittiExporter() {
    return std::make_unique<KittiExporter>();
}

}  // namespace rgbd_graphslam
