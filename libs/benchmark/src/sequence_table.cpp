#include "rgbd_graphslam/benchmark/sequence_table.h"

#include <mrpt/config/CConfigFileMemory.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/ini_formulas.h"

namespace rgbd_graphslam {
namespace {

/** One section of the table. */
class Section {
  public:
    Section(const mrpt::config::CConfigFileMemory& config, std::string path, std::string name)
        : config_(config), path_(std::move(path)), name_(std::move(name)) {}

    bool has(const std::string& key) const { return config_.keyExists(name_, key); }

    std::string text(const std::string& key) const {
        if (!has(key)) refuse("the key '" + key + "' is missing");
        return config_.read_string(name_, key, "");
    }

    double positive(const std::string& key) const {
        const std::string word = text(key);
        char* end = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (word.empty() || *end || !std::isfinite(value) || value <= 0) {
            refuse(key + " = '" + word + "' is no positive number");
        }
        return value;
    }

    /** Whether a key's list of words holds one. */
    bool lists(const std::string& key, const std::string& word) const {
        std::istringstream words(has(key) ? text(key) : "");
        return std::find(std::istream_iterator<std::string>(words), {}, word) !=
               std::istream_iterator<std::string>();
    }

    void allow(const std::vector<std::string>& known) const {
        std::vector<std::string> keys;
        config_.getAllKeys(name_, keys);
        for (const auto& key : keys) {
            if (key.rfind("//", 0) == 0) continue;
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                refuse("unknown key '" + key + "'");
            }
        }
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("'" + path_ + "' [" + name_ + "]: " + why,
                    "see ini/tum-sequences.ini for the form");
    }

    const mrpt::config::CConfigFileMemory& config_;
    std::string path_, name_;
};

KnownSequence sequenceIn(const Section& section, const std::string& name) {
    section.allow({"url", "good_for", "duration_s", "length_m", "checked", "bytes", "best_ate_m"});
    KnownSequence sequence;
    sequence.name = name;
    sequence.url = section.text("url");
    sequence.good_for = section.text("good_for");
    sequence.duration_s = section.positive("duration_s");
    sequence.length_m = section.positive("length_m");
    sequence.duration_checked = section.lists("checked", "duration");
    sequence.length_checked = section.lists("checked", "length");
    if (section.has("bytes")) sequence.bytes = static_cast<std::size_t>(section.positive("bytes"));
    if (section.has("best_ate_m")) sequence.best_ate_m = section.positive("best_ate_m");
    return sequence;
}

/** "fr1_desk" for all ways in which people write it. */
std::string plainName(std::string name) {
    const auto drop = [&](const std::string& prefix) {
        if (name.rfind(prefix, 0) == 0) name.erase(0, prefix.size());
    };
    drop("rgbd_dataset_");
    if (name.rfind("freiburg", 0) == 0) name.replace(0, 8, "fr");
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

}  // namespace

std::string KnownSequence::folder() const {
    return std::filesystem::path(url).stem().string();
}

std::vector<KnownSequence> readSequenceTable(const std::string& path) {
    std::ifstream in(path);
    std::stringstream text;
    if (!in || !(text << in.rdbuf())) throw Error("cannot read '" + path + "'", "check its name");
    refuseFormulas(text.str(), path);
    mrpt::config::CConfigFileMemory config;
    config.setContent(text.str());
    std::vector<std::string> names;
    config.getAllSections(names);
    std::vector<KnownSequence> table;
    for (const auto& name : names) {
        if (!name.empty()) table.push_back(sequenceIn(Section(config, path, name), name));
    }
    if (table.empty()) throw Error("'" + path + "' names no sequence", "give another table");
    return table;
}

const KnownSequence* findSequence(const std::vector<KnownSequence>& table,
                                  const std::string& name) {
    for (const auto& sequence : table) {
        if (plainName(sequence.name) == plainName(name)) return &sequence;
    }
    return nullptr;
}

std::string toText(const std::vector<KnownSequence>& table) {
    std::string text =
        "sequence                                  duration   length     size  good for\n";
    for (const auto& sequence : table) {
        char size[32] = "?";
        if (sequence.bytes) {
            std::snprintf(size, sizeof size, "%.0f MB", static_cast<double>(*sequence.bytes) / 1e6);
        }
        char line[256];
        std::snprintf(line, sizeof line, "%-40s %c%6.1f s %c%5.2f m  %7s  ", sequence.name.c_str(),
                      sequence.duration_checked ? ' ' : '~', sequence.duration_s,
                      sequence.length_checked ? ' ' : '~', sequence.length_m, size);
        text += line + sequence.good_for + "\n";
    }
    return text + "~ as remembered from the benchmark's page, not checked against the sequence\n";
}

}  // namespace rgbd_graphslam
