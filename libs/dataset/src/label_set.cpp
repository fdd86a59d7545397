#include "rgbd_graphslam/dataset/label_set.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/ini_formulas.h"
#include "rgbd_graphslam/core/input_file.h"

namespace rgbd_graphslam {
namespace {

const char* const names_remedy = "write a section [1] to [65535] for each class, with its name";
const char* const section_line = "[label_names]";

/** Colors of values that follow each other lie far apart: the golden ratio divides the circle of
 *  hues. */
std::array<std::uint8_t, 3> usualColor(int label) {
    const double hue = 6 * std::fmod(0.618034 * label, 1.0);
    const auto channel = [&](double offset) {
        const double h = std::fmod(offset + hue, 6.0);
        const double share = std::min(1.0, std::max(0.0, std::min(h, 4 - h)));
        return static_cast<std::uint8_t>(std::lround(55 + 200 * (1 - share)));
    };
    return {channel(5), channel(3), channel(1)};
}

int labelOf(const std::string& section, const std::string& name) {
    std::size_t used = 0;
    int label = 0;
    try {
        label = std::stoi(section, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used == section.size() && label >= 1 && label <= largest_label) return label;
    throw Error(name + ": section '[" + section + "]' names no value of a label image",
                names_remedy);
}

LabelName readClass(const mrpt::config::CConfigFileMemory& ini, const std::string& section,
                    int label, const std::string& name) {
    LabelName found{ini.read_string(section, "name", ""), usualColor(label)};
    if (found.name.empty()) {
        throw Error(name + ": section '[" + section + "]' has no name", "add a line name = ...");
    }
    std::vector<int> rgb;
    ini.read_vector(section, "color", {}, rgb);
    if (rgb.empty()) return found;
    for (const int channel : rgb) {
        if (rgb.size() == 3 && channel >= 0 && channel <= 255) continue;
        throw Error(name + ": color of section '[" + section + "]' is no color",
                    "write color = [R G B], each from 0 to 255");
    }
    for (std::size_t i = 0; i < 3; ++i) found.rgb[i] = static_cast<std::uint8_t>(rgb[i]);
    return found;
}

}  // namespace

LabelSet labelSetFromIni(const std::string& text, const std::string& name) {
    refuseFormulas(text, name);
    mrpt::config::CConfigFileMemory ini;
    try {
        ini.setContent(text);
    } catch (const std::exception&) {
        throw Error(name + " is no ini file", names_remedy);
    }
    LabelSet labels;
    std::vector<std::string> sections;
    ini.getAllSections(sections);
    for (const std::string& section : sections) {
        if (section.empty()) continue;
        const int label = labelOf(section, name);
        labels[label] = readClass(ini, section, label, name);
    }
    return labels;
}

LabelSet readLabelSet(const std::string& path) {
    return labelSetFromIni(readTextFile(path, "a list of class names", names_remedy),
                           "'" + path + "'");
}

std::string toComment(const LabelSet& labels) {
    std::string text = section_line;
    for (const auto& [label, of] : labels) {
        text += formatted("\n%d = %d %d %d %s", label, of.rgb[0], of.rgb[1], of.rgb[2],
                          of.name.c_str());
    }
    return text + "\n";
}

LabelSet labelsIn(const std::string& comment) {
    LabelSet labels;
    std::istringstream lines(comment);
    bool is_ours = false;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line[0] == '[') is_ours = line == section_line;
        int label = 0, r = 0, g = 0, b = 0, name_at = 0;
        const bool fits =
            std::sscanf(line.c_str(), "%d = %d %d %d %n", &label, &r, &g, &b, &name_at) == 4;
        if (!is_ours || !fits || name_at == 0 || label < 1 || label > largest_label) continue;
        const auto channel = [](int v) { return static_cast<std::uint8_t>(std::clamp(v, 0, 255)); };
        labels[label] = {line.substr(static_cast<std::size_t>(name_at)),
                         {channel(r), channel(g), channel(b)}};
    }
    return labels;
}

std::set<int> labelsNamed(const LabelSet& labels, const std::string& words) {
    std::set<int> named;
    std::istringstream stream(words);
    for (std::string word; stream >> word;) {
        for (const auto& [label, of] : labels) {
            if (of.name == word) named.insert(label);
        }
    }
    return named;
}

std::string nameOf(const LabelSet& labels, int label) {
    const auto found = labels.find(label);
    return found == labels.end() ? "class " + std::to_string(label) : found->second.name;
}

}  // namespace rgbd_graphslam
