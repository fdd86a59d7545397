/** The distance between two points that are pointed at. */
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** The state of a measurement, from the first click to the second. */
class Measuring {
  public:
    /** Starts anew, or stops. \return what to tell the user */
    std::string toggle();
    bool active() const { return active_; }
    /** A third point starts the next measurement.
     *  \param point world (m); nothing where nothing is \return what to tell the user */
    std::string add(const std::optional<Eigen::Vector3d>& point);
    /** None, one or two. */
    const std::vector<Eigen::Vector3d>& points() const { return points_; }

  private:
    bool active_ = false;
    std::vector<Eigen::Vector3d> points_;
};

}  // namespace rgbd_graphslam
