/** What the command lines of all programs have in common. */
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace rgbd_graphslam {

/** Adds --quiet and --verbose, which set the process's verbosity, --version, and the hidden
 *  --print-man-page and --print-bash-completion, from which the build makes its files. Call it
 *  after all options and subcommands are declared. */
void declareCommonOptions(CLI::App& app);

/** Parses the command line and runs the program's body (a program of subcommands has its bodies in
 *  their callbacks and none here). What is wrong with the usage is one line on stderr, as any other
 *  error is.
 *  \return the exit code */
int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body = {});

/** The program's manual page, in roff. */
std::string manPage(const CLI::App& app);

/** A bash script that completes the program's options and subcommands. */
std::string bashCompletion(const CLI::App& app);

}  // namespace rgbd_graphslam
