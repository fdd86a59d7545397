/** Matching, pose, bundle adjustment, places and the pose graph, on data whose truth is exact. */
#include <benchmark/benchmark.h>

#include "../unit/slam/synthetic_world.h"
#include "rgbd_graphslam/estimation/bundle_adjustment.h"
#include "rgbd_graphslam/estimation/global_adjustment.h"
#include "rgbd_graphslam/estimation/pose_graph.h"
#include "rgbd_graphslam/estimation/pose_solver.h"
#include "rgbd_graphslam/slam/keypoint_measurement.h"
#include "rgbd_graphslam/slam/matcher.h"
#include "rgbd_graphslam/slam/place_index.h"

namespace rgbd_graphslam {
namespace {

/** Two views of one world from places a frame apart. */
struct TwoViews {
    Camera camera;
    SE3 T_world_a = onCircle(0), T_world_b = onCircle(0.03);
    Frame a, b;

    explicit TwoViews(std::size_t keypoints) {
        SyntheticWorld world(24000);
        a = firstOf(world.view(T_world_a, 0, camera), keypoints);
        b = firstOf(world.view(T_world_b, 1, camera), keypoints);
    }

    /** Where b should see the keypoints of a. */
    std::vector<SearchWindow> windows(float radius_px) const {
        std::vector<SearchWindow> all;
        const SE3 T_b_a = T_world_b.inverse() * T_world_a;
        for (const Keypoint& k : a.keypoints) {
            const Eigen::Vector2d pixel =
                camera.project(T_b_a * camera.unproject(k.u, k.v, k.depth_m));
            all.push_back(
                {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), radius_px, 0, 1});
        }
        return all;
    }

  private:
    Frame firstOf(Frame frame, std::size_t keypoints) const {
        if (frame.keypoints.size() > keypoints) {
            frame.keypoints.resize(keypoints);
            frame.descriptors.resize(keypoints);
        }
        frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
        return frame;
    }
};

void matchInWindows(benchmark::State& state) {
    const TwoViews views(1000);
    const auto windows = views.windows(static_cast<float>(state.range(0)));
    std::size_t matched = 0;
    for (auto _ : state) {
        MatchTable table(views.b);
        for (std::size_t i = 0; i < windows.size(); ++i) {
            table.search(static_cast<int>(i), views.a.descriptors[i], windows[i], 64, 0.9f);
        }
        matched = table.matches().size();
    }
    state.counters["points"] = static_cast<double>(windows.size());
    state.counters["matched"] = static_cast<double>(matched);
}
BENCHMARK(matchInWindows)
    ->ArgName("radius_px")
    ->Arg(5)
    ->Arg(15)
    ->Arg(40)
    ->Unit(benchmark::kMicrosecond);

void matchExhaustively(benchmark::State& state) {
    const TwoViews views(1000);
    std::size_t matched = 0;
    for (auto _ : state)
        matched = matchMutually(views.a.descriptors, views.b.descriptors, 64, 0.8f).size();
    state.counters["points"] = static_cast<double>(views.a.keypoints.size());
    state.counters["matched"] = static_cast<double>(matched);
}
BENCHMARK(matchExhaustively)->Unit(benchmark::kMillisecond);

Vector6d smallMotion(SyntheticWorld& random, double size) {
    Vector6d motion;
    for (int i = 0; i < 6; ++i) motion(i) = size * random.gauss();
    return motion;
}

Keypoint noisyKeypoint(SyntheticWorld& random, const Camera& camera, const Eigen::Vector3d& p_cam) {
    const SensorOptions sensor;
    const Eigen::Vector2d pixel = camera.project(p_cam);
    const double z = p_cam.z() + sensor.depth_noise.sigma(p_cam.z()) * random.gauss();
    return {static_cast<float>(pixel.x() + sensor.keypoint_sigma_px * random.gauss()),
            static_cast<float>(pixel.y() + sensor.keypoint_sigma_px * random.gauss()),
            static_cast<float>(z), 0, 0};
}

/** 300 matches, a fifth of them wrong. */
void poseOf300Matches(benchmark::State& state) {
    SyntheticWorld random(1);
    const Camera camera;
    std::vector<PointMatch> matches;
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-0.8, 0.8),
                                random.uniform(2, 4));
        Keypoint k = noisyKeypoint(random, camera, p);
        if (i % 5 == 0) k.u = static_cast<float>(random.uniform(0, 639));
        matches.push_back({p, measurementOf(k, 1, SensorOptions())});
    }
    const SE3 start = SE3().retract(smallMotion(random, 0.01));
    int inliers = 0;
    for (auto _ : state) inliers = solvePose(camera, matches, start).inliers;
    state.counters["inliers"] = inliers;
}
BENCHMARK(poseOf300Matches)->Unit(benchmark::kMicrosecond);

/** Ten free keyframes and two that hold them, 1000 points, each seen by half of the keyframes. */
BundleProblem bundle() {
    constexpr int cameras = 12, points = 1000;
    SyntheticWorld random(1, 11);
    BundleProblem problem;
    problem.free_keyframes = cameras - 2;
    std::vector<SE3> truth;
    for (int c = 0; c < cameras; ++c) {
        truth.emplace_back(rotationExp({0.01 * c, 0.03 * c, 0}),
                           Eigen::Vector3d(0.06 * c, 0, 0.03 * c));
        const bool free = c < problem.free_keyframes;
        problem.states.keyframes.push_back(
            {truth[c].retract(smallMotion(random, free ? 0.005 : 0)), {}});
    }
    for (int p = 0; p < points; ++p) {
        const Eigen::Vector3d point(random.uniform(-1, 1), random.uniform(-0.7, 0.7),
                                    random.uniform(1.5, 4));
        problem.states.points.push_back(
            point + 0.01 * Eigen::Vector3d(random.gauss(), random.gauss(), random.gauss()));
        for (int c = p % 2; c < cameras; c += 2) {
            const Keypoint k = noisyKeypoint(random, problem.cameras[0].camera(), truth[c] * point);
            problem.observations.push_back({c, p, measurementOf(k, 1, SensorOptions())});
        }
    }
    return problem;
}

