/** Progress of a counted job. */
#pragma once
#include <chrono>
#include <cstddef>
#include <string>

namespace rgbd_graphslam {

/** A bar with rate and ETA when stderr is a terminal; otherwise a plain line every tenth but at
 * least two seconds apart, so that short jobs say nothing; nothing when quiet. */
class Progress {
  public:
    /** \param label what is counted, e.g. "tracking"
     *  \param total number of steps; 0 when unknown */
    Progress(std::string label, std::size_t total, std::string unit = "frames");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /** Corrects an estimated total. */
    void expect(std::size_t total) { total_ = total; }

    /** \param done steps finished so far
     *  \param note appended to the line, e.g. "12 keyframes" */
    void update(std::size_t done, const std::string& note = {});
    /** Ends the line. Called by the destructor too. */
    void finish();

  private:
    using Clock = std::chrono::steady_clock;
    std::string line(const std::string& note) const;
    double elapsed() const;

    std::string label_;
    std::string unit_;
    std::size_t total_;
    std::size_t done_ = 0;
    std::size_t next_plain_ = 0;
    bool terminal_;
    bool finished_ = false;
    Clock::time_point start_;
    Clock::time_point last_drawn_;
};

}  // namespace rgbd_graphslam
