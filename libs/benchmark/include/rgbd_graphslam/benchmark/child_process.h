/** Running another program and waiting for it. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** How a child process ended and what it cost. */
struct ChildResult {
    int exit_code = -1;  // 128 + signal when killed
    double wall_s = 0, cpu_s = 0;
    double peak_memory_mb = 0;
    /** The last line that is not empty of what it said, for people. */
    std::string last_line;

    bool good() const { return exit_code == 0; }
};

/** Runs a program without a shell; it reads nothing and what it says goes to a file.
 *  \param command program and arguments; a program without slash is looked up in PATH
 *  \throws Error when it cannot be started or `log` not be written */
ChildResult runChild(const std::vector<std::string>& command, const std::string& log);

}  // namespace rgbd_graphslam
