#include "rgbd_graphslam/mapping/dense_mapper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include "box_room.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

struct Mapped {
    explicit Mapped(bool noisy, const MapOptions& options = {}, Camera camera = smallCamera())
        : mapper(options, camera) {
        Noise noise;
        for (const SE3& T : walk(24))
            mapper.insert(T, render(room, camera, T, 0, noisy ? &noise : nullptr));
    }
    BoxRoom room;
    DenseMapper mapper;
};

/** \param share 0.5 for the median */
double quantile(std::vector<double> values, double share) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

std::vector<double> pointErrors(const Mapped& map) {
    std::vector<double> errors;
    for (const MapPoint& point : map.mapper.points()) {
        errors.push_back(map.room.distanceToSurface(point.position.cast<double>()));
    }
    return errors;
}

/** Of the leaves of 5 cm whose state is certain in truth, the shares found right. */
struct LeafShares {
    double surface_occupied, free_occupied, free_known;
};

LeafShares leafShares(const Mapped& map) {
    const auto& volume = map.mapper.volume();
    const double r = volume.resolution();
    int surface = 0, occupied = 0, free = 0, wrong = 0, known = 0;
    for (double x = -2.95; x < 3; x += r) {
        for (double y = -1.95; y < 2; y += r) {
            // What is well above the floor and below the ceiling has been in sight of the walk.
            for (double z = 0.05; z < 1.8; z += r) {
                const Eigen::Vector3d corner(x + 1e-3, y + 1e-3, z + 1e-3);
                const Eigen::Vector3d center = r * ((corner / r).array().floor() + 0.5);
                if (!map.room.isFree(center, 0.87 * r)) continue;
                const auto log_odds = volume.logOdds(center);
                ++free;
                known += log_odds.has_value();
                wrong += log_odds && *log_odds >= 0;
            }
        }
    }
    // Truth of the surface: where the camera's rays end.
    const Camera camera = smallCamera();
    for (const SE3& T : walk(24)) {
        for (int v = 4; v < camera.height; v += 8) {
            for (int u = 4; u < camera.width; u += 8) {
                const Eigen::Vector3d ray = T.R * camera.unproject(u, v, 1);
                const auto hit = map.room.cast(T.t, ray);
                ++surface;
                // Walls lie on leaf boundaries here: just behind is the same surface.
                const auto log_odds_front =
                    volume.logOdds(Eigen::Vector3d(T.t + (hit.distance - 1e-3) * ray));
                const auto log_odds_back =
                    volume.logOdds(Eigen::Vector3d(T.t + (hit.distance + 1e-3) * ray));
                occupied += (log_odds_front && *log_odds_front >= 0) ||
                            (log_odds_back && *log_odds_back >= 0);
            }
        }
    }
    return {double(occupied) / surface, double(wrong) / free, double(known) / free};
}

TEST(DenseMapper, pointsLieOnTheSurface) {
    const Mapped exact(false), noisy(true);
    EXPECT_LT(quantile(pointErrors(exact), 0.95), 0.001);
    EXPECT_LT(quantile(pointErrors(noisy), 0.5), 0.008);
    EXPECT_LT(quantile(pointErrors(noisy), 0.95), 0.04);
}

TEST(DenseMapper, octreeTellsSurfaceFromFreeSpace) {
    for (const bool noisy : {false, true}) {
        const LeafShares shares = leafShares(Mapped(noisy));
        EXPECT_GT(shares.surface_occupied, 0.97) << noisy;
        EXPECT_LT(shares.free_occupied, 0.01) << noisy;
        EXPECT_GT(shares.free_known, 0.9) << noisy;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
