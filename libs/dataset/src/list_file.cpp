#include "list_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;

void Line::refuse(const std::string& why, const std::string& form) const {
    throw Error(path + ":" + std::to_string(number) + ": " + why,
                "each line must be '" + form + "'");
}

double Line::realNumber(const std::string& form) {
    std::string word;
    if (!(words >> word)) refuse("too few values", form);
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end || !std::isfinite(value)) refuse("'" + word + "' is no number", form);
    return value;
}

std::string Line::rest() {
    std::string text;
    std::getline(words >> std::ws, text);
    text.erase(text.find_last_not_of(" \t\r") + 1);
    return text;
}

void forEachLine(const std::string& path, const std::function<void(Line&)>& use) {
    std::ifstream in(path);
    if (!in) throw Error("cannot read '" + path + "'", "check permissions");
    std::string text;
    for (int number = 1; std::getline(in, text); ++number) {
        text.erase(std::min(text.find('#'), text.size()));
        std::replace_if(
            text.begin(), text.end(), [](char c) { return c == ',' || c == '\t' || c == '\r'; },
            ' ');
        if (text.find_first_not_of(' ') == std::string::npos) continue;
        Line line{path, number, std::istringstream(text)};
        use(line);
    }
}

void checkSequenceFolder(const std::string& folder) {
    if (!fs::exists(folder)) throw Error("there is no folder '" + folder + "'", "check the name");
    if (!fs::is_directory(folder)) {
        throw Error("'" + folder + "' is not a folder", "give the folder that holds the sequence");
    }
    if (fs::is_empty(folder)) {
        throw Error("the folder '" + folder + "' is empty", "unpack the sequence into it");
    }
}

}  // namespace rgbd_graphslam
