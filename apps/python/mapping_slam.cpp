#include "mapping_slam.h"

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/gravity_aligner.h"

namespace rgbd_graphslam {

TrackedFrame MappingSlam::track(const RgbdImage& image) {
    const TrackedFrame tracked = slam_.track(slam_.prepare(image));
    if (!tracked.keyframe) return tracked;
    images_.add(image);
    slam_.closeLoops(*tracked.keyframe);
    for (const KeyframeView& keyframe : slam_.keyframes()) {
        if (keyframe.culled) images_.drop(keyframe.stamp_s);
    }
    return tracked;
}

Trajectory MappingSlam::mapped() const {
    constexpr int first_submap = 0;
    Trajectory mapped;
    for (const KeyframeView& keyframe : slam_.keyframes()) {
        if (keyframe.submap == first_submap && images_.has(keyframe.stamp_s))
            mapped.push_back({keyframe.stamp_s, keyframe.T_world_cam});
    }
    if (mapped.empty()) throw Error("there is no map yet", "track frames first");
    return mapped;
}

SE3 MappingSlam::T_up_world() const {
    GravityAligner survey{MapOptions()};
    MapInputs inputs;
    inputs.keyframes = inputs.trajectory = mapped();
    images_.forEach(inputs.keyframes, "finding the floor", [&](const Keyframe3D& keyframe) {
        survey.addKeyframe(keyframe.index, keyframe.image, camera_);
    });
    return survey.T_gravity_world(inputs, SE3());
}

DenseMapper MappingSlam::denseMaps(const MapOptions& options) const {
    const SE3 T_up = T_up_world();
    DenseMapper maps(options, camera_);
    images_.forEach(mapped(), "mapping", [&](const Keyframe3D& keyframe) {
        maps.insert(T_up * keyframe.pose.T_world_cam, keyframe.image);
        maps.checkMemory();
    });
    maps.finish();
    return maps;
}

PointMap MappingSlam::points(const MapOptions& options) const {
    return denseMaps(options).points();
}

mrpt::maps::COccupancyGridMap2D MappingSlam::grid(const MapOptions& options) const {
    mrpt::maps::COccupancyGridMap2D grid;
    denseMaps(options).grid(grid);
    return grid;
}

}  // namespace rgbd_graphslam
