/** What goes wrong because of input or surroundings, as one line a user can act on. */
#pragma once
#include <stdexcept>
#include <string>

namespace rgbd_graphslam {

/** A failure with its remedy. what() is one line: "<what is wrong, naming file, line or frame>;
 *  <what to do>". Everything thrown at users by this project is an Error. */
class Error : public std::runtime_error {
  public:
    explicit Error(const std::string& problem) : std::runtime_error(problem) {}
    Error(const std::string& problem, const std::string& remedy)
        : std::runtime_error(problem + "; " + remedy) {}
};

}  // namespace rgbd_graphslam
