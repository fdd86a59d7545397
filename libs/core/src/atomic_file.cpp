#include "rgbd_graphslam/core/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** With the machine's name, as processes of several machines may write to one folder. */
std::string temporaryPrefix() {
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    return std::string(".tmp-") + host + "-";
}

/** Whether it is a temporary file or folder of a process of this machine that is no more. */
bool isAbandoned(const std::string& name) {
    const std::string prefix = temporaryPrefix();
    if (name.rfind(prefix, 0) != 0) return false;
    const char* const number = name.c_str() + prefix.size();
    char* end = nullptr;
    const long process = std::strtol(number, &end, 10);
    return process > 0 && *end == '-' && kill(static_cast<pid_t>(process), 0) != 0 &&
           errno == ESRCH;
}

void removeAbandoned(const fs::path& folder) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (isAbandoned(entry.path().filename().string())) fs::remove_all(entry.path(), ignored);
    }
}

/** Some file systems report a full disk only here. */
bool flushToDisk(const std::string& path) {
    const int fd = open(path.c_str(), O_RDONLY);
    if (fd < 0) return false;
    const bool ok = fsync(fd) == 0;
    return close(fd) == 0 && ok;
}

class RemovedUnlessKept {
  public:
    explicit RemovedUnlessKept(std::string path) : path_(std::move(path)) {}
    ~RemovedUnlessKept() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove(path_, ignored);
    }
    void keep() { path_.clear(); }

  private:
    std::string path_;
};

}  // namespace

std::string temporaryName(const std::string& path) {
    const fs::path final_path(path);
    const std::string name =
        temporaryPrefix() + std::to_string(getpid()) + "-" + final_path.filename().string();
    return (final_path.parent_path() / name).string();
}

void writeAtomically(const std::string& path,
                     const std::function<bool(const std::string&)>& write) {
    const std::string temporary = temporaryName(path);
    RemovedUnlessKept guard(temporary);
    errno = 0;
    if (!write(temporary) || !flushToDisk(temporary)) {
        const std::string reason = errno ? std::string(" (") + std::strerror(errno) + ")" : "";
        throw Error("cannot write '" + path + "'" + reason,
                    "check free space and permissions of the folder");
    }
    std::error_code failure;
    fs::rename(temporary, path, failure);
    if (failure) throw Error("cannot rename to '" + path + "': " + failure.message());
    guard.keep();
}

void writeTextAtomically(const std::string& path, const std::string& text) {
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << text;
        out.close();
        return out.good();
    });
}

void makeWritableFolder(const std::string& path) {
    std::error_code failure;
    fs::create_directories(path, failure);
    if (failure || !fs::is_directory(path)) {
        throw Error(
            "cannot make the folder '" + path + "'" + (failure ? ": " + failure.message() : ""),
            "choose another output folder");
    }
    if (access(path.c_str(), W_OK) != 0) {
        throw Error("the folder '" + path + "' is not writable", "choose another output folder");
    }
    removeAbandoned(path);
}

}  // namespace rgbd_graphslam
