#include "sealed_file.h"

#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/atomic_file.h"

namespace rgbd_graphslam {
namespace {

std::string named(const FileKind& kind, const std::string& path) {
    return "the " + kind.noun + " '" + path + "'";
}

std::string readBytes(const std::string& path, const FileKind& kind) {
    std::ifstream in(path, std::ios::binary);
    if (!std::filesystem::is_regular_file(path) || !in) {
        throw Error("cannot read " + named(kind, path), kind.if_missing);
    }
    std::string bytes(std::filesystem::file_size(path), '\0');
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
        throw Error("cannot read " + named(kind, path), "check the disk");
    }
    return bytes;
}

std::string readableVersions(const FileKind& kind) {
    const std::string newest = std::to_string(kind.version);
    if (kind.oldest_readable == kind.version) return "version " + newest;
    return "versions " + std::to_string(kind.oldest_readable) + " to " + newest;
}

SealedPayload open(std::string_view bytes, const FileKind& kind, const std::string& path) {
    ByteReader header(bytes.substr(kind.magic.size()));
    const auto version = header.get<std::uint32_t>();
    if (version < kind.oldest_readable || version > kind.version) {
        throw Error(named(kind, path) + " is of version " + std::to_string(version) +
                        ", this program reads " + readableVersions(kind),
                    "make it again with this program");
    }
    const auto size = header.get<std::uint64_t>();
    const auto checksum = header.get<std::uint32_t>();
    if (header.left() != size) {
        throw DamagedBytes("it has " + std::to_string(header.left()) + " of " +
                           std::to_string(size) + " bytes");
    }
    const std::string_view payload = bytes.substr(bytes.size() - size);
    if (checksumOf(payload) != checksum) throw DamagedBytes("its check sum is wrong");
    return {std::string(payload), version};
}

}  // namespace

std::uint32_t checksumOf(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void writeSealed(const std::string& path, const FileKind& kind, const std::string& payload) {
    ByteWriter header;
    header.put(kind.version);
    header.put(static_cast<std::uint64_t>(payload.size()));
    header.put(checksumOf(payload));
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << kind.magic << header.bytes() << payload;
        out.close();
        return out.good();
    });
}

SealedPayload readSealed(const std::string& path, const FileKind& kind) {
    const std::string bytes = readBytes(path, kind);
    if (bytes.compare(0, kind.magic.size(), kind.magic) != 0) {
        throw Error("'" + path + "' is no " + kind.noun + " of rgbd-slam", kind.if_other);
    }
    try {
        return open(bytes, kind, path);
    } catch (const DamagedBytes& e) {
        throw damaged(path, kind, e);
    }
}

Error damaged(const std::string& path, const FileKind& kind, const DamagedBytes& reason) {
    return Error(named(kind, path) + " is cut off or damaged: " + reason.what(), kind.if_damaged);
}

}  // namespace rgbd_graphslam
