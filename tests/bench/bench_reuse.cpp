/** Taking up the map of an earlier run: file, check, index of places. */
#include <benchmark/benchmark.h>

#include <filesystem>
#include <random>

#include "rgbd_graphslam/job/sparse_map_file.h"
#include "rgbd_graphslam/slam/visual_slam.h"

namespace rgbd_graphslam {
namespace {

constexpr int keypoints_a_frame = 1000, sightings_a_landmark = 4;

/** Every keyframe has 1,000 keypoints; each landmark is seen by four successive keyframes through
 *  descriptors that differ by some bits. */
MapSnapshot journey(int keyframes) {
    std::mt19937_64 random(3);
    const SlamOptions options;
    const Camera camera;
    SlamMap map(options.features.scale_factor, options.features.levels);
    std::vector<Descriptor> descriptors(keypoints_a_frame);
    for (int k = 0; k < keyframes; ++k) {
        Frame frame;
        frame.stamp_s = k;
        frame.keypoints.resize(keypoints_a_frame);
        for (int i = 0; i < keypoints_a_frame; ++i) {
            const bool first_sighting = (k + i) % sightings_a_landmark == 0 || k == 0;
            if (first_sighting) descriptors[i] = {random(), random(), random(), random()};
            descriptors[i][random() % 4] ^= std::uint64_t{1} << (random() % 64);
            frame.keypoints[i] = {static_cast<float>(random() % 640),
                                  static_cast<float>(random() % 480), 2.0f, 0, 0};
        }
        frame.descriptors = descriptors;
        const SE3 T_cam_world(Eigen::Matrix3d::Identity(), Eigen::Vector3d(-0.1 * k, 0, 0));
        map.addKeyframe(std::move(frame), T_cam_world);
        for (int i = 0; i < keypoints_a_frame; ++i) {
            const int before = k == 0 ? no_landmark : map.keyframe(k - 1).landmarks[i];
            if ((k + i) % sightings_a_landmark == 0 || before == no_landmark) {
                map.addLandmark({0.1 * k, 0, 2}, k, i);
            } else {
                map.addObservation(before, k, i);
            }
        }
    }
    return takeSnapshot(map, rigOf(camera), options.features.scale_factor, {});
}

class MapOnDisk {
  public:
    explicit MapOnDisk(int keyframes) {
        SparseMap map;
        map.snapshot = journey(keyframes);
        writeSparseMap(path, map);
    }
    ~MapOnDisk() { std::filesystem::remove(path); }
    MapOnDisk(const MapOnDisk&) = delete;
    MapOnDisk& operator=(const MapOnDisk&) = delete;

    const std::string path =
        (std::filesystem::temp_directory_path() / "bench_reuse.map.sparse").string();
};

void loadMap(benchmark::State& state) {
    const MapOnDisk disk(static_cast<int>(state.range(0)));
    for (auto _ : state) {
        SparseMap map = readSparseMap(disk.path);
        const VisualSlam slam(SlamOptions{}, Camera{}, std::move(map.snapshot), MapUse::Localize);
        benchmark::DoNotOptimize(slam.keyframes().size());
    }
    state.counters["MB"] = 1e-6 * static_cast<double>(std::filesystem::file_size(disk.path));
}
BENCHMARK(loadMap)->ArgName("keyframes")->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

void readMapFile(benchmark::State& state) {
    const MapOnDisk disk(static_cast<int>(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(readSparseMap(disk.path).snapshot.keyframes.size());
}
BENCHMARK(readMapFile)->ArgName("keyframes")->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rgbd_graphslam

BENCHMARK_MAIN();
