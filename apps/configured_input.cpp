#include "configured_input.h"

#include <filesystem>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

bool startsWithIni(const std::vector<std::string>& files) {
    if (files.size() == 2) return true;
    return files.size() == 1 && std::filesystem::path(files.front()).extension() == ".ini";
}

}  // namespace

void ConfiguredInput::declare(CLI::App& app, const std::string& name, const std::string& help,
                              const std::string& ini_help) {
    options_ = {app.add_option(name, files_, help)->expected(1, 2),
                app.add_option("--config", config_, ini_help)};
}

std::string ConfiguredInput::ini() const {
    if (!startsWithIni(files_)) return config_;
    if (config_.empty()) return files_.front();
    throw Error("both '" + files_.front() + "' and --config '" + config_ + "' give the settings",
                "leave one of them out");
}

std::string ConfiguredInput::input() const {
    return files_.size() > (startsWithIni(files_) ? 1u : 0u) ? files_.back() : "";
}

}  // namespace rgbd_graphslam
