/** Sequences of rgbd-synth for tests that run the real programs. They are filmed once a build
 * folder and kept there. */
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "run_program.h"

namespace rgbd_graphslam {

inline void runOrFail(const std::string& program, const std::string& arguments) {
    const ProgramResult result = runProgram(program, arguments);
    ASSERT_EQ(result.exit_code, 0) << program << " " << arguments << "\n" << result.err;
}

/** To be called from one executable only for each pair of arguments, as tests run in parallel.
 *  \param settings of rgbd-synth, e.g. "--frames 90"
 *  \return the sequence's folder; its rawlog lies beside it, with .rawlog appended */
inline std::string filmOf(const std::string& scenario, const std::string& settings) {
    std::string name = scenario + settings;
    for (char& c : name) c = c == ' ' ? '_' : c;
    const std::string folder = RGBD_BINARY_DIR "/synthetic/" + name, rawlog = folder + ".rawlog";
    if (std::filesystem::exists(rawlog)) return folder;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(std::filesystem::path(folder).parent_path());
    runOrFail("rgbd-synth", scenario + " '" + folder + "' -q " + settings);
    runOrFail("rgbd-import", "'" + folder + "' '" + rawlog + "' -q");
    return folder;
}

}  // namespace rgbd_graphslam
