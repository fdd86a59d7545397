#include "rgbd_graphslam/core/console.h"

#include <atomic>
#include <cstdio>
#include <exception>
#include <new>

namespace rgbd_graphslam {
namespace {

std::atomic<Verbosity> current_verbosity{Verbosity::Normal};

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
