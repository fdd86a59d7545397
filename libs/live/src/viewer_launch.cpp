#include "rgbd_graphslam/live/viewer_launch.h"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "rgbd_graphslam/core/console.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::string viewerProgram() {
    std::error_code none;
    const fs::path beside = fs::read_symlink("/proc/self/exe", none).parent_path() / "rgbd-viewer";
    return fs::exists(beside, none) ? beside.string() : "rgbd-viewer";
}

}  // namespace

void launchViewer(const std::string& folder) {
    std::string program = viewerProgram(), follow = "--follow", where = folder;
    char* arguments[] = {program.data(), follow.data(), where.data(), nullptr};
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t files;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    pid_t viewer = 0;
    const int problem =
        ::posix_spawnp(&viewer, program.c_str(), &files, &attributes, arguments, ::environ);
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
    if (problem != 0) {
        sayWarning("rgbd-viewer cannot be started (" + std::string(std::strerror(problem)) +
                   "); the run goes on without");
    }
}

}  // namespace rgbd_graphslam
