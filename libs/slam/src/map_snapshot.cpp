#include "rgbd_graphslam/slam/map_snapshot.h"

#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
MapSnapshot takeSnapshot(const SlamMap& map, const Rig& rig, double scale_factor,
                         std::vector<PoseEdge> loops) {
    MapSnapshot snapshot;
    snapshot.rig = rig;
    snapshot.scale_factor = scale_factor;
    snapshot.levels = map.levels();
    snapshot.keyframes = map.keyframes();
    snapshot.loops = std::move(loops);
    std::vector<int> number(map.landmarks().size(), no_landmark);
    for (std::size_t id = 0; id < number.size(); ++id) {
        if (!map.landmarks()[id].alive) continue;
        number[id] = static_cast<int>(snapshot.landmarks.size());
        snapshot.landmarks.push_back(map.landmarks()[id]);
    }
    for (Keyframe& keyframe : snapshot.keyframes) {
        for (int& landmark : keyframe.landmarks) {
            if (landmark != no_landmark) landmark = number[landmark];
        }
    }
    return snapshot;
}

void encode(const MapSnapshot& snapshot, ByteWriter& out) {
    put(snapshot.rig, out);
    out.put(snapshot.scale_factor);
    out.putCount(snapshot.levels);
    out.putCount(snapshot.keyframes.size());
    for (const Keyframe& keyframe : snapshot.keyframes) put(keyframe, out);
    out.putCount(snapshot.landmarks.size());
    for (const Landmark& landmark : snapshot.landmarks) put(landmark, out);
    out.putCount(snapshot.loops.size());
    for (const PoseEdge& loop : snapshot.loops) put(loop, out);
}

MapSnapshot decodeSnapshot(ByteReader& in) {
    MapSnapshot snapshot;
    snapshot.rig = getRig(in);
    snapshot.scale_factor = getFinite(in);
    snapshot.levels = in.get<std::int32_t>();
    if (snapshot.scale_factor <= 1 || snapshot.levels < 1 || snapshot.levels > most_levels) {
        throw DamagedBytes("an image pyramid that cannot be");
    }
    const RigCameras cameras(snapshot.rig);
    const std::size_t keyframes = in.getCount(keyframe_bytes);
    if (keyframes == 0) throw DamagedBytes("a map without keyframes");
    for (std::size_t id = 0; id < keyframes; ++id) {
        snapshot.keyframes.push_back(
            getKeyframe(in, static_cast<int>(id), keyframes, cameras, snapshot.levels));
    }
    checkCulled(snapshot.keyframes);
    const std::size_t landmarks = in.getCount(landmark_bytes);
    for (std::size_t id = 0; id < landmarks; ++id) {
        snapshot.landmarks.push_back(getLandmark(in, static_cast<int>(id), snapshot.keyframes,
                                                 snapshot.levels, cameras.count()));
    }
    const std::size_t loops = in.getCount(edge_bytes);
    for (std::size_t i = 0; i < loops; ++i) {
        snapshot.loops.push_back(getEdge(in, keyframes, EdgeKind::Loop));
    }
    return snapshot;
}

}  // namespace rgbd_graphslam
