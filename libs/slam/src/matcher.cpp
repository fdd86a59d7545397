#include "rgbd_graphslam/slam/matcher.h"

#include "popcount.h"

namespace rgbd_graphslam {
namespace {

constexpr int no_distance = 257;

struct Best {
    int keypoint = -1;
    int distance = no_distance;
    int second = no_distance;
};

RGBD_WITH_POPCOUNT
Best nearestInWindow(const Frame& frame, const std::vector<int>& claimed,
                     const Descriptor& descriptor, const SearchWindow& window) {
    Best best;
    const auto compare = [&](int i) {
        const Keypoint& k = frame.keypoints[i];
        const float du = k.u - window.u, dv = k.v - window.v;
        if (k.octave < window.octave_min || k.octave > window.octave_max || claimed[i] < 0 ||
            du * du + dv * dv > window.radius * window.radius) {
            return;
        }
        const int distance = hammingDistance(descriptor, frame.descriptors[i]);
        if (distance < best.distance) {
            best = {i, distance, best.distance};
        } else if (distance < best.second) {
            best.second = distance;
        }
    };
    frame.grid.visit(window.u, window.v, window.radius, compare, window.camera);
    return best;
}

/** Both directions of an exhaustive comparison at once. */
RGBD_WITH_POPCOUNT
void compareAll(const std::vector<Descriptor>& a, const std::vector<Descriptor>& b,
                std::vector<Best>& best_of_a, std::vector<Best>& best_of_b) {
    const auto note = [](Best& best, int index, int distance) {
        if (distance < best.distance) {
            best = {index, distance, best.distance};
        } else if (distance < best.second) {
            best.second = distance;
        }
    };
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            const int distance = hammingDistance(a[i], b[j]);
            note(best_of_a[i], static_cast<int>(j), distance);
            note(best_of_b[j], static_cast<int>(i), distance);
        }
    }
}

}  // namespace

MatchTable::MatchTable(const Frame& frame)
    : frame_(frame),
      point_(frame.keypoints.size(), -1),
      distance_(frame.keypoints.size(), no_distance) {}

bool MatchTable::search(int point, const Descriptor& descriptor, const SearchWindow& window,
                        int max_hamming, float ratio) {
    const Best best = nearestInWindow(frame_, distance_, descriptor, window);
    if (best.keypoint < 0 || best.distance > max_hamming) return false;
    if (best.distance > ratio * best.second) return false;
    if (best.distance >= distance_[best.keypoint]) return false;
    point_[best.keypoint] = point;
    distance_[best.keypoint] = best.distance;
    return true;
}

std::vector<std::pair<int, int>> MatchTable::matches() const {
    std::vector<std::pair<int, int>> result;
    for (std::size_t i = 0; i < point_.size(); ++i) {
        if (point_[i] >= 0) result.emplace_back(static_cast<int>(i), point_[i]);
    }
    return result;
}

std::vector<std::pair<int, int>> matchMutually(const std::vector<Descriptor>& a,
                                               const std::vector<Descriptor>& b, int max_hamming,
                                               float ratio) {
    std::vector<Best> best_of_a(a.size()), best_of_b(b.size());
    compareAll(a, b, best_of_a, best_of_b);
    std::vector<std::pair<int, int>> pairs;
    for (std::size_t i = 0; i < best_of_a.size(); ++i) {
        const Best& best = best_of_a[i];
        if (best.keypoint < 0 || best.distance > max_hamming) continue;
        if (best.distance > ratio * best.second) continue;
        if (best_of_b[best.keypoint].keypoint != static_cast<int>(i)) continue;
        pairs.emplace_back(static_cast<int>(i), best.keypoint);
    }
    return pairs;
}

}  // namespace rgbd_graphslam
