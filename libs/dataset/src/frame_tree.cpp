#include "frame_tree.h"

#include <algorithm>

namespace rgbd_graphslam {
namespace {

/** Less than this between two poses is the rounding of who published them, m and rad. */
constexpr double still = 1e-6;

bool differ(const SE3& a, const SE3& b) {
    const SE3 between = a.inverse() * b;
    return between.t.norm() > still || between.angle() > still;
}

void sortByTime(Trajectory& path) {
    std::stable_sort(path.begin(), path.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
}

}  // namespace

std::string plainFrame(const std::string& frame) {
    return frame.empty() || frame[0] != '/' ? frame : frame.substr(1);
}

void FrameTree::add(const ros::Transform& transform) {
    const SE3& T = transform.T_parent_child;
    if (!T.R.allFinite() || !T.t.allFinite()) return;
    const std::string parent = plainFrame(transform.header.frame);
    auto& parents = links_[plainFrame(transform.child)];
    auto link = std::find_if(parents.begin(), parents.end(),
                             [&](const Link& known) { return known.parent == parent; });
    if (link == parents.end()) link = parents.insert(link, Link{parent, false, {}});
    link->moves = link->moves || (!link->poses.empty() && differ(link->poses[0].T_world_cam, T));
    link->poses.push_back({transform.header.stamp_s, T});
}

/** The shortest way up to each frame above, and no way to the frame itself. */
std::map<std::string, FrameTree::Chain> FrameTree::chainsAbove(const std::string& frame) const {
    std::map<std::string, Chain> chains = {{plainFrame(frame), {}}};
    std::vector<std::string> open = {plainFrame(frame)};
    for (std::size_t next = 0; next < open.size(); ++next) {
        const auto links = links_.find(open[next]);
        if (links == links_.end()) continue;
        for (const Link& link : links->second) {
            Chain chain = chains[open[next]];
            chain.push_back(&link);
            if (chains.emplace(link.parent, chain).second) open.push_back(link.parent);
        }
    }
    return chains;
}

std::optional<SE3> FrameTree::fixedPose(const Chain& chain) {
    SE3 T;
    for (const Link* link : chain) {
        if (link->moves) return std::nullopt;
        T = link->poses.back().T_world_cam * T;
    }
    return T;
}

std::optional<SE3> FrameTree::fixedPose(const std::string& in, const std::string& frame) const {
    if (in.empty() || frame.empty()) return std::nullopt;
    const auto above_in = chainsAbove(in), above_frame = chainsAbove(frame);
    for (const auto& [common, chain] : above_frame) {
        const auto other = above_in.find(common);
        if (other == above_in.end()) continue;
        const auto T_common_frame = fixedPose(chain), T_common_in = fixedPose(other->second);
        if (T_common_frame && T_common_in) return T_common_in->inverse() * *T_common_frame;
    }
    return std::nullopt;
}

std::vector<std::string> FrameTree::framesAbove(const std::string& frame) const {
    std::vector<std::string> names;
    for (const auto& [name, chain] : chainsAbove(frame)) {
        if (!chain.empty()) names.push_back(name);
    }
    return names;
}

std::vector<std::string> FrameTree::frames() const {
    std::vector<std::string> names;
    for (const auto& [name, links] : links_) names.push_back(name);
    return names;
}

/** Of the lowest frame of a chain while `leading`, one of its links, is as given. */
std::optional<SE3> FrameTree::poseAt(const Chain& chain, const Link& leading,
                                     const StampedPose& led) {
    SE3 T;
    for (const Link* link : chain) {
        if (link == &leading) {
            T = led.T_world_cam * T;
        } else if (!link->moves) {
            T = link->poses.back().T_world_cam * T;
        } else if (const auto pose = rgbd_graphslam::poseAt(link->poses, led.stamp_s)) {
            T = *pose * T;
        } else {
            return std::nullopt;
        }
    }
    return T;
}

Trajectory FrameTree::pathOf(const std::string& frame, const std::string& above) const {
    const auto chains = chainsAbove(frame);
    const auto chain = chains.find(plainFrame(above));
    if (chain == chains.end()) return {};
    const Link* leading = nullptr;
    for (const Link* link : chain->second) {
        if (link->moves && (!leading || link->poses.size() > leading->poses.size())) leading = link;
    }
    if (!leading) return {};
    Trajectory path;
    for (const StampedPose& led : leading->poses) {
        if (const auto T = poseAt(chain->second, *leading, led)) path.push_back({led.stamp_s, *T});
    }
    sortByTime(path);
    return path;
}

}  // namespace rgbd_graphslam
