#include "rgbd_graphslam/graphslam/sparse_map_file.h"

#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

const std::string magic = "RGBDMAP\n";
constexpr std::uint32_t format_version = 1;

std::uint32_t checksumOf(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/** In front of the payload. */
std::string headerOf(const std::string& payload) {
    ByteWriter header;
    header.put(format_version);
    header.put(static_cast<std::uint64_t>(payload.size()));
    header.put(checksumOf(payload));
    return magic + header.bytes();
}

std::string readBytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!std::filesystem::is_regular_file(path) || !in) {
        throw Error("cannot read the map '" + path + "'",
                    "give the output folder of a run of rgbd-slam");
    }
    std::string bytes(std::filesystem::file_size(path), '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
        throw Error("cannot read the map '" + path + "'", "check the disk");
    }
    return bytes;
}

/** \return the payload */
std::string_view checked(const std::string& bytes, const std::string& path) {
    if (bytes.compare(0, magic.size(), magic) != 0) {
        throw Error("'" + path + "' is no map of rgbd-slam", "give a map.sparse");
    }
    ByteReader header(std::string_view(bytes).substr(magic.size()));
    const auto version = header.get<std::uint32_t>();
    if (version != format_version) {
        throw Error("the map '" + path + "' is of version " + std::to_string(version) +
                        ", this program reads version " + std::to_string(format_version),
                    "make it again with this program");
    }
    const auto size = header.get<std::uint64_t>();
    const auto checksum = header.get<std::uint32_t>();
    const std::string_view payload = std::string_view(bytes).substr(bytes.size() - header.left());
    if (payload.size() != size) {
        throw DamagedBytes("it has " + std::to_string(payload.size()) + " of " +
                           std::to_string(size) + " bytes");
    }
    if (checksumOf(payload) != checksum) throw DamagedBytes("its check sum is wrong");
    return payload;
}

SparseMap decode(ByteReader& in) {
    SparseMap map;
    map.config_hash = in.getText();
    map.T_up_world = decodePose(in);
    const std::size_t sessions = in.getCount(2 * sizeof(std::uint32_t));
    for (std::size_t s = 0; s < sessions; ++s) {
        const std::string rawlog = in.getText();
        map.sessions.push_back({rawlog, in.get<std::int32_t>()});
    }
    map.snapshot = decodeSnapshot(in);
    int earliest = 0;
    for (const MapSession& session : map.sessions) {
        if (session.first_keyframe < earliest) throw DamagedBytes("sessions that are not in order");
        earliest = session.first_keyframe;
    }
    if (earliest > static_cast<int>(map.snapshot.keyframes.size())) {
        throw DamagedBytes("a session that begins after the last keyframe");
    }
    return map;
}

}  // namespace

void writeSparseMap(const std::string& path, const SparseMap& map) {
    ByteWriter payload;
    payload.putText(map.config_hash);
    encodePose(map.T_up_world, payload);
    payload.putCount(map.sessions.size());
    for (const MapSession& session : map.sessions) {
        payload.putText(session.rawlog);
        payload.put<std::int32_t>(session.first_keyframe);
    }
    encode(map.snapshot, payload);
    const std::string header = headerOf(payload.bytes());
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << header << payload.bytes();
        out.close();
        return out.good();
    });
}

SparseMap readSparseMap(const std::string& path) {
    const std::string bytes = readBytes(path);
    try {
        ByteReader in(checked(bytes, path));
        return decode(in);
    } catch (const DamagedBytes& e) {
        throw Error("the map '" + path + "' is cut off or damaged: " + e.what(),
                    "copy it again or make it again");
    }
}

}  // namespace rgbd_graphslam
