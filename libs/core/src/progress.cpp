#include "rgbd_graphslam/core/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "rgbd_graphslam/core/console.h"

namespace rgbd_graphslam {
namespace {

constexpr int bar_width = 28;
constexpr double redraw_period_s = 0.1, plain_period_s = 2;

std::string formatted(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof(text), format, value);
    return text;
}

std::string bar(double share) {
    const int filled = static_cast<int>(share * bar_width);
    return "[" + std::string(filled, '#') + std::string(bar_width - filled, '.') + "]";
}

}  // namespace

Progress::Progress(std::string label, std::size_t total, std::string unit)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_drawn_(start_) {
    next_plain_ = std::max<std::size_t>(1, total_ ? total_ / 10 : 500);
    finished_ = verbosity() == Verbosity::Quiet;
}

Progress::~Progress() {
    finish();
}

double Progress::elapsed() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

std::string Progress::line(const std::string& note) const {
    const double rate = done_ / std::max(1e-9, elapsed());
    std::string text = label_ + " ";
    if (total_) {
        const double share = std::min(1.0, static_cast<double>(done_) / total_);
        if (terminal_) text += bar(share) + " ";
        text += formatted("%3.0f %% ", 100 * share);
    }
    text += std::to_string(done_) + (total_ ? "/" + std::to_string(total_) : "") + " " + unit_;
    text += formatted(", %.1f/s", rate);
    if (total_ > done_ && rate > 0) text += formatted(", %.0f s left", (total_ - done_) / rate);
    return note.empty() ? text : text + ", " + note;
}

void Progress::update(std::size_t done, const std::string& note) {
    done_ = done;
    if (finished_) return;
    if (!terminal_ && done_ < next_plain_) return;
    const auto now = Clock::now();
    const double quiet_s = std::chrono::duration<double>(now - last_drawn_).count();
    if (quiet_s < (terminal_ ? redraw_period_s : plain_period_s)) return;
    last_drawn_ = now;
    next_plain_ = done_ + std::max<std::size_t>(1, total_ ? total_ / 10 : 500);
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "%s\n", line(note).c_str());
    std::fflush(stderr);
}

void Progress::finish() {
    if (finished_) return;
    finished_ = true;
    if (terminal_) std::fprintf(stderr, "\r%s\033[K\n", line({}).c_str());
}

}  // namespace rgbd_graphslam
