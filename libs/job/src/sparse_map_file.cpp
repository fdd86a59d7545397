#include "rgbd_graphslam/job/sparse_map_file.h"

#include <algorithm>

#include "rgbd_graphslam/slam/map_encoding.h"
#include "sealed_file.h"
#include "sparse_map_upgrade.h"

namespace rgbd_graphslam {
namespace {

const FileKind map_file{"RGBDMAP\n",
                        sparse_map_version,
                        "map",
                        "give the output folder of a run of rgbd-slam",
                        "give a map.sparse",
                        "copy it again or make it again",
                        oldest_sparse_map_version};

/** No path holds it: what follows is the camera's label, where there is one. */
constexpr char behind_path = '\0';

SparseMap decode(ByteReader& in) {
    SparseMap map;
    map.config_hash = in.getText();
    map.T_up_world = decodePose(in);
    map.sessions = decodeSessions(in);
    map.snapshot = decodeSnapshot(in);
    requireInOrder(map.sessions, map.snapshot.keyframes.size());
    return map;
}

}  // namespace

void encode(const std::vector<MapSession>& sessions, ByteWriter& out) {
    out.putCount(sessions.size());
    for (const MapSession& session : sessions) {
        const std::string& label = session.sensor_label;
        out.putText(label.empty() ? session.rawlog : session.rawlog + behind_path + label);
        out.put<std::int32_t>(session.first_keyframe);
    }
}

std::vector<MapSession> decodeSessions(ByteReader& in) {
    std::vector<MapSession> sessions(in.getCount(2 * sizeof(std::uint32_t)));
    for (MapSession& session : sessions) {
        const std::string text = in.getText();
        const auto end = std::min(text.find(behind_path), text.size());
        session.rawlog = text.substr(0, end);
        if (end < text.size()) session.sensor_label = text.substr(end + 1);
        session.first_keyframe = in.get<std::int32_t>();
    }
    return sessions;
}

void requireInOrder(const std::vector<MapSession>& sessions, std::size_t keyframes) {
    int earliest = 0;
    for (const MapSession& session : sessions) {
        if (session.first_keyframe < earliest) throw DamagedBytes("sessions that are not in order");
        earliest = session.first_keyframe;
    }
    if (earliest > static_cast<std::int64_t>(keyframes)) {
        throw DamagedBytes("a session that begins after the last keyframe");
    }
}

void writeSparseMap(const std::string& path, const SparseMap& map) {
    ByteWriter payload;
    payload.putText(map.config_hash);
    encodePose(map.T_up_world, payload);
    encode(map.sessions, payload);
    encode(map.snapshot, payload);
    writeSealed(path, map_file, payload.bytes());
}

SparseMap readSparseMap(const std::string& path) {
    SealedPayload payload = readSealed(path, map_file);
    try {
        if (payload.version == oldest_sparse_map_version) payload.bytes = upgradeFromVersion2(payload.bytes);
        ByteReader in(payload.bytes);
        return decode(in);
    } catch (const DamagedBytes& e) {
        throw damaged(path, map_file, e);
    }
}

}  // namespace rgbd_graphslam
