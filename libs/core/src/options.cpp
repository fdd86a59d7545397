#include "rgbd_graphslam/core/options.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/ini_formulas.h"
#include "rgbd_graphslam/core/input_file.h"

namespace rgbd_graphslam {
namespace {

std::string trimmed(const std::string& text) {
    const char* blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string withoutComment(const std::string& line) {
    const std::string text = trimmed(line);
    if (text.empty() || text[0] == ';' || text[0] == '#') return {};
    return trimmed(text.substr(0, text.find("//")));
}

std::string sectionName(const std::string& line) {
    const bool is_section = line.size() > 2 && line.front() == '[' && line.back() == ']';
    return is_section ? trimmed(line.substr(1, line.size() - 2)) : std::string{};
}

/** People forget the ini before the rawlog, whose bytes do not belong on a terminal. */
void checkIsText(const std::string& text, const std::string& name) {
    const auto is_foreign = [](unsigned char c) { return c < ' ' && !std::isspace(c); };
    if (std::none_of(text.begin(), text.end(), is_foreign)) return;
    throw Error("'" + name + "' is not a text file", "name an ini file here");
}

/** MRPT's parser skips lines that it does not understand and forgets where a key stood; this pass
 *  finds both. */
std::map<std::string, std::string> locateKeys(const std::string& text, const std::string& name) {
    std::map<std::string, std::string> origins;
    std::istringstream lines(text);
    std::string raw, section;
    for (int number = 1; std::getline(lines, raw); ++number) {
        const std::string line = withoutComment(raw);
        const std::string origin = name + ":" + std::to_string(number);
        if (line.empty()) continue;
        if (const std::string found = sectionName(line); !found.empty()) {
            section = found;
            continue;
        }
        const auto equals = line.find('=');
        const std::string key = trimmed(line.substr(0, equals));
        if (equals == std::string::npos || key.empty() || section.empty()) {
            throw Error(origin + ": '" + line + "' is neither '[Section]' nor 'key = value'",
                        "mend or remove the line");
        }
        if (!origins.emplace(section + "." + key, origin).second) {
            throw Error(origin + ": '" + key + "' is set twice in [" + section + "]",
                        "keep one of the two");
        }
    }
    return origins;
}

/** Fills each visited field from the entries of one section and notes which keys are known. */
class Loader : public OptionVisitor {
  public:
    using Lookup = std::function<const std::string*(const std::string& key, std::string& origin)>;
    explicit Loader(Lookup lookup) : lookup_(std::move(lookup)) {}

    void real(const char* key, double& value, double min, double max, const char* unit,
              const char*) override {
        assignNumber(key, value, min, max, unit, false);
    }
    void integer(const char* key, int& value, int min, int max, const char* unit,
                 const char*) override {
        double number = value;
        assignNumber(key, number, min, max, unit, true);
        value = static_cast<int>(number);
    }
    void flag(const char* key, bool& value, const char*) override {
        std::string word = value ? "true" : "false";
        assignWord(key, word, {"true", "false", "1", "0", "yes", "no"});
        value = word == "true" || word == "1" || word == "yes";
    }
    void choice(const char* key, std::string& value, const std::vector<std::string>& allowed,
                const char*) override {
        assignWord(key, value, allowed);
    }
    void renamed(const char* old_key, const char* key) override {
        old_keys_[key] = old_key;
        renamed_.emplace_back(old_key);
    }
    const std::vector<std::string>& renamed() const { return renamed_; }
    const std::vector<std::string>& keys() const { return keys_; }

  private:
    void assignNumber(const char* key, double& value, double min, double max, const char* unit,
                      bool whole) {
        std::string origin;
        const std::string* text = find(key, origin);
        if (!text) return;
        char* end = nullptr;
        const double number = std::strtod(text->c_str(), &end);
        const bool complete = !text->empty() && *end == '\0' && std::isfinite(number);
        if (complete && number >= min && number <= max &&
            (!whole || number == std::floor(number))) {
            value = number;
            return;
        }
        std::ostringstream range;
        range << "give a " << (whole ? "whole number" : "number") << " from " << min << " to "
              << max << (*unit ? " " : "") << unit;
        throw Error(origin + ": " + key + " = '" + *text + "' cannot be used", range.str());
    }
    void assignWord(const char* key, std::string& value, const std::vector<std::string>& allowed) {
        std::string origin;
        const std::string* text = find(key, origin);
        if (!text) return;
        const bool is_any = allowed.empty();
        if (!is_any && std::find(allowed.begin(), allowed.end(), *text) == allowed.end()) {
            std::string list;
            for (const auto& word : allowed) list += (list.empty() ? "" : "|") + word;
            throw Error(origin + ": " + key + " = '" + *text + "' cannot be used", "give " + list);
        }
        value = *text;
    }
    const std::string* find(const char* key, std::string& origin) {
        keys_.emplace_back(key);
        const auto old_key = old_keys_.find(key);
        if (old_key == old_keys_.end()) return lookup_(key, origin);
        std::string old_origin;
        const std::string* old_text = lookup_(old_key->second, old_origin);
        const std::string* text = lookup_(key, origin);
        if (!old_text) return text;
        if (text) {
            throw Error(old_origin + ": '" + old_key->second + "' and its new name '" + key +
                            "' are both set",
                        "keep '" + std::string(key) + "'");
        }
        origin = old_origin;
        sayInfo(origin + ": '" + old_key->second + "' is now called '" + key +
                "'; the next version will not know the old name");
        return old_text;
    }

    Lookup lookup_;
    std::vector<std::string> keys_, renamed_;
    std::map<std::string, std::string> old_keys_;  // by the new one
};

/** Writes each visited field as "key = value  // [unit] help". */
class Printer : public OptionVisitor {
  public:
    void real(const char* key, double& value, double min, double max, const char* unit,
              const char* help) override {
        std::ostringstream range;
        range << min << " to " << max;
        line(key, shortest(value),
             std::string("[") + unit + (*unit ? ", " : "") + range.str() + "] " + help);
    }
    void integer(const char* key, int& value, int min, int max, const char* unit,
                 const char* help) override {
        const std::string range = std::to_string(min) + " to " + std::to_string(max);
        line(key, std::to_string(value),
             std::string("[") + unit + (*unit ? ", " : "") + range + "] " + help);
    }
    void flag(const char* key, bool& value, const char* help) override {
        line(key, value ? "true" : "false", std::string("[true|false] ") + help);
    }
    void choice(const char* key, std::string& value, const std::vector<std::string>& allowed,
                const char* help) override {
        std::string list;
        for (const auto& word : allowed) list += (list.empty() ? "" : "|") + word;
        line(key, value, list.empty() ? help : "[" + list + "] " + help);
    }
    std::ostringstream out;

  private:
    /** Fewest digits that read back to the same value. */
    static std::string shortest(double value) {
        char text[32];
        for (int digits = 6; digits <= 17; ++digits) {
            std::snprintf(text, sizeof(text), "%.*g", digits, value);
            if (std::strtod(text, nullptr) == value) break;
        }
        return text;
    }
    void line(const char* key, const std::string& value, const std::string& comment) {
        const std::string assignment = std::string(key) + " = " + value;
        const std::size_t column = 40;
        out << assignment
            << std::string(std::max<std::size_t>(1, column - std::min(column, assignment.size())),
                           ' ')
            << "// " << comment << "\n";
    }
};

std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row[b.size()];
}

/** A name is taken for a misspelt one when it differs in at most a third of its letters, or in two,
 *  as transposed ones do. */
std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    if (known.empty()) return "remove it";
    const auto best =
        std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
            return editDistance(word, a) < editDistance(word, b);
        });
    const std::size_t longer = std::max(word.size(), best->size());
    if (editDistance(word, *best) > std::max<std::size_t>(longer < 5 ? 1 : 2, longer / 3)) {
        return "remove it; rgbd-slam --print-config lists all keys";
    }
    return "remove it, or did you mean '" + *best + "'?";
}

}  // namespace

