#include "rgbd_graphslam/core/console.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>

#include "rgbd_graphslam/core/printable_text.h"

namespace rgbd_graphslam {
namespace {

std::atomic<Verbosity> current_verbosity{Verbosity::Normal};

std::mutex warnings_access;
int warning_records = 0;
std::vector<std::string> said_warnings;  // since the first of the records that live

void sayIf(bool wanted, const char* prefix, const std::string& line) {
    if (wanted) std::fprintf(stderr, "%s%s\n", prefix, printableLine(line).c_str());
}

const char* crash_line = "";

/** The libraries beneath take a damaged file at its word where they do, and die of it. */
void reportCrash(int signal_number) {
    const ssize_t written = write(STDERR_FILENO, crash_line, std::strlen(crash_line));
    static_cast<void>(written);
    raise(signal_number);  // has its default effect by now
}

void reportCrashes(const std::string& program) {
    static const std::string line = program +
                                    ": error: crashed; a damaged input file or too little memory "
                                    "can do that, check both\n";
    crash_line = line.c_str();
    struct sigaction action = {};
    action.sa_handler = reportCrash;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
    for (const int signal_number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
        sigaction(signal_number, &action, nullptr);
    }
}

}  // namespace

void setVerbosity(Verbosity verbosity) {
    current_verbosity = verbosity;
}

Verbosity verbosity() {
    return current_verbosity;
}

void sayDetail(const std::string& line) {
    sayIf(verbosity() == Verbosity::Verbose, "", line);
}

void sayInfo(const std::string& line) {
    sayIf(verbosity() != Verbosity::Quiet, "", line);
}

void sayWarning(const std::string& line) {
    sayIf(true, "warning: ", line);
    const std::lock_guard<std::mutex> lock(warnings_access);
    if (warning_records > 0) said_warnings.push_back(printableLine(line));
}

WarningRecord::WarningRecord() {
    const std::lock_guard<std::mutex> lock(warnings_access);
    ++warning_records;
    first_ = said_warnings.size();
}

WarningRecord::~WarningRecord() {
    const std::lock_guard<std::mutex> lock(warnings_access);
    if (--warning_records == 0) said_warnings.clear();
}

std::vector<std::string> WarningRecord::warnings() const {
    const std::lock_guard<std::mutex> lock(warnings_access);
    return {said_warnings.begin() + static_cast<std::ptrdiff_t>(first_), said_warnings.end()};
}

int runMain(const std::string& name, const std::function<int()>& body) {
    reportCrashes(name);
    std::string problem;
    try {
        return body();
    } catch (const std::bad_alloc&) {
        problem = "out of memory; use fewer frames or a coarser map";
    } catch (const std::length_error&) {
        problem = "a file asks for more memory than there can be; make it again";
    } catch (const std::exception& e) {
        problem = printableLine(e.what());
    }
    std::fprintf(stderr, "%s: error: %s\n", name.c_str(), problem.c_str());
    return 1;
}

}  // namespace rgbd_graphslam
