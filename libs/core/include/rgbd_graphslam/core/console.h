/** What an application says to its user on stderr; results go to stdout. */
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** How much a program says besides errors and results. */
enum class Verbosity { Quiet, Normal, Verbose };

/** Process-wide; set once from --quiet/--verbose. */
void setVerbosity(Verbosity verbosity);
Verbosity verbosity();

/** Verbose only. */
void sayDetail(const std::string& line);
/** Unless quiet. */
void sayInfo(const std::string& line);
/** Always. */
void sayWarning(const std::string& line);

/** Keeps what sayWarning says, in any thread, while it lives. */
class WarningRecord {
  public:
    WarningRecord();
    ~WarningRecord();
    WarningRecord(const WarningRecord&) = delete;
    WarningRecord& operator=(const WarningRecord&) = delete;

    std::vector<std::string> warnings() const;

  private:
    std::size_t first_;  // of all that were said
};

/** Runs the body of a main() and turns any exception into one line "name: error: …".
 *  \return the body's exit code, or 1 after an exception */
int runMain(const std::string& name, const std::function<int()>& body);

}  // namespace rgbd_graphslam
