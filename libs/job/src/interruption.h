/** Ctrl-C as a question instead of a death. */
#pragma once
#include <csignal>

namespace rgbd_graphslam {

/** While it lives, the first SIGINT or SIGTERM is noted, and the second ends the process as ever.
 */
class Interruption {
  public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    bool requested() const;

  private:
    struct sigaction old_int_ = {}, old_term_ = {};
};

}  // namespace rgbd_graphslam