IniFile IniFile::fromFile(const std::string& path) {
    refuseFolder(path, "an ini file");
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in) throw Error("cannot read the ini file '" + path + "'", "check the name");
    return fromText(text.str(), path);
}

IniFile IniFile::fromText(const std::string& text, const std::string& name) {
    checkIsText(text, name);
    refuseFormulas(text, name);
    const auto origins = locateKeys(text, name);
    mrpt::config::CConfigFileMemory mrpt_ini;
    try {
        mrpt_ini.setContent(text);
    } catch (const std::exception& e) {  // MRPT's variables
        throw Error("'" + name + "': " + e.what(), "mend or remove the line");
    }
    IniFile ini;
    for (const auto& [path, origin] : origins) {
        const auto dot = path.find('.');
        const std::string section = path.substr(0, dot), key = path.substr(dot + 1);
        std::string value = trimmed(mrpt_ini.read_string(section, key, ""));
        if (value.rfind("//", 0) == 0) value.clear();  // MRPT takes it for the value of an empty key
        ini.sections_[section][key] = {value, origin};
    }
    return ini;
}

void IniFile::override(const std::string& assignment) {
    const auto equals = assignment.find('=');
    const auto dot = assignment.find('.');
    if (dot == std::string::npos || equals == std::string::npos || dot > equals) {
        throw Error("--set '" + assignment + "' is malformed", "write --set Section.key=value");
    }
    const std::string section = trimmed(assignment.substr(0, dot));
    const std::string key = trimmed(assignment.substr(dot + 1, equals - dot - 1));
    sections_[section][key] = {trimmed(assignment.substr(equals + 1)), "--set " + assignment};
}

void IniFile::loadKnown(const std::vector<Options*>& structs) const {
    for (Options* options : structs) {
        const auto section = sections_.find(options->section());
        if (section == sections_.end()) continue;
        const auto& entries = section->second;
        Loader loader([&](const std::string& key, std::string& origin) -> const std::string* {
            const auto entry = entries.find(key);
            if (entry == entries.end()) return nullptr;
            origin = entry->second.origin;
            return &entry->second.value;
        });
        options->describe(loader);
        std::set<std::string> keys(loader.keys().begin(), loader.keys().end());
        keys.insert(loader.renamed().begin(), loader.renamed().end());
        for (const auto& [key, entry] : entries) {
            if (keys.count(key)) continue;
            throw Error(entry.origin + ": unknown key '" + key + "' in [" + section->first + "]",
                        nearest(key, loader.keys()));
        }
    }
}

void IniFile::load(const std::vector<Options*>& structs) const {
    loadKnown(structs);
    std::vector<std::string> known_sections;
    known_sections.reserve(structs.size());
    for (const Options* options : structs) known_sections.emplace_back(options->section());
    for (const auto& [section, entries] : sections_) {
        if (std::find(known_sections.begin(), known_sections.end(), section) !=
            known_sections.end()) {
            continue;
        }
        throw Error(entries.begin()->second.origin + ": unknown section [" + section + "]",
                    nearest(section, known_sections));
    }
}

std::string toIniText(const std::vector<Options*>& structs) {
    std::ostringstream text;
    for (Options* options : structs) {
        Printer printer;
        options->describe(printer);
        text << "// " << options->about() << "\n[" << options->section() << "]\n"
             << printer.out.str() << "\n";
    }
    return text.str();
}

}  // namespace rgbd_graphslam
