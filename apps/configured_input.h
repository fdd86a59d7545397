/** Programs that work on one input with optional settings: `PROGRAM INPUT [--config INI]`. */
#pragma once
#include <string>
#include <vector>

#include "command_line.h"

namespace rgbd_graphslam {

/** The order of earlier versions, `PROGRAM INI INPUT`, is understood as well. */
class ConfiguredInput {
  public:
    /** Adds the positional argument `name` and --config.
     *  \param ini_help says what the settings are by default */
    void declare(CLI::App& app, const std::string& name, const std::string& help,
                 const std::string& ini_help);
    /** Both options, for excludes(). */
    const std::vector<CLI::Option*>& options() const { return options_; }

    /** Empty where the command line names none.
     *  \throws Error when it names two, or several inputs */
    std::string ini() const;
    /** Empty where the command line names none. */
    std::string input() const;

  private:
    std::string config_;
    std::vector<std::string> files_;
    std::vector<CLI::Option*> options_;
};

}  // namespace rgbd_graphslam
