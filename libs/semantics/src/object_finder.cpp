#include "rgbd_graphslam/semantics/object_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <set>

namespace rgbd_graphslam {
namespace {

using Entry = VoxelTable<LabeledVoxel>::Entry;

/** Disjoint sets (Tarjan 1975) of entries. */
class Surfaces {
  public:
    explicit Surfaces(std::size_t entries) : parent_(entries) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /** The lower number stays, so that the order of joining does not matter. */
    void join(std::size_t a, std::size_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> parent_;
};

struct Candidate {
    std::uint64_t key;
    int label;
    double confidence;
    Eigen::Vector3f position;
};

std::vector<Candidate> candidatesOf(const LabelFusion& map, const LabelSet& names,
                                    const SemanticOptions& options) {
    std::set<int> stuff = labelsNamed(names, options.stuff_classes);
    stuff.merge(labelsNamed(names, options.moving_classes));
    const int classes = std::max<int>(2, static_cast<int>(names.size()));
    std::vector<Candidate> candidates;
    for (const Entry& entry : map.voxels().entries()) {
        const LabelVote& vote = entry.cell.vote;
        const double confidence = vote.confidence(options.frame_accuracy, classes);
        if (confidence < options.min_confidence || stuff.count(vote.best()) > 0) continue;
        candidates.push_back({entry.key, vote.best(), confidence, map.position(entry)});
    }
    return candidates;
}

/** Joins candidates of the same class that lie within `reach` voxels of each other. */
Surfaces surfacesOf(const std::vector<Candidate>& candidates, int reach) {
    Surfaces surfaces(candidates.size());
    VoxelTable<std::uint32_t> numbers;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        numbers[candidates[i].key] = static_cast<std::uint32_t>(i + 1);
    }
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const VoxelIndex at = voxelOfKey(candidates[i].key);
        numbers.forEachWithin({at.x - reach, at.y - reach, at.z - reach},
                              {at.x + reach, at.y + reach, at.z + reach},
                              [&](const VoxelIndex&, std::uint32_t number) {
                                  const std::size_t other = number - 1;
                                  if (candidates[other].label == candidates[i].label)
                                      surfaces.join(i, other);
                              });
    }
    return surfaces;
}

MapObject objectOf(const std::vector<Candidate>& candidates,
                   const std::vector<std::size_t>& members) {
    MapObject object;
    std::vector<Eigen::Vector3f> points;
    for (const std::size_t i : members) {
        object.confidence += candidates[i].confidence / static_cast<double>(members.size());
        points.push_back(candidates[i].position);
    }
    object.label = candidates[members.front()].label;
    object.box = boxAround(points);
    object.voxels = members.size();
    return object;
}

/** Cuts 1 % off at both ends. */
std::pair<float, float> usualRange(std::vector<float> values) {
    std::sort(values.begin(), values.end());
    const std::size_t cut = values.size() / 100;
    return {values[cut], values[values.size() - 1 - cut]};
}

double nextTurn(double yaw_rad) {
    while (yaw_rad > M_PI / 2) yaw_rad -= M_PI;
    while (yaw_rad <= -M_PI / 2) yaw_rad += M_PI;
    return yaw_rad;
}

}  // namespace

UprightBox boxAround(const std::vector<Eigen::Vector3f>& points) {
    std::vector<cv::Point2f> floor;
    for (const Eigen::Vector3f& p : points) floor.emplace_back(p.x(), p.y());
    double yaw = cv::minAreaRect(floor).angle * M_PI / 180;
    const Eigen::Vector2f along(std::cos(yaw), std::sin(yaw)), across(-along.y(), along.x());
    std::array<std::vector<float>, 3> values;
    for (const Eigen::Vector3f& p : points) {
        values[0].push_back(along.dot(p.head<2>()));
        values[1].push_back(across.dot(p.head<2>()));
        values[2].push_back(p.z());
    }
    UprightBox box;
    Eigen::Vector3d middle;
    for (int i = 0; i < 3; ++i) {
        const auto [low, high] = usualRange(std::move(values[static_cast<std::size_t>(i)]));
        middle[i] = 0.5 * (double{low} + high);
        box.size[i] = double{high} - low;
    }
    box.center << (middle.x() * along + middle.y() * across).cast<double>().eval(), middle.z();
    if (box.size.y() > box.size.x()) {
        std::swap(box.size.x(), box.size.y());
        yaw += M_PI / 2;
    }
    box.yaw_rad = nextTurn(yaw);
    return box;
}

FoundObjects findObjects(const LabelFusion& map, const LabelSet& names,
                         const SemanticOptions& options) {
    const std::vector<Candidate> candidates = candidatesOf(map, names, options);
    const int reach = std::max(1, static_cast<int>(options.object_gap_m / map.voxelSize()));
    Surfaces surfaces = surfacesOf(candidates, reach);
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < candidates.size(); ++i) members[surfaces.find(i)].push_back(i);

    std::vector<std::pair<MapObject, const std::vector<std::size_t>*>> found;
    for (const auto& [first, all] : members) {
        const MapObject object = objectOf(candidates, all);
        if (object.box.size.maxCoeff() >= options.min_object_m) found.emplace_back(object, &all);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first.voxels > b.first.voxels; });
    FoundObjects result;
    for (const auto& [object, all] : found) {
        for (const std::size_t i : *all) {
            result.object_of_voxel[candidates[i].key] = static_cast<int>(result.objects.size());
        }
        result.objects.push_back(object);
    }
    return result;
}

}  // namespace rgbd_graphslam
