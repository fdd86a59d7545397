#include "rgbd_graphslam/dataset/sequence_archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <filesystem>
#include <memory>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
#include "rgbd_graphslam/dataset/stereo_sequence.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t block_bytes = 1 << 18;
constexpr int unpack_flags = ARCHIVE_EXTRACT_SECURE_NODOTDOT | ARCHIVE_EXTRACT_SECURE_SYMLINKS;

using Archive = std::unique_ptr<archive, int (*)(archive*)>;

[[noreturn]] void refuse(const std::string& path, archive* from) {
    const char* reason = archive_error_string(from);
    throw Error("cannot unpack '" + path + "'" + (reason ? std::string(": ") + reason : ""),
                "check free space beside the output, or fetch the archive again");
}

Archive openArchive(const std::string& path) {
    Archive in(archive_read_new(), archive_read_free);
    archive_read_support_filter_all(in.get());
    archive_read_support_format_all(in.get());
    if (archive_read_open_filename(in.get(), path.c_str(), block_bytes) != ARCHIVE_OK) {
        refuse(path, in.get());
    }
    return in;
}

/** Only files and folders: a sequence needs no links, and links can lead out of the folder. */
bool isWanted(archive_entry* entry) {
    return archive_entry_filetype(entry) == AE_IFREG && !archive_entry_hardlink(entry);
}

void unpack(const std::string& path, const fs::path& folder) {
    const Archive in = openArchive(path);
    archive_entry* entry = nullptr;
    int status = ARCHIVE_OK;
    while ((status = archive_read_next_header(in.get(), &entry)) == ARCHIVE_OK) {
        if (!isWanted(entry)) continue;
        const fs::path name = fs::path(archive_entry_pathname(entry)).relative_path();
        archive_entry_set_pathname(entry, (folder / name).c_str());
        if (archive_read_extract(in.get(), entry, unpack_flags) != ARCHIVE_OK) {
            refuse(path, in.get());
        }
    }
    if (status != ARCHIVE_EOF) refuse(path, in.get());
}

/** Length of a known ending; 0 where there is none. */
std::size_t archiveEndingOf(const std::string& path) {
    for (const std::string ending : {".tgz", ".tar", ".tar.gz", ".tar.bz2", ".tar.xz", ".zip"}) {
        const bool ends = path.size() > ending.size() &&
                          path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
        if (ends) return ending.size();
    }
    return 0;
}

bool isSequence(const std::string& folder) {
    return layoutOf(folder) || isStereoFolder(folder);
}

}  // namespace

bool isSequenceArchive(const std::string& path) {
    return archiveEndingOf(path) > 0 && fs::is_regular_file(path);
}

std::string withoutArchiveEnding(const std::string& path) {
    return path.substr(0, path.size() - archiveEndingOf(path));
}

UnpackedArchive::UnpackedArchive(const std::string& archive, const std::string& scratch)
    : archive_(archive), folder_((fs::path(scratch) / "unpacked").string()) {
    unpack(archive, folder_.path());
}

std::string UnpackedArchive::sequenceFolder() const {
    if (isSequence(folder_.path())) return folder_.path();
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
        if (isSequence(entry.path())) return entry.path().string();
    }
    throw Error(
        "there is no sequence in the archive '" + archive_ + "'",
        "give an archive of the TUM RGB-D benchmark or another with RGB-D or stereo images");
}

}  // namespace rgbd_graphslam
