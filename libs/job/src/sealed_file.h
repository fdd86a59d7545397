/** Files of our own that prove themselves whole: kind, version, length and check sum in front. */
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

struct FileKind {
    std::string magic;  // the first bytes of every such file
    std::uint32_t version = 1;
    /** In errors: "the map". */
    std::string noun;
    /** Remedies where there is no such file, where a file is another, and where it is damaged. */
    std::string if_missing, if_other, if_damaged;
    std::uint32_t oldest_readable = version;
};

struct SealedPayload {
    std::string bytes;
    std::uint32_t version;
};

/** Atomically. \throws Error when the file cannot be written */
void writeSealed(const std::string& path, const FileKind& kind, const std::string& payload);

/** \return the payload, of any version that can be read
 *  \throws Error in one line naming the file when it is missing, of another kind or version, cut
 *          off or damaged */
SealedPayload readSealed(const std::string& path, const FileKind& kind);

/** What is said of a file whose payload makes no sense. */
Error damaged(const std::string& path, const FileKind& kind, const DamagedBytes& reason);

/** CRC-32. */
std::uint32_t checksumOf(std::string_view bytes);

}  // namespace rgbd_graphslam
