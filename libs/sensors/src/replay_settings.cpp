#include "replay_settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

/** Reads a section, and knows which of its keys were asked for. */
class SectionReader {
  public:
    SectionReader(const mrpt::config::CConfigFileBase& config, const std::string& section)
        : config_(config), section_(section) {
        for (const char* common : {"driver", "process_rate", "sensorLabel", "max_queue_len",
                                   "grab_decimation", "rawlog-grabber-ignore"}) {
            known_.insert(common);
        }
    }

    std::string text(const std::string& key) {
        known_.insert(key);
        return config_.read_string(section_, key, "");
    }

    /** Leaves the value where the key is absent. */
    void number(const std::string& key, double min, double max, double& value, double unit = 1) {
        const std::string written = text(key);
        if (written.empty()) return;
        std::size_t read = 0;
        double given = NAN;
        try {
            given = std::stod(written, &read);
        } catch (const std::exception&) {
            read = 0;
        }
        if (read != written.size() || !(given >= min && given <= max)) {
            throw Error(key + " = '" + written + "' makes no sense",
                        "give " + key + formatted(" a number from %g to %g", min, max));
        }
        value = unit * given;
    }

    /** \throws Error naming a key that nobody has asked for */
    void refuseOthers() const {
        std::vector<std::string> keys;
        config_.getAllKeys(section_, keys);
        for (const std::string& key : keys) {
            const bool comment = key.rfind("//", 0) == 0;  // which MRPT takes for a key
            if (comment || known_.count(key)) continue;
            std::string list;
            for (const std::string& known : known_) list += (list.empty() ? "" : ", ") + known;
            throw Error("unknown key '" + key + "'", "its keys are " + list);
        }
    }

  private:
    const mrpt::config::CConfigFileBase& config_;
    const std::string section_;
    std::set<std::string> known_;
};

std::set<std::string> listOf(const std::string& text) {
    std::set<std::string> all;
    std::istringstream in(text);
    std::string label;
    while (std::getline(in, label, ',')) {
        const auto from = label.find_first_not_of(" \t");
        if (from == std::string::npos) continue;
        all.insert(label.substr(from, label.find_last_not_of(" \t") - from + 1));
    }
    return all;
}

bool stampedNow(const std::string& stamps) {
    if (stamps.empty() || stamps == "recorded") return false;
    if (stamps == "now") return true;
    throw Error("stamps = '" + stamps + "' makes no sense", "give 'recorded' or 'now'");
}

}  // namespace

bool ReplaySettings::silent(double time_s) const {
    return time_s >= silent_at_s && (silent_s == 0 || time_s < silent_at_s + silent_s);
}

bool ReplaySettings::unplugged(double time_s) const {
    if (!(time_s >= unplug_every_s)) return false;
    return std::fmod(time_s, unplug_every_s) < unplugged_s;
}

ReplaySettings replaySettings(const mrpt::config::CConfigFileBase& config,
                              const std::string& section) {
    constexpr double day_s = 86400;
    SectionReader reader(config, section);
    ReplaySettings settings;
    settings.rawlog = reader.text("rawlog");
    if (settings.rawlog.empty()) throw Error("no rawlog", "add rawlog = FILE");
    settings.labels = listOf(reader.text("labels"));
    settings.stamped_now = stampedNow(reader.text("stamps"));
    double repeat = 1, seed = 1;
    reader.number("speed", 0.01, 100, settings.speed);
    reader.number("repeat", 1, 1e6, repeat);
    reader.number("jitter_ms", 0, 1e4, settings.jitter_s, 1e-3);
    reader.number("loss", 0, 1, settings.loss);
    reader.number("reorder", 0, 1, settings.reorder);
    reader.number("reorder_ms", 0, 1e4, settings.reorder_s, 1e-3);
    reader.number("seed", 0, 1e9, seed);
    reader.number("silent_at_s", 0, day_s, settings.silent_at_s);
    reader.number("silent_s", 0, day_s, settings.silent_s);
    reader.number("unplug_every_s", 0.1, day_s, settings.unplug_every_s);
    reader.number("unplugged_s", 0, day_s, settings.unplugged_s);
    reader.number("clock_jump_at_s", 0, day_s, settings.clock_jump_at_s);
    reader.number("clock_jump_s", -1e9, 1e9, settings.clock_jump_s);
    settings.repeat = static_cast<std::size_t>(repeat);
    settings.seed = static_cast<std::uint64_t>(seed);
    reader.refuseOthers();
    return settings;
}

}  // namespace rgbd_graphslam
