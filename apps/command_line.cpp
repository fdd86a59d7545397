#include "command_line.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <opencv2/core/utility.hpp>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

/** Prints a text in place of the program's work. */
void addPrinter(CLI::App& app, const std::string& option, std::string (*text)(const CLI::App&)) {
    app.add_flag_callback(option,
                          [&app, text] {
                              std::fputs(text(app).c_str(), stdout);
                              throw CLI::Success();
                          })
        ->group("")
        ->trigger_on_parse();
}

/** As typed, with its subcommand. */
std::string commandOf(const CLI::App& app) {
    std::string command = app.get_name();
    for (const auto* chosen : app.get_subcommands()) command += " " + chosen->get_name();
    return command;
}

/** Help and version come as exceptions, too; the library prints those. */
int endOfParsing(const CLI::App& app, const CLI::ParseError& end) {
    if (end.get_exit_code() == 0) return app.exit(end);
    std::string problem = end.what();
    const auto unknown = app.remaining(true);
    if (!unknown.empty()) problem = "'" + unknown.front() + "' is not understood here";
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    throw Error(problem, "see " + commandOf(app) + " --help");
}

}  // namespace

CLI::Validator positive() {
    const auto problem = [](const std::string& text) -> std::string {
        return std::atof(text.c_str()) > 0 ? "" : "'" + text + "' is not above 0";
    };
    return CLI::Validator(problem, "");
}

CLI::Validator notNegative() {
    const auto problem = [](const std::string& text) -> std::string {
        return std::atof(text.c_str()) >= 0 ? "" : "'" + text + "' is below 0";
    };
    return CLI::Validator(problem, "");
}

void declareCommonOptions(CLI::App& app) {
    app.add_flag_callback(
        "-q,--quiet", [] { setVerbosity(Verbosity::Quiet); }, "Only errors and results");
    app.add_flag_callback(
        "-v,--verbose", [] { setVerbosity(Verbosity::Verbose); }, "Say more");
    app.set_version_flag("--version", RGBD_VERSION);
    addPrinter(app, "--print-man-page", manPage);
    addPrinter(app, "--print-bash-completion", bashCompletion);
}

int runProgram(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
    cv::setNumThreads(1);  // the threads are ours; OpenCV's own would spin between two images
    return runMain(app.get_name(), [&] {
        try {
            app.parse(argc, argv);
        } catch (const CLI::ParseError& end) {
            return endOfParsing(app, end);
        }
        return body ? body() : 0;
    });
}

}  // namespace rgbd_graphslam
