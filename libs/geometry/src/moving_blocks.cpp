#include "rgbd_graphslam/geometry/moving_blocks.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {
namespace {

constexpr float nearest_m = 0.1f;

}  // namespace

MovingBlocks::MovingBlocks(const Camera& small, const Rules& rules, const DepthNoise& noise)
    : small_(small), rules_(rules), noise_(noise) {
    for (int v = 0; v < small.height; ++v) {
        for (int u = 0; u < small.width; ++u) {
            rays_.push_back(small.unproject(u, v, 1).cast<float>());
        }
    }
}

std::vector<std::uint8_t> MovingBlocks::find(const Sight& sight,
                                             const std::vector<const Sight*>& others) const {
    std::vector<Votes> votes(rays_.size());
    for (const Sight* other : others) vote(sight, *other, votes);
    std::vector<std::uint8_t> mask = seeds(votes);
    grow(sight.depth_m, votes, mask);
    return mask;
}

void MovingBlocks::vote(const Sight& sight, const Sight& other, std::vector<Votes>& votes) const {
    const SE3 T = other.T_world_cam.inverse() * sight.T_world_cam;
    const Eigen::Matrix3f R = T.R.cast<float>();
    const Eigen::Vector3f t = T.t.cast<float>();
    const bool apart =
        other.session != sight.session || std::abs(other.stamp_s - sight.stamp_s) > rules_.apart_s;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
        if (sight.depth_m[i] <= 0) continue;
        const Eigen::Vector3f p = R * (sight.depth_m[i] * rays_[i]) + t;
        if (p.z() < nearest_m) continue;
        const Eigen::Vector2d pixel = small_.project(p.cast<double>());
        const double u = pixel.x() + 0.5, v = pixel.y() + 0.5;
        if (!(u >= 1 && v >= 1 && u < small_.width - 1 && v < small_.height - 1)) continue;
        const Found found = compare(other.depth_m, static_cast<int>(u), static_cast<int>(v), p.z());
        Votes& of_block = votes[i];
        of_block.through += found == Found::Through && other.session >= sight.session;
        of_block.in_place += found == Found::InPlace;
        of_block.in_place_apart += found == Found::InPlace && apart;
    }
}

/** The blocks around (u, v) are looked at as well: at edges and on slanted surfaces one of them
 *  shows what the middle one misses. */
MovingBlocks::Found MovingBlocks::compare(const std::vector<float>& depth, int u, int v,
                                          float z) const {
    const auto tolerance =
        static_cast<float>(rules_.margin_m + rules_.margin_sigmas * M_SQRT2 * noise_.sigma(z));
    const float* middle = depth.data() + v * small_.width + u;
    if (std::abs(*middle - z) <= tolerance) return Found::InPlace;
    if (*middle < z) return Found::Nothing;  // hidden, or no reading
    bool behind = true;
    for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
            const float seen = middle[dv * small_.width + du];
            if (std::abs(seen - z) <= tolerance) return Found::InPlace;
            behind &= seen == 0 || seen > z;  // no reading says nothing
        }
    }
    return behind ? Found::Through : Found::Nothing;
}

bool MovingBlocks::isFixed(const Votes& votes) const {
    return votes.in_place_apart >= rules_.least_in_place &&
           votes.through < rules_.through_share * (votes.through + votes.in_place);
}

/** Without those that stand alone: noise, and edges of what is thin. */
std::vector<std::uint8_t> MovingBlocks::seeds(const std::vector<Votes>& votes) const {
    constexpr int fewest_together = 3;
    const auto moves = [&](std::size_t i) {
        const Votes& v = votes[i];
        return v.through >= rules_.least_through &&
               v.through >= rules_.through_share * (v.through + v.in_place);
    };
    std::vector<std::uint8_t> alone(votes.size()), seeds(votes.size());
    for (std::size_t i = 0; i < votes.size(); ++i) alone[i] = moves(i);
    const int width = small_.width;
    for (int v = 1; v + 1 < small_.height; ++v) {
        for (int u = 1; u + 1 < width; ++u) {
            const int i = v * width + u;
            if (!alone[i]) continue;
            int together = 0;
            for (int dv = -1; dv <= 1; ++dv)
                for (int du = -1; du <= 1; ++du) together += alone[i + dv * width + du];
            seeds[i] = together >= fewest_together;
        }
    }
    return seeds;
}

float MovingBlocks::step(float z) const {
    constexpr double slant = 0.03, sigmas = 3;
    return static_cast<float>(slant * z + sigmas * noise_.sigma(z));
}

void MovingBlocks::grow(const std::vector<float>& depth, const std::vector<Votes>& votes,
                        std::vector<std::uint8_t>& mask) const {
    std::vector<int> front;
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i]) front.push_back(static_cast<int>(i));
    const int width = small_.width, height = small_.height;
    const auto reach = [&](int from, int to) {
        if (mask[to] || depth[to] <= 0 || isFixed(votes[to])) return;
        if (std::abs(depth[to] - depth[from]) > step(std::min(depth[to], depth[from]))) return;
        mask[to] = 1;
        front.push_back(to);
    };
    while (!front.empty()) {
        const int i = front.back(), u = i % width, v = i / width;
        front.pop_back();
        if (u > 0) reach(i, i - 1);
        if (u + 1 < width) reach(i, i + 1);
        if (v > 0) reach(i, i - width);
        if (v + 1 < height) reach(i, i + width);
    }
}

double MovingBlocks::overlap(const Sight& sight, const Sight& other) const {
    constexpr int across = 5, down = 4;
    const SE3 T = other.T_world_cam.inverse() * sight.T_world_cam;
    int tried = 0, inside = 0;
    for (int y = 0; y < down; ++y) {
        for (int x = 0; x < across; ++x) {
            const int u = (2 * x + 1) * small_.width / (2 * across);
            const int v = (2 * y + 1) * small_.height / (2 * down);
            const int i = v * small_.width + u;
            if (sight.depth_m[i] <= 0) continue;
            ++tried;
            const Eigen::Vector3d p = T * (sight.depth_m[i] * rays_[i]).cast<double>().eval();
            inside += p.z() > nearest_m && small_.contains(small_.project(p));
        }
    }
    return tried > 0 ? static_cast<double>(inside) / tried : 0;
}

std::vector<const Sight*> MovingBlocks::overlapping(const Sight& sight,
                                                    const std::vector<const Sight*>& all,
                                                    std::size_t most) const {
    constexpr double least_overlap = 0.2;
    std::vector<const Sight*> found;
    for (const Sight* other : all) {
        const bool same = other->session == sight.session && other->stamp_s == sight.stamp_s;
        if (!same && overlap(sight, *other) >= least_overlap) found.push_back(other);
    }
    if (found.size() <= most) return found;
    std::vector<const Sight*> spread;
    for (std::size_t i = 0; i < most; ++i) spread.push_back(found[i * found.size() / most]);
    return spread;
}

}  // namespace rgbd_graphslam
