#include "mapping_slam.h"

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/gravity_aligner.h"

namespace rgbd_graphslam {

TrackedFrame MappingSlam::track(const RgbdImage& image) {
    const TrackedFrame tracked = slam_.track(slam_.prepare(image));
    if (!tracked.keyframe) return tracked;
    images_.add(*tracked.keyframe, image);
    slam_.closeLoops(*tracked.keyframe);
    for (const KeyframeView& keyframe : slam_.keyframes()) {
        if (keyframe.culled) images_.drop(keyframe.id);
    }
    return tracked;
}

std::vector<KeyframeView> MappingSlam::mapped() const {
    constexpr int first_submap = 0;
    std::vector<KeyframeView> mapped;
    for (const KeyframeView& keyframe : slam_.keyframes()) {
        if (keyframe.submap == first_submap && images_.has(keyframe.id)) mapped.push_back(keyframe);
    }
    if (mapped.empty()) throw Error("there is no map yet", "track frames first");
    return mapped;
}

SE3 MappingSlam::T_up_world() const {
    GravityAligner survey{MapOptions()};
    MapInputs inputs;
    for (const KeyframeView& keyframe : mapped()) {
        survey.addKeyframe(inputs.keyframes.size(), images_[keyframe.id], camera_);
        inputs.keyframes.push_back({keyframe.stamp_s, keyframe.T_world_cam});
    }
    inputs.trajectory = inputs.keyframes;
    return survey.T_gravity_world(inputs, SE3());
}

DenseMapper MappingSlam::denseMaps(const MapOptions& options) const {
    const SE3 T_up = T_up_world();
    DenseMapper maps(options, camera_);
    for (const KeyframeView& keyframe : mapped()) {
        maps.insert(T_up * keyframe.T_world_cam, images_[keyframe.id]);
        maps.checkMemory();
    }
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
