#include "list_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

bool isSeparator(char c) {
    return c == ',' || c == ';' || c == '\t' || c == '\r';
}

bool isDigit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** Of a word with a comma: two digits around its only one, and no point. */
bool isDecimalComma(const std::string& word) {
    const auto comma = word.find(',');
    return comma != std::string::npos && comma > 0 && comma + 1 < word.size() &&
           isDigit(word[comma - 1]) && isDigit(word[comma + 1]) &&
           word.find(',', comma + 1) == std::string::npos && word.find('.') == std::string::npos;
}

/** Of several words, the first one has a decimal comma, and so has each other with a comma. */
bool hasDecimalCommas(std::string text) {
    if (text.find(',') == std::string::npos) return false;
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c != ',' && isSeparator(c); }, ' ');
    std::istringstream words(text);
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
        const bool has_comma = word.find(',') != std::string::npos;
        if ((has_comma || count == 0) && !isDecimalComma(word)) return false;
    }
    return count > 1;
}

void skipByteOrderMark(const std::string& path, std::string& first_line) {
    if (first_line.compare(0, 3, "\xef\xbb\xbf") == 0) first_line.erase(0, 3);
    if (first_line.compare(0, 2, "\xff\xfe") == 0 || first_line.compare(0, 2, "\xfe\xff") == 0) {
        throw Error("'" + path + "' is UTF-16 text", "save it as UTF-8 or plain ASCII");
    }
}

}  // namespace

void Line::refuse(const std::string& why, const std::string& form) const {
    throw Error(path + ":" + std::to_string(number) + ": " + why,
                "each line must be '" + form + "'");
}

std::optional<double> numberIn(const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || *end || !std::isfinite(value)) return std::nullopt;
    return value;
}

double Line::realNumber(const std::string& form) {
    std::string word;
    if (!(words >> word)) refuse("too few values", form);
    const auto value = numberIn(word);
    if (!value) refuse("'" + word + "' is not a number", form);
    return *value;
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
        if (number == 1) skipByteOrderMark(path, text);
        text.erase(std::min(text.find('#'), text.size()));
        const bool decimal_commas = hasDecimalCommas(text);
        if (decimal_commas) std::replace(text.begin(), text.end(), ',', '.');
        std::replace_if(text.begin(), text.end(), isSeparator, ' ');
        if (text.find_first_not_of(' ') == std::string::npos) continue;
        Line line{path, number, std::istringstream(text), decimal_commas};
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
