#include "rgbd_graphslam/benchmark/fetch_sequence.h"

#include <filesystem>

#include "rgbd_graphslam/benchmark/download.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/sequence_archive.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

std::string fetchSequence(const KnownSequence& sequence, const std::string& folder,
                          bool keep_archive) {
    makeWritableFolder(folder);
    const fs::path target = fs::path(folder) / sequence.folder();
    if (layoutOf(target)) {
        sayInfo("'" + target.string() + "' is there already");
        return target;
    }
    const std::string archive = target.string() + ".tgz";
    download(sequence.url, archive, sequence.bytes);
    sayInfo("unpacking '" + archive + "'");
    const UnpackedArchive unpacked(archive, folder);
    fs::rename(unpacked.sequenceFolder(), target);
    if (!keep_archive) fs::remove(archive);
    return target;
}

}  // namespace rgbd_graphslam
