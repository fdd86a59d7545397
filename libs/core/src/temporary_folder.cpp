#include "rgbd_graphslam/core/temporary_folder.h"

#include <cerrno>
#include <filesystem>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& final_path)
    : final_(final_path), path_(temporaryName(final_path)) {
    makeWritableFolder(fs::absolute(final_path).parent_path());
    makeWritableFolder(path_);
}

TemporaryFolder::~TemporaryFolder() {
    const int reason = errno;  // why what was to be in it could not be written
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    errno = reason;
}

void TemporaryFolder::moveToFinalName() const {
    std::error_code failure;
    fs::remove_all(final_, failure);
    if (!failure) fs::rename(path_, final_, failure);
    if (failure) throw Error("cannot rename to '" + final_ + "': " + failure.message());
}

}  // namespace rgbd_graphslam
