#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr const char* converter = "sm2mm";

/** Whether a program of that name is on the PATH. */
bool isInstalled(const std::string& program) {
    const char* const path = std::getenv("PATH");
    std::string folders = path ? path : "";
    for (std::size_t begin = 0; begin <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        const fs::path candidate = fs::path(folders.substr(begin, end - begin)) / program;
        if (fs::is_regular_file(candidate) && access(candidate.c_str(), X_OK) == 0) return true;
        begin = end + 1;
    }
    return false;
}

/** Without a shell: names of files are passed as they are.
 *  \return the exit code, 128 + signal when killed */
int run(const std::string& program, const std::string& input, const std::string& output) {
    const pid_t child = fork();
    if (child < 0) throw Error("cannot start " + program, "free some memory");
    if (child == 0) {
        dup2(STDERR_FILENO, STDOUT_FILENO);
        execlp(program.c_str(), program.c_str(), "-i", input.c_str(), "-o", output.c_str(),
               static_cast<char*>(nullptr));
        _exit(127);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class MetricMapExporter : public Exporter {
  public:
    const char* name() const override { return "mm"; }
    const char* about() const override { return "metric map of mp2p_icp and MOLA, by sm2mm"; }
    const char* fileName() const override { return "map.mm"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const fs::path source = fs::path(run_folder) / "map.simplemap";
        if (!fs::exists(source)) {
            throw Error("'" + run_folder + "' has no map.simplemap",
                        "make the maps with: rgbd-map " + run_folder);
        }
        if (!isInstalled(converter)) {
            throw Error(
                "the program sm2mm is not installed, which makes .mm files",
                "install the ROS package mp2p_icp (not part of Debian 12), then: sm2mm -i " +
                    source.string() + " -o " + path);
        }
        writeAtomically(path, [&](const std::string& temporary) {
            const int code = run(converter, source.string(), temporary);
            if (code != 0) {
                throw Error("sm2mm ended with code " + std::to_string(code), "see its messages");
            }
            return fs::exists(temporary);
        });
        return "metric map of map.simplemap";
    }
};

}  // namespace

std::unique_ptr<const Exporter> metricMapExporter() {
    return std::make_unique<MetricMapExporter>();
}

}  // namespace rgbd_graphslam
