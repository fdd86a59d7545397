/** Dense mapping against MRPT's COctoMap: milliseconds a keyframe of 640 x 480. */
#include <benchmark/benchmark.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include "../unit/mapping/box_room.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/mapping/dense_mapper.h"
#include "rgbd_graphslam/mapping/surface_nets.h"

namespace rgbd_graphslam {
namespace {
using namespace testing_room;

constexpr int views = 12;

struct Sequence {
    Camera camera;
    std::vector<SE3> poses = walk(views);
    std::vector<RgbdImage> images;
    Sequence() {
        Noise noise;
        for (const SE3& T : poses) images.push_back(render(BoxRoom(), camera, T, 0, &noise));
    }
};

const Sequence& sequence() {
    static const Sequence made;
    return made;
}

double resolutionOf(const benchmark::State& state) {
    return 0.01 * static_cast<double>(state.range(0));
}

MapOptions optionsFor(const benchmark::State& state) {
    MapOptions options;
    options.octree_resolution_m = resolutionOf(state);
    return options;
}

void reportPerKeyframe(benchmark::State& state) {
    using benchmark::Counter;
    state.counters["per_keyframe"] =
        Counter(views, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

OccupancyVolume volumeOf(const MapOptions& options) {
    const RayTable rays(sequence().camera);
    OccupancyVolume volume(options.octree_resolution_m, options.hit_share);
    for (int i = 0; i < views; ++i) {
        volume.insert(sequence().poses[i], DepthView(sequence().images[i], rays, options));
    }
    return volume;
}

void octreeInsertion(benchmark::State& state) {
    sequence();
    for (auto _ : state) benchmark::DoNotOptimize(volumeOf(optionsFor(state)).bytes());
    reportPerKeyframe(state);
}
BENCHMARK(octreeInsertion)->Arg(10)->Arg(5)->Arg(2)->Unit(benchmark::kMillisecond);

void octreeInsertionAndBothTrees(benchmark::State& state) {
    sequence();
    for (auto _ : state) {
        const OccupancyVolume volume = volumeOf(optionsFor(state));
        benchmark::DoNotOptimize(toOcTree(volume, LeafValues::MaximumLikelihood)->size());
        benchmark::DoNotOptimize(toColorOcTree(volume)->size());
        state.counters["volume_MB"] = 1e-6 * static_cast<double>(volume.bytes());
    }
    reportPerKeyframe(state);
}
BENCHMARK(octreeInsertionAndBothTrees)->Arg(10)->Arg(5)->Arg(2)->Unit(benchmark::kMillisecond);

void pointFusion(benchmark::State& state) {
    const RayTable rays(sequence().camera);
    for (auto _ : state) {
        PointFusion points(resolutionOf(state));
        for (int i = 0; i < views; ++i) {
            points.insert(sequence().poses[i], DepthView(sequence().images[i], rays, MapOptions()));
        }
        state.counters["MB"] = 1e-6 * static_cast<double>(points.bytes());
    }
    reportPerKeyframe(state);
}
BENCHMARK(pointFusion)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

void meshFusion(benchmark::State& state) {
    const RayTable rays(sequence().camera);
    for (auto _ : state) {
        TsdfVolume volume(resolutionOf(state));
        for (int i = 0; i < views; ++i) {
            volume.insert(sequence().poses[i], DepthView(sequence().images[i], rays, MapOptions()));
        }
        state.counters["MB"] = 1e-6 * static_cast<double>(volume.bytes());
    }
    reportPerKeyframe(state);
}
BENCHMARK(meshFusion)->Arg(4)->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond);

void meshOfRoom(benchmark::State& state) {
    const RayTable rays(sequence().camera);
    TsdfVolume volume(resolutionOf(state));
    for (int i = 0; i < views; ++i)
        volume.insert(sequence().poses[i], DepthView(sequence().images[i], rays, MapOptions()));
    for (auto _ : state) {
        const PlyModel mesh = surfaceOf(volume.blocks(), resolutionOf(state));
        state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
    }
}
BENCHMARK(meshOfRoom)->Arg(4)->Arg(2)->Arg(1)->Unit(benchmark::kMillisecond);

/** The same cleaned readings as point clouds, which is what COctoMap takes fastest. */
std::vector<mrpt::obs::CObservationPointCloud> pointClouds() {
    const RayTable rays(sequence().camera);
    std::vector<mrpt::obs::CObservationPointCloud> clouds(views);
    for (int i = 0; i < views; ++i) {
        const DepthView view(sequence().images[i], rays, MapOptions());
        auto points = mrpt::maps::CSimplePointsMap::Create();
        constexpr double fine_m = 1e-5;
        SurfaceSampler(view, SE3(), fine_m)
            .forEachRun([&](const VoxelIndex& v, const SurfaceSample&) {
                points->insertPoint(fine_m * v.x, fine_m * v.y, fine_m * v.z);
            });
        clouds[i].pointcloud = points;
    }
    return clouds;
}

std::unique_ptr<mrpt::maps::COctoMap> reference(double resolution_m) {
    static const auto clouds = pointClouds();
    auto map = std::make_unique<mrpt::maps::COctoMap>(resolution_m);
    for (int i = 0; i < views; ++i)
        map->insertObservation(clouds[i], toCPose3D(sequence().poses[i]));
    return map;
}

void mrptOctoMap(benchmark::State& state) {
    reference(1);
    for (auto _ : state)
        benchmark::DoNotOptimize(reference(resolutionOf(state))->getNumLeafNodes());
    reportPerKeyframe(state);
}
BENCHMARK(mrptOctoMap)->Arg(10)->Arg(5)->Arg(2)->Unit(benchmark::kMillisecond);

/** Leaf by leaf within the room's bounds: the counters are of interest, not the time. */
void differenceToMrptOctoMap(benchmark::State& state) {
    const double r = resolutionOf(state);
    const auto map = reference(r);
    const OccupancyVolume volume = volumeOf(optionsFor(state));
    double leaves = 0, same = 0, known_here_only = 0, unknown_here = 0, occupied_here = 0,
           free_here = 0;
    for (auto _ : state) {
        for (double x = -3.2 + r / 2; x < 3.2; x += r) {
            for (double y = -2.2 + r / 2; y < 2.2; y += r) {
                for (double z = -0.2 + r / 2; z < 2.6; z += r) {
                    double probability = 0.5;
                    const bool known_there = map->getPointOccupancy(x, y, z, probability);
                    const auto here = volume.logOdds(Eigen::Vector3d(x, y, z));
                    if (!known_there && !here) continue;
                    ++leaves;
                    if (!known_there)
                        ++known_here_only;
                    else if (!here)
                        ++unknown_here;
                    else if ((*here >= 0) == (probability >= 0.5))
                        ++same;
                    else
                        ++(*here >= 0 ? occupied_here : free_here);
                }
            }
        }
    }
    const auto report = [&](const char* name, double count) {
        state.counters[name] = 100 * count / leaves;
    };
    state.counters["leaves"] = leaves;
    report("same_%", same);
    report("known_here_only_%", known_here_only);
    report("unknown_here_%", unknown_here);
    report("occupied_here_free_there_%", occupied_here);
    report("free_here_occupied_there_%", free_here);
}
BENCHMARK(differenceToMrptOctoMap)->Arg(5)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rgbd_graphslam

BENCHMARK_MAIN();
