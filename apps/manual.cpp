/** Manual pages and completions, written from the options that a program declares. */
#include <algorithm>
#include <cctype>

#include "command_line.h"

namespace rgbd_graphslam {
namespace {

constexpr const char* exit_status =
    ".SH EXIT STATUS\n0 when all went well; otherwise 1, or as said above, after one line that "
    "says what is wrong and what to do about it.\n";

bool isShown(const CLI::Option* option) {
    return !option->get_group().empty();
}

bool isShown(const CLI::App* command) {
    return !command->get_name().empty() && !command->get_group().empty();
}

std::vector<const CLI::Option*> shownOptions(const CLI::App& app, bool positional) {
    return app.get_options([positional](const CLI::Option* option) {
        return isShown(option) && option->get_positional() == positional;
    });
}

std::vector<const CLI::App*> shownCommands(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* command) { return isShown(command); });
}

std::string upperCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/** A text that roff prints as it is. */
std::string roff(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '\\') {
            escaped += "\\e";
        } else if (c == '-') {
            escaped += "\\-";
        } else if (c == '\n') {
            escaped += "\n.br\n";
        } else if ((c == '.' || c == '\'') && (escaped.empty() || escaped.back() == '\n')) {
            escaped += std::string("\\&") + c;
        } else {
            escaped += c;
        }
    }
    return escaped;
}

std::string entryOf(const CLI::Option* option, bool positional) {
    const CLI::Formatter formatter;
    return ".TP\n\\fB" + roff(formatter.make_option_name(option, positional)) + "\\fR" +
           roff(formatter.make_option_opts(option)) + "\n" +
           roff(formatter.make_option_desc(option)) + "\n";
}

std::string entriesOf(const CLI::App& app) {
    std::string text;
    for (const auto* option : shownOptions(app, true)) text += entryOf(option, true);
    for (const auto* option : shownOptions(app, false)) text += entryOf(option, false);
    return text;
}

std::string synopsisOf(const CLI::App& app) {
    std::string text = "\\fB" + roff(app.get_name()) + "\\fR";
    if (!shownCommands(app).empty()) text += " COMMAND";
    text += " [OPTIONS]";
    for (const auto* option : shownOptions(app, true)) {
        const std::string name = roff(option->get_name(true));
        text += option->get_required() ? " " + name : " [" + name + "]";
    }
    return text + "\n";
}

/** What can be typed next: subcommands and options. */
std::string wordsOf(const CLI::App& app) {
    std::string words;
    for (const auto* command : shownCommands(app)) words += command->get_name() + " ";
    for (const auto* option : shownOptions(app, false)) {
        for (const auto& name : option->get_lnames()) words += "--" + name + " ";
    }
    return words;
}

}  // namespace

std::string manPage(const CLI::App& app) {
    const std::string& name = app.get_name();
    std::string text = ".TH " + upperCase(roff(name)) + " 1 \"\" \"rgbd\\-graphslam " +
                       RGBD_VERSION "\" \"User Commands\"\n";
    text += ".SH NAME\n" + roff(name) + " \\- " + roff(app.get_description()) + "\n";
    text += ".SH SYNOPSIS\n" + synopsisOf(app) + ".SH OPTIONS\n" + entriesOf(app);
    if (!shownCommands(app).empty()) text += ".SH COMMANDS\n";
    for (const auto* command : shownCommands(app)) {
        text += ".SS " + synopsisOf(*command) + roff(command->get_description()) + "\n" +
                entriesOf(*command);
    }
    if (const std::string examples = app.get_footer(); !examples.empty()) {
        text += ".SH EXAMPLES\n" + roff(examples.substr(examples.find('\n') + 1)) + "\n";
    }
    return text + exit_status;
}

std::string bashCompletion(const CLI::App& app) {
    const std::string& name = app.get_name();
    std::string function = "_" + name;
    std::replace(function.begin(), function.end(), '-', '_');
    std::string text = function + "() {\n    local cur=${COMP_WORDS[COMP_CWORD]} words\n" +
                       "    case ${COMP_WORDS[1]} in\n";
    for (const auto* command : shownCommands(app)) {
        text += "        " + command->get_name() + ") words='" + wordsOf(*command) + "' ;;\n";
    }
    text += "        *) words='" + wordsOf(app) + "' ;;\n    esac\n";
    const bool commands = !shownCommands(app).empty();
    text += "    COMPREPLY=()\n    if [[ $cur == -*" +
            std::string(commands ? " || $COMP_CWORD -eq 1" : "") + " ]]; then\n";
    text += "        COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n    fi\n}\n";
    return text + "complete -o default -F " + function + " " + name + "\n";
}

}  // namespace rgbd_graphslam
