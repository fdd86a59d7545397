#include "configured_input.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr int most_files = 1000;  // a shell's pattern may name many; the complaint is ours

std::string extensionOf(const std::string& file) {
    return std::filesystem::path(file).extension().string();
}

/** Two rawlogs are no ini and its rawlog. */
bool namesSeveralInputs(const std::vector<std::string>& files) {
    if (files.size() != 2) return files.size() > 2;
    const std::string extension = extensionOf(files.front());
    return !extension.empty() && extension == extensionOf(files.back());
}

bool startsWithIni(const std::vector<std::string>& files) {
    if (files.size() == 2) return true;
    return files.size() == 1 && extensionOf(files.front()) == ".ini";
}

}  // namespace

void ConfiguredInput::declare(CLI::App& app, const std::string& name, const std::string& help,
                              const std::string& ini_help) {
    options_ = {app.add_option(name, files_, help)->expected(1, most_files),
                app.add_option("--config", config_, ini_help)};
}

std::string ConfiguredInput::ini() const {
    if (namesSeveralInputs(files_)) {
        throw Error(
            "'" + files_.front() + "' and '" + files_.back() + "' cannot be worked on at once",
            "name one of them");
    }
    if (!startsWithIni(files_)) return config_;
    if (config_.empty()) return files_.front();
    throw Error("both '" + files_.front() + "' and --config '" + config_ + "' give the settings",
                "leave one of them out");
}

std::string ConfiguredInput::input() const {
    return files_.size() > (startsWithIni(files_) ? 1u : 0u) ? files_.back() : "";
}

}  // namespace rgbd_graphslam
