/** What the command lines of all programs have in common. */
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace rgbd_graphslam {

/** Adds --quiet and --verbose, which set the process's verbosity, --version, and the hidden
 *  --print-man-page and --print-bash-completion, from which the build makes its files. Call it
 *  after all options and subcommands are declared. */
void declareCommonOptions(CLI::App& app);

/** Command lines that --help and the manual page show. */
void declareExamples(CLI::App& app, const std::vector<std::string>& commands);

/** Checks whose complaints a person can read: CLI11's own name the largest double there is, let -3
 *  pass for an unsigned number and `nan` for any. */
CLI::Validator finite();
CLI::Validator positive();
CLI::Validator notNegative();
CLI::Validator between(double low, double high);

/** A number that shows its default. \param check one of the above */
template <class Number>
CLI::Option* declareNumber(CLI::App& app, const std::string& option, Number& value,
                           const std::string& help, const CLI::Validator& check = finite()) {
    return app.add_option(option, value, help)->check(check)->capture_default_str();
}

/** An option whose value is one of a few names; the first is the default. */
template <class Value>
void declareChoice(CLI::App& app, const std::string& option, Value& value,
                   const std::vector<std::pair<std::string, Value>>& choices,
                   const std::string& help) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    const std::map<std::string, Value> value_of(choices.begin(), choices.end());
    app.add_option_function<std::string>(
           option, [&value, value_of](const std::string& name) { value = value_of.at(name); }, help)
        ->check(CLI::IsMember(names))
        ->type_name("NAME")
        ->default_str(names.front());
}

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
