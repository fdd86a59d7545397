#include "rgbd_graphslam/mapping/view_coverage.h"

#include "rgbd_graphslam/mapping/voxel_table.h"

namespace rgbd_graphslam {
namespace {

constexpr double cell_m = 0.5;
constexpr int rays_across = 5;
constexpr double depths_m[] = {0.75, 1.5, 2.25, 3};  // where most readings of a room are

}  // namespace

ViewCoverage::ViewCoverage(const Camera& camera, const Trajectory& keyframes)
    : camera_(camera.pinhole()) {
    for (const StampedPose& keyframe : keyframes) look(keyframe.T_world_cam, all_);
}

void ViewCoverage::add(const SE3& T_world_cam) {
    look(T_world_cam, seen_);
}

double ViewCoverage::share() const {
    std::size_t seen = 0;
    for (const std::uint64_t cell : seen_) seen += all_.count(cell);
    return all_.empty() ? 1 : static_cast<double>(seen) / static_cast<double>(all_.size());
}

void ViewCoverage::look(const SE3& T_world_cam, Cells& cells) const {
    for (int row = 0; row < rays_across; ++row) {
        for (int column = 0; column < rays_across; ++column) {
            const double u = (camera_.width - 1.) * column / (rays_across - 1),
                         v = (camera_.height - 1.) * row / (rays_across - 1);
            for (const double depth_m : depths_m) {
                const Eigen::Vector3d p = T_world_cam * camera_.unproject(u, v, depth_m);
                const Eigen::Array3i cell = (p / cell_m).array().floor().cast<int>();
                cells.insert(voxelKey({cell.x(), cell.y(), cell.z()}));
            }
        }
    }
}

}  // namespace rgbd_graphslam
