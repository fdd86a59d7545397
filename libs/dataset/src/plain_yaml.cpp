#include "plain_yaml.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include "list_file.h"

namespace rgbd_graphslam {
namespace {

using Json = nlohmann::json;
constexpr int deepest_list = 8;
constexpr const char* blanks = " \t\r";

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string withoutComment(const std::string& line) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
            return line.substr(0, i);
        }
    }
    return line;
}

Json scalar(const std::string& text) {
    if (const auto number = numberIn(text)) return *number;
    const bool quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'') &&
                        text.back() == text.front();
    return quoted ? text.substr(1, text.size() - 2) : text;
}

/** \param at just behind the opening bracket; behind the closing one afterwards */
Json listIn(const std::string& text, std::size_t& at, int depth) {
    Json list = Json::array();
    if (depth > deepest_list) return list;
    std::string word;
    const auto finishWord = [&] {
        if (!trimmed(word).empty()) list.push_back(scalar(trimmed(word)));
        word.clear();
    };
    while (at < text.size()) {
        const char c = text[at++];
        if (c == '[') {
            list.push_back(listIn(text, at, depth + 1));
        } else if (c == ']') {
            break;
        } else if (c == ',') {
            finishWord();
        } else {
            word += c;
        }
    }
    finishWord();
    return list;
}

Json valueOf(const std::string& text) {
    if (text.empty() || text[0] != '[') return scalar(text);
    std::size_t at = 1;
    return listIn(text, at, 0);
}

/** Lists that a line opens more than it closes. */
int openLists(const std::string& line) {
    return static_cast<int>(std::count(line.begin(), line.end(), '[') -
                            std::count(line.begin(), line.end(), ']'));
}

/** Where a key ends; npos when the line has none. */
std::size_t colonOf(const std::string& line) {
    const auto colon = line.find(": ");
    if (colon != std::string::npos) return colon;
    return !line.empty() && line.back() == ':' ? line.size() - 1 : std::string::npos;
}

class Parser {
  public:
    Json parse(const std::string& text) {
        levels_.push_back({-1, &root_});
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) {
            line = withoutComment(line);
            if (trimmed(line).empty() || line[0] == '%' || line.compare(0, 3, "---") == 0) continue;
            int open = openLists(line);
            for (std::string more; open > 0 && std::getline(in, more);) {
                more = withoutComment(more);
                open += openLists(more);
                line += " " + more;
            }
            take(static_cast<int>(line.find_first_not_of(' ')), trimmed(line));
        }
        return root_;
    }

  private:
    struct Level {
        int indent;
        Json* map;
    };

    void take(int indent, const std::string& line) {
        if (line.compare(0, 2, "- ") == 0) {
            takeItem(trimmed(line.substr(2)));
            return;
        }
        const auto colon = colonOf(line);
        if (colon == std::string::npos) return;
        while (levels_.size() > 1 && levels_.back().indent >= indent) levels_.pop_back();
        if (open_ && indent > open_indent_ && open_->is_null()) {
            *open_ = Json::object();
            levels_.push_back({open_indent_, open_});
        }
        const std::string value = trimmed(line.substr(colon + 1));
        const Json key = scalar(trimmed(line.substr(0, colon)));
        Json& entry = (*levels_.back().map)[key.is_string() ? key.get<std::string>() : key.dump()];
        const bool opens = value.empty() || value[0] == '!';
        entry = opens ? Json() : valueOf(value);
        open_ = opens ? &entry : nullptr;
        open_indent_ = indent;
    }

    void takeItem(const std::string& value) {
        if (!open_ || colonOf(value) != std::string::npos) return;
        if (open_->is_null()) *open_ = Json::array();
        if (open_->is_array()) open_->push_back(valueOf(value));
    }

    Json root_ = Json::object();
    std::vector<Level> levels_;
    Json* open_ = nullptr;
    int open_indent_ = -1;
};

}  // namespace

nlohmann::json parsePlainYaml(const std::string& text) {
    return Parser().parse(text);
}

}  // namespace rgbd_graphslam
