/** Where things moved while a sequence was recorded, as far as that is known. */
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <unordered_map>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** What a part of a mover takes up at a time. */
struct MoverBox {
    double stamp_s = 0;
    std::string name;
    bool carried = false;  // belongs to the camera's carrier
    double speed_m_s = 0;
    SE3 T_world_box;  // origin in the box's middle
    Eigen::Vector3d size_m{0, 0, 0};

    bool contains(const Eigen::Vector3d& point) const;
};

/** The movers.csv that rgbd-synth writes: one line a stamp and part, by stamps.
 *  \throws Error naming the file and line that cannot be read */
std::vector<MoverBox> readMoverBoxes(const std::string& path);

/** Answers whether a mover has been at a point and is there no more. */
class MoverWays {
  public:
    /** \param boxes by stamps, the parts of each stamp in the same order */
    explicit MoverWays(std::vector<MoverBox> boxes);
    bool contains(const Eigen::Vector3d& point) const;

  private:
    bool restsAt(const Eigen::Vector3d& point) const;

    std::vector<MoverBox> boxes_;
    std::size_t last_stamp_ = 0;  // index of its first box
    std::unordered_map<long long, std::vector<std::size_t>> in_column_;
};

}  // namespace rgbd_graphslam
