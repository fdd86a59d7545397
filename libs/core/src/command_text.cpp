#include "rgbd_graphslam/core/command_text.h"

#include <ctime>
#include <filesystem>
#include <fstream>

namespace rgbd_graphslam {
namespace {

constexpr const char* safe =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@%";

std::string quoted(std::string argument) {
    for (char& c : argument) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    if (!argument.empty() && argument.find_first_not_of(safe) == std::string::npos) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

}  // namespace

std::string shellLine(const std::vector<std::string>& arguments) {
    std::string line;
    for (const std::string& argument : arguments)
        line += (line.empty() ? "" : " ") + quoted(argument);
    return line;
}

std::string commandText() {
    std::ifstream in("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> arguments;
    std::string argument;
    while (std::getline(in, argument, '\0')) arguments.push_back(argument);
    if (arguments.empty()) return {};
    arguments.front() = std::filesystem::path(arguments.front()).filename().string();
    return shellLine(arguments);
}

std::string localTimeText() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    ::localtime_r(&now, &local);
    char text[64] = {};
    std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S %z", &local);
    return text;
}

}  // namespace rgbd_graphslam
