#include "tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace rgbd_graphslam {
namespace {

std::string valueText(const Figure& figure) {
    if (!std::isfinite(figure.value)) return "none";
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", figure.decimals, figure.value);
    return text;
}

std::string padded(std::string text, std::size_t width) {
    text.insert(0, width - std::min(width, text.size()), ' ');
    return text;
}

/** Lines of a column for one estimate: its name, then its values. */
std::vector<std::string> columnOf(const Report& report) {
    std::vector<std::string> lines{report.name};
    for (const auto& figure : report.figures) lines.push_back(valueText(figure));
    return lines;
}

std::size_t widthOf(const std::vector<std::string>& lines) {
    std::size_t width = 0;
    for (const auto& line : lines) width = std::max(width, line.size());
    return width;
}

/** As the TUM tools print it. */
std::string textLines(const Report& report) {
    std::string text;
    for (const auto& figure : report.figures) {
        const std::string unit = figure.unit.empty() ? "" : " " + figure.unit;
        text += figure.name + " " + valueText(figure) + unit + "\n";
    }
    return text;
}

std::string quotedForCsv(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string csvHeading(const Figure& figure) {
    return figure.name + (figure.unit.empty() ? "" : " [" + figure.unit + "]");
}

std::string escapedForLatex(const std::string& text) {
    static const std::map<char, std::string> escapes = {{'_', "\\_"},
                                                        {'%', "\\%"},
                                                        {'&', "\\&"},
                                                        {'#', "\\#"},
                                                        {'$', "\\$"},
                                                        {'{', "\\{"},
                                                        {'}', "\\}"},
                                                        {'~', "\\textasciitilde{}"},
                                                        {'^', "\\textasciicircum{}"},
                                                        {'\\', "\\textbackslash{}"}};
    std::string escaped;
    for (const char c : text) {
        const auto escape = escapes.find(c);
        escaped += escape == escapes.end() ? std::string(1, c) : escape->second;
    }
    return escaped;
}

/** "absolute_translational_error.rmse" in words. */
std::string latexHeading(const Figure& figure) {
    std::string words = figure.name;
    std::replace(words.begin(), words.end(), '_', ' ');
    std::replace(words.begin(), words.end(), '.', ' ');
    return words + (figure.unit.empty() ? "" : " (" + figure.unit + ")");
}

nlohmann::ordered_json jsonOf(const Report& report) {
    nlohmann::ordered_json object{{"name", report.name}};
    for (const auto& figure : report.figures) {
        auto& entry = object["figures"][figure.name];
        if (figure.decimals == 0) {
            entry["value"] = std::llround(figure.value);
        } else {
            entry["value"] = figure.value;  // null when not finite
        }
        if (!figure.unit.empty()) entry["unit"] = figure.unit;
    }
    return object;
}

}  // namespace

std::string textTable(const std::vector<Report>& reports) {
    if (reports.size() == 1) return textLines(reports.front());
    std::vector<std::string> names{""}, units{""};
    for (const auto& figure : reports.front().figures) {
        names.push_back(figure.name);
        units.push_back(figure.unit);
    }
    std::vector<std::string> lines(names.size());
    const std::size_t name_width = widthOf(names);
    for (std::size_t k = 0; k < lines.size(); ++k) {
        lines[k] = names[k] + std::string(name_width - names[k].size(), ' ');
    }
    for (const auto& report : reports) {
        const auto column = columnOf(report);
        const std::size_t width = widthOf(column);
        for (std::size_t k = 0; k < lines.size(); ++k) lines[k] += "  " + padded(column[k], width);
    }
    std::string text;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        text += lines[k] + (units[k].empty() ? "" : " " + units[k]) + "\n";
    }
    return text;
}

std::string csvTable(const std::vector<Report>& reports) {
    std::string text = "name";
    for (const auto& figure : reports.front().figures) text += "," + csvHeading(figure);
    text += "\n";
    for (const auto& report : reports) {
        text += quotedForCsv(report.name);
        for (const auto& figure : report.figures) text += "," + valueText(figure);
        text += "\n";
    }
    return text;
}

std::string jsonTable(const std::vector<Report>& reports) {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const auto& report : reports) array.push_back(jsonOf(report));
    return array.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string latexTable(const std::vector<Report>& reports) {
    std::string text = "\\begin{tabular}{l" + std::string(reports.size(), 'r') + "}\n\\toprule\n";
    for (const auto& report : reports) text += " & " + escapedForLatex(report.name);
    text += " \\\\\n\\midrule\n";
    const auto& figures = reports.front().figures;
    for (std::size_t k = 0; k < figures.size(); ++k) {
        text += latexHeading(figures[k]);
        for (const auto& report : reports) text += " & " + valueText(report.figures[k]);
        text += " \\\\\n";
    }
    return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace rgbd_graphslam
