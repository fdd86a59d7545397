#include <cmath>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/formatted.h"
#include "run_trajectory.h"

namespace rgbd_graphslam {
namespace {

constexpr const char* header =
    "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
    "q_RS_z []\n";

/** Stamps of trajectory.txt are exact to the microsecond. */
long long nanoseconds(double stamp_s) {
    return 1000 * std::llround(1e6 * stamp_s);
}

std::string eurocLine(const StampedPose& pose) {
    const Eigen::Quaterniond q = pose.T_world_cam.quaternion();
    const Eigen::Vector3d& t = pose.T_world_cam.t;
    return formatted("%lld,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f,%.9f\n", nanoseconds(pose.stamp_s), t.x(),
                     t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

class EurocExporter : public Exporter {
  public:
    const char* name() const override { return "euroc"; }
    const char* about() const override { return "trajectory, EuRoC MAV dataset (CSV)"; }
    const char* fileName() const override { return "trajectory_euroc.csv"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const Trajectory trajectory = readRunTrajectory(run_folder);
        std::string text = header;
        for (const StampedPose& pose : trajectory) text += eurocLine(pose);
        writeTextAtomically(path, text);
        return poseCount(trajectory);
    }
};

}  // namespace

std::unique_ptr<const Exporter> eurocExporter() {
    return std::make_unique<EurocExporter>();
}

}  // namespace rgbd_graphslam
