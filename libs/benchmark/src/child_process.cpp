#include "rgbd_graphslam/benchmark/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

extern char** environ;

namespace rgbd_graphslam {
namespace {

class FileActions {
  public:
    explicit FileActions(const std::string& log) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                         0644);
        posix_spawn_file_actions_adddup2(&actions_, 1, 2);
    }
    ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
    FileActions(const FileActions&) = delete;
    FileActions& operator=(const FileActions&) = delete;

    const posix_spawn_file_actions_t* get() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_;
};

pid_t start(const std::vector<std::string>& command, const std::string& log) {
    std::vector<char*> words;
    words.reserve(command.size() + 1);
    for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    pid_t child = 0;
    const FileActions actions(log);
    const int failure =
        posix_spawnp(&child, words[0], actions.get(), nullptr, words.data(), environ);
    if (failure != 0) {
        throw Error("cannot start '" + command[0] + "' (" + std::strerror(failure) + ")",
                    "install it, and check that '" + log + "' can be written");
    }
    return child;
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

std::string lastLineOf(const std::string& path) {
    std::ifstream in(path);
    std::string last;
    for (std::string line; std::getline(in, line);) {
        if (line.find_first_not_of(" \r") != std::string::npos) last = line;
    }
    return last;
}

}  // namespace

ChildResult runChild(const std::vector<std::string>& command, const std::string& log) {
    const auto begin = std::chrono::steady_clock::now();
    const pid_t child = start(command, log);
    int status = 0;
    rusage usage{};
    while (wait4(child, &status, 0, &usage) < 0) {
        if (errno != EINTR) throw Error("lost track of '" + command[0] + "'");
    }
    ChildResult result;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    result.last_line = lastLineOf(log);
    return result;
}

}  // namespace rgbd_graphslam
