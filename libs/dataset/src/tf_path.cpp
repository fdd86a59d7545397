#include "tf_path.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

/** ROS wrote frames with and without a slash in front. */
std::string plainName(const std::string& frame) {
    return frame.empty() || frame[0] != '/' ? frame : frame.substr(1);
}

}  // namespace

void TfPath::add(const ros::Transform& transform) {
    Link& link = links_[plainName(transform.child)];
    link.parent = plainName(transform.header.frame);
    link.poses.push_back({transform.header.stamp_s, transform.T_parent_child});
}

Trajectory TfPath::pathOf(const std::string& frame) const {
    SE3 T_below_frame;
    auto link = links_.find(plainName(frame));
    for (std::size_t depth = 0; link != links_.end() && depth < links_.size(); ++depth) {
        const auto above = links_.find(link->second.parent);
        if (above == links_.end()) break;
        T_below_frame = link->second.poses.back().T_world_cam * T_below_frame;
        link = above;
    }
    if (link == links_.end() || link->second.poses.size() < 2) return {};
    Trajectory path = link->second.poses;
    for (auto& pose : path) pose.T_world_cam = pose.T_world_cam * T_below_frame;
    std::stable_sort(path.begin(), path.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
    return path;
}

}  // namespace rgbd_graphslam
