/** Runs the real programs, as a user does. */
#pragma once
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tum_folder.h"

namespace rgbd_graphslam {

struct ProgramResult {
    int exit_code = -1;  // 128 + signal when killed
    std::string out, err;
};

/** \param program one of ours, by name; \param arguments as typed into a shell */
inline ProgramResult runProgram(const std::string& program, const std::string& arguments) {
    const TestFolder folder;
    const std::string command = "'" RGBD_BINARY_DIR "/bin/" + program + "' " + arguments + " >'" +
                                folder / "out" + "' 2>'" + folder / "err" + "' </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            readText(folder / "out"), readText(folder / "err")};
}

}  // namespace rgbd_graphslam
