#include "command_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
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
    const std::string conversion = "Could not convert: ";
    if (problem.rfind(conversion, 0) == 0) {
        problem = "cannot read '" + problem.substr(conversion.size()) + "'";
    }
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    throw Error(problem, "see " + commandOf(app) + " --help");
}

/** Prints `[FILE]` where CLI11 would print `[FILE(1x)]` for a positional argument that may be given
 *  more than once. */
class UsageFormatter : public CLI::Formatter {
  public:
    std::string make_option_usage(const CLI::Option* option) const override {
        if (option->get_expected_max() >= CLI::detail::expected_max_vector_size) {
            return Formatter::make_option_usage(option);
        }
        const std::string name = make_option_name(option, true);
        return option->get_required() ? name : "[" + name + "]";
    }
};

/** What the value of an option is, by its name: the library's own names of types, TEXT, INT and
 *  FLOAT, are those of programmers. */
std::string valueName(const CLI::Option& option, const std::string& type) {
    static const std::map<std::string, std::string> known{{"out", "DIR"},
                                                          {"output", "DIR"},
                                                          {"rawlog", "FILE"},
                                                          {"trajectory", "FILE"},
                                                          {"surface", "FILE"},
                                                          {"estimate", "FILE"},
                                                          {"truth", "FILE"},
                                                          {"plot", "FILE"},
                                                          {"plot-errors", "FILE"},
                                                          {"config", "FILE"},
                                                          {"table", "FILE"},
                                                          {"pairs", "FILE"},
                                                          {"camera", "NAME|FILE"},
                                                          {"only", "I/N"},
                                                          {"screenshot", "FILE"},
                                                          {"snapshot", "FILE"},
                                                          {"movers", "FILE"},
                                                          {"register", "FILE"},
                                                          {"azimuth", "DEGREES"},
                                                          {"elevation", "DEGREES"},
                                                          {"width", "PIXELS"},
                                                          {"height", "PIXELS"},
                                                          {"texture-size", "PIXELS"},
                                                          {"benchmark", "SECONDS"},
                                                          {"depth-offset", "SECONDS"},
                                                          {"rate", "PER_SECOND"},
                                                          {"max-depth", "METERS"},
                                                          {"beyond", "METERS"},
                                                          {"set", "SECTION.KEY=VALUE"},
                                                          {"goal", "X,Y"},
                                                          {"start", "X,Y,PHI"},
                                                          {"size", "WIDTHxHEIGHT"},
                                                          {"grid", "METERS"},
                                                          {"octree", "METERS"},
                                                          {"points", "METERS"},
                                                          {"mesh", "METERS"},
                                                          {"z-min", "METERS"},
                                                          {"z-max", "METERS"},
                                                          {"voxel", "METERS"},
                                                          {"tolerance", "METERS"},
                                                          {"max-range", "METERS"},
                                                          {"complete-within", "METERS"},
                                                          {"max-incidence", "DEGREES"},
                                                          {"registration-error", "PIXELS"},
                                                          {"offset", "SECONDS"},
                                                          {"max-difference", "SECONDS"},
                                                          {"from", "SECONDS"},
                                                          {"to", "SECONDS"},
                                                          {"plot-distribution", "FILE"},
                                                          {"scans", "PER_SECOND"},
                                                          {"depth-units", "PER_METER"}};
    for (const std::string& name : option.get_lnames()) {
        const auto found = known.find(name);
        if (found != known.end()) return found->second;
    }
    if (type == "INT" || type == "UINT") return "N";
    return type == "FLOAT" ? "NUMBER" : "VALUE";
}

void nameValues(CLI::App& app) {
    for (CLI::Option* option : app.get_options({})) {
        const std::string type = option->get_type_name();
        const bool positional = option->get_lnames().empty() && option->get_snames().empty();
        if (positional && type == "TEXT") option->type_name("");
        if (type == "TEXT" || type == "INT" || type == "UINT" || type == "FLOAT") {
            if (!positional) option->type_name(valueName(*option, type));
        }
    }
    for (CLI::App* command : app.get_subcommands({})) nameValues(*command);
}

/** Words that are no numbers at all are left to the conversion. */
CLI::Validator numberThat(const std::function<bool(double)>& holds, const std::string& problem) {
    const auto complaint = [=](const std::string& text) -> std::string {
        const double number = std::atof(text.c_str());
        if (!std::isfinite(number)) return "'" + text + "' is not a finite number";
        return holds(number) ? "" : "'" + text + "' " + problem;
    };
    return CLI::Validator(complaint, "");
}

}  // namespace

CLI::Validator finite() {
    return numberThat([](double) { return true; }, "is not a number");
}

CLI::Validator positive() {
    return numberThat([](double number) { return number > 0; }, "is not above 0");
}

CLI::Validator notNegative() {
    return numberThat([](double number) { return number >= 0; }, "is below 0");
}

CLI::Validator between(double low, double high) {
    char problem[80];
    std::snprintf(problem, sizeof problem, "is not from %g to %g", low, high);
    return numberThat([=](double number) { return number >= low && number <= high; }, problem);
}

void declareCommonOptions(CLI::App& app) {
    nameValues(app);
    app.formatter(std::make_shared<UsageFormatter>());
    app.add_flag_callback(
        "-q,--quiet", [] { setVerbosity(Verbosity::Quiet); }, "Print only errors and results");
    app.add_flag_callback(
        "-v,--verbose", [] { setVerbosity(Verbosity::Verbose); }, "Print more details");
    app.set_version_flag("--version", RGBD_VERSION);
    addPrinter(app, "--print-man-page", manPage);
    addPrinter(app, "--print-bash-completion", bashCompletion);
}

void declareExamples(CLI::App& app, const std::vector<std::string>& commands) {
    std::string text = commands.size() > 1 ? "Examples:" : "Example:";
    for (const std::string& command : commands) text += "\n  " + command;
    app.footer(text);
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