constexpr int adjustment_steps = 6;

template <class Adjust>
void measureAdjustment(benchmark::State& state, Adjust&& adjust) {
    const BundleProblem start = bundle();
    BundleSummary summary;
    for (auto _ : state) {
        BundleProblem problem = start;
        summary = adjust(problem);
    }
    state.counters["observations"] = static_cast<double>(start.observations.size());
    state.counters["cost_before"] = summary.initial_cost;
    state.counters["cost_after"] = summary.final_cost;
}

void localAdjustment(benchmark::State& state) {
    measureAdjustment(state, [](BundleProblem& p) { return adjustBundle(p, adjustment_steps); });
}
BENCHMARK(localAdjustment)->Unit(benchmark::kMillisecond);

void localAdjustmentByCeres(benchmark::State& state) {
    measureAdjustment(state,
                      [](BundleProblem& p) { return adjustBundleSparse(p, adjustment_steps); });
}
BENCHMARK(localAdjustmentByCeres)->Unit(benchmark::kMillisecond);

/** What a robot sees on its way: neighboring keyframes share four fifths of their descriptors. */
class Way {
  public:
    static constexpr int descriptors = 500, fresh = 100;

    std::vector<Descriptor> keyframe(int index) {
        while (seen_.size() < static_cast<std::size_t>(fresh) * index + descriptors) {
            seen_.push_back({random_(), random_(), random_(), random_()});
        }
        const auto first = seen_.begin() + static_cast<std::ptrdiff_t>(fresh) * index;
        std::vector<Descriptor> view(first, first + descriptors);
        for (Descriptor& d : view) {
            for (int i = 0; i < 8; ++i) d[random_() % 4] ^= std::uint64_t{1} << (random_() % 64);
        }
        return view;
    }

  private:
    std::mt19937_64 random_{3};
    std::vector<Descriptor> seen_;
};

/** Keyframes along the way, all in the index; grows from one benchmark to the next. */
struct Journey {
    Way way;
    PlaceIndex index{LoopOptions().bits_hamming};
    int keyframes = 0;

    void continueTo(int length) {
        for (; keyframes < length; ++keyframes) index.insert(keyframes, way.keyframe(keyframes));
    }
};

void placeQuery(benchmark::State& state) {
    static Journey journey;
    journey.continueTo(static_cast<int>(state.range(0)));
    const int place = journey.keyframes / 2;
    const auto query = journey.way.keyframe(place);
    std::vector<PlaceVote> votes;
    for (auto _ : state) votes = journey.index.query(query);
    state.counters["right_place"] = !votes.empty() && votes[0].keyframe == place;
    state.counters["votes"] = votes.empty() ? 0 : votes[0].votes;
}
BENCHMARK(placeQuery)
    ->ArgName("keyframes")
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond);

/** Ten rounds on a circle of 8 m radius; each pose is tied to the next and to the one a round
 *  before. */
PoseGraph rounds(int nodes) {
    constexpr double sigma_m = 0.01, sigma_rad = 0.003;
    const int per_round = nodes / 10;
    SyntheticWorld random(1, 5);
    const Eigen::Vector3d m = Eigen::Vector3d::Constant(1 / (sigma_m * sigma_m));
    const Eigen::Vector3d rad = Eigen::Vector3d::Constant(1 / (sigma_rad * sigma_rad));
    const Matrix6d information = (Vector6d() << m, rad).finished().asDiagonal();
    const auto truth = [&](int i) {
        const Eigen::Matrix3d R = rotationExp({0, 2 * 3.14159265 * i / per_round, 0});
        return SE3(R, R * Eigen::Vector3d(0, 0, 8));
    };
    PoseGraph graph;
    const auto tie = [&](int from, int to, EdgeKind kind) {
        Vector6d noise = smallMotion(random, 1);
        noise.head<3>() *= sigma_m;
        noise.tail<3>() *= sigma_rad;
        const SE3 measured = truth(from).inverse() * truth(to) * SE3().retract(noise);
        graph.edges.push_back({from, to, measured, information, kind, 50});
    };
    graph.nodes.push_back(truth(0));
    for (int i = 1; i < nodes; ++i) {
        tie(i - 1, i, EdgeKind::Sequential);
        graph.nodes.push_back(graph.nodes.back() * graph.edges.back().T_from_to);
    }
    for (int i = per_round; i < nodes; ++i) tie(i - per_round, i, EdgeKind::Loop);
    return graph;
}

void poseGraph(benchmark::State& state) {
    const PoseGraph start = rounds(static_cast<int>(state.range(0)));
    PoseGraphSummary summary;
    for (auto _ : state) {
        PoseGraph graph = start;
        summary = optimizePoseGraph(graph, PoseGraphOptions());
    }
    state.counters["edges"] = static_cast<double>(start.edges.size());
    state.counters["steps"] = summary.iterations;
    state.counters["converged"] = summary.converged;
}
BENCHMARK(poseGraph)->ArgName("poses")->Arg(200)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rgbd_graphslam

BENCHMARK_MAIN();
