#include "rgbd_graphslam/core/installed_files.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

fs::path programFolder() {
    return fs::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace

std::string siblingProgram(const std::string& name) {
    return programFolder() / name;
}

std::string shippedIni(const std::string& name) {
    const fs::path path = programFolder().parent_path() / "share/rgbd_graphslam/ini" / name;
    if (!fs::exists(path)) {
        throw Error("'" + path.string() + "' is missing", "install the programs again");
    }
    return path;
}

}  // namespace rgbd_graphslam
