#include "rgbd_graphslam/benchmark/benchmark_job.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>
#include <thread>

#include "rgbd_graphslam/benchmark/benchmark_report.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/installed_files.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr int processors_a_job = 2;
constexpr double gigabytes_a_job = 2;

double freeGigabytes() {
    std::ifstream in("/proc/meminfo");
    for (std::string line; std::getline(in, line);) {
        double kilobytes = 0;
        if (std::sscanf(line.c_str(), "MemAvailable: %lf", &kilobytes) == 1) return kilobytes / 1e6;
    }
    return gigabytes_a_job;
}

std::string inFigures(const SequenceResult& result) {
    if (!result.problem.empty()) return "failed: " + result.problem;
    char text[128];
    std::snprintf(text, sizeof text, "%zu frames, %zu lost, %.1f ms CPU per frame", result.frames,
                  result.lost, result.cpu_ms_a_frame);
    std::string figures = text;
    if (result.ate_rmse_m) {
        std::snprintf(text, sizeof text, ", ATE RMSE %.4f m", *result.ate_rmse_m);
        figures += text;
    }
    return figures;
}

/** Takes sequences from a list on several threads, which only wait for their processes. */
class Benchmark {
  public:
    Benchmark(const BenchmarkRequest& request, std::vector<FoundSequence> sequences)
        : request_(request), sequences_(std::move(sequences)) {}

    /** \return number of failures */
    std::size_t run(int jobs) {
        std::vector<std::future<void>> workers;
        workers.reserve(jobs);
        for (int i = 0; i < jobs; ++i) {
            workers.push_back(std::async(std::launch::async, [this] { work(); }));
        }
        for (auto& worker : workers) worker.get();
        return failures_;
    }

  private:
    void work() {
        for (std::size_t i = next_++; i < sequences_.size(); i = next_++) {
            const SequenceResult result = resultOf(sequences_[i]);
            if (!result.problem.empty()) ++failures_;
            const std::lock_guard<std::mutex> lock(speech_);
            sayInfo("[" + std::to_string(++done_) + "/" + std::to_string(sequences_.size()) + "] " +
                    result.name + ": " + inFigures(result));
        }
    }

    SequenceResult resultOf(const FoundSequence& sequence) const {
        const std::string folder = fs::path(request_.out_folder) / sequence.name;
        const auto earlier = readResult(folder);
        if (earlier && earlier->problem.empty() &&
            earlier->fingerprint == fingerprintOf(sequence, request_.run)) {
            return *earlier;
        }
        return runSequence(sequence, request_.run, folder);
    }

    const BenchmarkRequest& request_;
    std::vector<FoundSequence> sequences_;
    std::atomic<std::size_t> next_{0}, failures_{0};
    std::size_t done_ = 0;
    std::mutex speech_;
};

}  // namespace

int affordableJobs() {
    const int by_processors =
        static_cast<int>(std::thread::hardware_concurrency()) / processors_a_job;
    const int by_memory = static_cast<int>(freeGigabytes() / gigabytes_a_job);
    return std::max(1, std::min(by_processors, by_memory));
}

std::size_t runBenchmark(const BenchmarkRequest& request) {
    const auto table =
        readSequenceTable(request.table.empty() ? shippedIni("tum-sequences.ini") : request.table);
    const auto all = findSequences(request.folders, request.out_folder);
    makeWritableFolder(request.out_folder);
    Benchmark benchmark(request, shareOf(all, request.share));
    const std::size_t failures = benchmark.run(request.jobs > 0 ? request.jobs : affordableJobs());
    writeReport(request.out_folder, table);
    return failures;
}

}  // namespace rgbd_graphslam
