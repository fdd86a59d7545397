#include "rgbd_graphslam/core/console.h"

#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <new>

namespace rgbd_graphslam {
namespace {

std::atomic<Verbosity> current_verbosity{Verbosity::Normal};

std::mutex warnings_access;
int warning_records = 0;
std::vector<std::string> said_warnings;  // since the first of the records that live

void sayIf(bool wanted, const char* prefix, const std::string& line) {
    if (wanted) std::fprintf(stderr, "%s%s\n", prefix, line.c_str());
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
    if (warning_records > 0) said_warnings.push_back(line);
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
    std::string problem;
    try {
        return body();
    } catch (const std::bad_alloc&) {
        problem = "out of memory; use fewer frames or a coarser map";
    } catch (const std::exception& e) {
        problem = e.what();
    }
    std::fprintf(stderr, "%s: error: %s\n", name.c_str(), problem.c_str());
    return 1;
}

}  // namespace rgbd_graphslam
