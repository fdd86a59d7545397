#include "rgbd_graphslam/slam/visual_slam.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rgbd_graphslam/core/error.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

constexpr double pi = 3.14159265358979;

struct SlamRun {
    std::vector<TrackedFrame> frames;
    std::vector<SE3> truth;
    int loops = 0;
    int keyframes = 0;
    long living_keyframes = 0;

    /** Largest distance between estimate and truth, both seen from the first frame, m. */
    double largestError() const {
        double worst = 0;
        const SE3 T_first = frames[0].T_world_cam * truth[0].inverse();
        for (std::size_t i = 0; i < frames.size(); ++i) {
            if (frames[i].origin == FrameOrigin::Lost) continue;
            worst = std::max(worst, (frames[i].T_world_cam.t - (T_first * truth[i]).t).norm());
        }
        return worst;
    }
};

/** \param poses T_world_cam a frame; none = a covered camera */
SlamRun runOn(const std::vector<std::optional<SE3>>& poses, SlamOptions options = {},
              SyntheticWorld world = SyntheticWorld(24000)) {
    const Camera camera;
    VisualSlam slam(options, camera);
    SlamRun run;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Frame frame;
        frame.grid = KeypointGrid({}, camera.width, camera.height);
        if (poses[i]) frame = world.view(*poses[i], 0, camera);
        frame.stamp_s = 0.033 * (i + 1);
        const TrackedFrame tracked = slam.track(std::move(frame));
        run.truth.push_back(poses[i].value_or(SE3()));
        if (!tracked.keyframe) continue;
        ++run.keyframes;
        run.loops += !slam.closeLoops(*tracked.keyframe).empty();
    }
    slam.finish();
    run.frames = slam.frames();
    const auto all = slam.keyframes();
    run.living_keyframes =
        std::count_if(all.begin(), all.end(), [](const KeyframeView& k) { return !k.culled; });
    return run;
}

std::vector<std::optional<SE3>> circle(double turns, int frames) {
    std::vector<std::optional<SE3>> poses;
    for (int i = 0; i < frames; ++i) poses.emplace_back(onCircle(2 * pi * turns * i / frames));
    return poses;
}

long lost(const SlamRun& run) {
    return std::count_if(run.frames.begin(), run.frames.end(),
                         [](const TrackedFrame& f) { return f.origin == FrameOrigin::Lost; });
}

TEST(VisualSlam, tracksEveryFrameOfAnExactWorldToMillimetres) {
    const SlamRun run = runOn(circle(0.4, 100));
    EXPECT_EQ(lost(run), 0);
    EXPECT_LT(run.largestError(), 0.01);
    EXPECT_GT(run.keyframes, 5);
}

TEST(VisualSlam, closesTheLoopOfAFullTurn) {
    const SlamRun run = runOn(circle(1.15, 260));
    EXPECT_EQ(lost(run), 0);
    EXPECT_GE(run.loops, 1);
    EXPECT_LT(run.largestError(), 0.015);
}

/** From the walls of SyntheticWorld, m. */
double distanceFromWalls(const Eigen::Vector3d& p) {
    constexpr double inner = 2.8, outer = 3;
    const auto off = [&](double at) {
        return std::max({0.0, inner - std::abs(at), std::abs(at) - outer});
    };
    return std::min(off(p.x()), off(p.z()));
}

TEST(VisualSlam, pointsWithoutDepthBecomeLandmarksWhereTheyAre) {
    const Camera camera;
    SyntheticWorld world(24000);
    VisualSlam slam({}, camera);
    for (int i = 0; i < 40; ++i) {
        Frame frame = world.view({Eigen::Matrix3d::Identity(), {0.03 * i, 0, 0}}, 0, camera);
        frame.stamp_s = 0.033 * (i + 1);
        for (Keypoint& k : frame.keypoints) {
            if (camera.toPlane({k.u, k.v}).y() < 0) k.depth_m = 0;
        }
        ASSERT_EQ(slam.track(std::move(frame)).origin, FrameOrigin::Tracked) << i;
    }
    slam.finish();
    int above = 0, astray = 0;
    for (const LandmarkView& landmark : slam.landmarks()) {
        if (landmark.position.y() > -0.1) continue;
        ++above;
        astray += distanceFromWalls(landmark.position) > 0.1;
    }
    EXPECT_GT(above, 100);
    EXPECT_LT(astray, above / 20);
}

std::vector<std::optional<SE3>> alongWall(double length_m) {
    std::vector<std::optional<SE3>> poses;
    for (double x = 2; x < 2 + length_m; x += 0.05) {
        poses.emplace_back(SE3(Eigen::Matrix3d::Identity(), {x, 0, 0}));
    }
    return poses;
}

TEST(VisualSlam, takesNoPlaceThatMerelyLooksAlikeForALoop) {
    const SyntheticWorld wall = SyntheticWorld::repeatingWall(5, 4);
    const SlamRun run = runOn(alongWall(12), {}, wall);
    EXPECT_EQ(run.loops, 0);
    EXPECT_LT(run.largestError(), 0.03);
    SlamOptions gullible;
    gullible.loops.max_drift_share = 1;
    EXPECT_GT(runOn(alongWall(12), gullible, wall).loops, 0) << "the places do not look alike";
}

/** There and back over a quarter of the circle. */
std::vector<std::optional<SE3>> swings(int count) {
    std::vector<std::optional<SE3>> poses;
    for (int i = 0; i < 80 * count; ++i) {
        poses.emplace_back(onCircle(pi / 4 * (1 - std::cos(2 * pi * i / 80))));
    }
    return poses;
}

TEST(VisualSlam, aMapOfOnePlaceStopsGrowing) {
    const SlamRun few = runOn(swings(3)), many = runOn(swings(9));
    EXPECT_GT(few.keyframes, 5);
    EXPECT_LT(many.keyframes, 1.4 * few.keyframes);
    EXPECT_LT(many.largestError(), 0.02);
}

/** Keeps the first keypoints of a frame, which lie anywhere. */
void keepShare(double share, Frame& frame, const Camera& camera) {
    const auto kept = static_cast<std::size_t>(share * static_cast<double>(frame.keypoints.size()));
    frame.keypoints.resize(kept);
    frame.descriptors.resize(kept);
    frame.grid = KeypointGrid(frame.keypoints, camera.width, camera.height);
}

TEST(VisualSlam, aPlaceThatFadesIsMappedAnew) {
    const Camera camera;
    SyntheticWorld world(24000);
    VisualSlam slam({}, camera);
    const auto poses = swings(3);
    std::size_t keyframes_before = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        Frame frame = world.view(*poses[i], 0.033 * (i + 1), camera);
        const double fading = std::max(0.0, static_cast<double>(i) / 80 - 1) / 2;
        keepShare(1 - 0.8 * fading, frame, camera);
        EXPECT_EQ(slam.track(std::move(frame)).origin, FrameOrigin::Tracked) << i;
        if (i < 80) keyframes_before = slam.keyframes().size();
    }
    EXPECT_GT(slam.keyframes().size(), keyframes_before + 2);
}

/** Where the way leaves what is known, the keyframe before lies elsewhere. */
TEST(VisualSlam, aKeyframeAfterKnownViewsIsTiedToWhatItSees) {
    const Camera camera;
    SyntheticWorld world(24000);
    VisualSlam slam({}, camera);
    for (int i = 0; i < 450; ++i) {
        const double turn = 0.65 * (1 - std::cos(2 * pi * i / 180));
        const SE3 T_world_cam = onCircle(i < 360 ? turn : -turn);
        const TrackedFrame tracked = slam.track(world.view(T_world_cam, 0.033 * (i + 1), camera));
        EXPECT_EQ(tracked.origin, FrameOrigin::Tracked) << i;
    }
    slam.finish();
    const PoseGraph graph = slam.poseGraph();
    int leaps = 0;
    for (const PoseEdge& edge : graph.edges) {
        if (edge.kind != EdgeKind::Sequential || edge.T_from_to.angle() < 1) continue;
        ++leaps;
        EXPECT_LT(edge.information(0, 0), 1);
        EXPECT_TRUE(std::any_of(graph.edges.begin(), graph.edges.end(), [&](const PoseEdge& e) {
            return e.to == edge.to && e.from < edge.from && e.information(0, 0) > 1e4;
        }));
    }
    EXPECT_EQ(leaps, 1);
}

TEST(VisualSlam, keyframesThatTellNothingNewGo) {
    SlamOptions dense;
    dense.keyframes.max_translation_ratio = dense.keyframes.min_translation_ratio;
    dense.keyframes.max_rotation_rad = dense.keyframes.min_rotation_rad;
    const SlamRun run = runOn(swings(1), dense);
    EXPECT_GT(run.keyframes, 30);
    EXPECT_LT(run.living_keyframes, run.keyframes / 2);
    EXPECT_LT(run.largestError(), 0.02);
}

TEST(VisualSlam, comesBackAfterTheCameraWasCovered) {
    auto poses = circle(0.3, 80);
    for (int i = 40; i < 50; ++i) poses[i].reset();
    for (int i = 50; i < 80; ++i) poses[i] = onCircle(2 * pi * 0.3 * (90 - i) / 80);
    const SlamRun run = runOn(poses);
    for (int i = 40; i < 50; ++i) EXPECT_EQ(run.frames[i].origin, FrameOrigin::Lost) << i;
    EXPECT_EQ(run.frames[50].origin, FrameOrigin::Recovered);
    EXPECT_EQ(run.frames[60].origin, FrameOrigin::Tracked);
    EXPECT_LT(run.largestError(), 0.01);
}

/** Part of the circle, covered, then another part that shows nothing of the first. */
std::vector<std::optional<SE3>> kidnapped(double until_turns) {
    auto poses = circle(0.15, 50);
    poses.resize(60);
    for (double turns = 0.5; turns < until_turns; turns += 0.003) {
        poses.emplace_back(onCircle(2 * pi * turns));
    }
    return poses;
}

TEST(VisualSlam, beginsANewPartWhereNothingIsKnown) {
    const SlamRun run = runOn(kidnapped(0.7));
    const int patience = SlamOptions().recovery.new_submap_after;
    for (int i = 50; i < 60 + patience - 1; ++i) {
        EXPECT_EQ(run.frames[i].origin, FrameOrigin::Lost) << i;
    }
    EXPECT_EQ(run.frames[0].submap, 0);
    for (std::size_t i = 60 + patience - 1; i < run.frames.size(); ++i) {
        EXPECT_EQ(run.frames[i].origin, FrameOrigin::Tracked) << i;
        EXPECT_NE(run.frames[i].submap, 0) << i;
    }
}

TEST(VisualSlam, joinsPartsByALoop) {
    const SlamRun run = runOn(kidnapped(1.1));
    EXPECT_GE(run.loops, 1);
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
        if (run.frames[i].origin == FrameOrigin::Lost) continue;
        EXPECT_EQ(run.frames[i].submap, 0) << i;
    }
    EXPECT_LT(run.largestError(), 0.02);
    EXPECT_LT(lost(run), 40);
}

TEST(VisualSlam, odometryTiesFramesWhileTheCameraIsCovered) {
    SyntheticWorld world(24000);
    const Camera camera;
    VisualSlam slam(SlamOptions{}, camera);
    for (int i = 0; i < 90; ++i) {
        const SE3 truth = onCircle(0.02 * i);
        Frame frame;
        frame.grid = KeypointGrid({}, camera.width, camera.height);
        const bool covered = i >= 30 && i < 70;
        if (!covered) frame = world.view(truth, 0, camera);
        frame.stamp_s = 0.033 * (i + 1);
        frame.reckoning.T_odometry_cam = truth;
        const TrackedFrame tracked = slam.track(std::move(frame));
        // In what was not seen before, the map goes on after some frames.
        const bool begun_anew = i < 30 || i > 80;
        if (covered || begun_anew) {
            EXPECT_EQ(tracked.origin, covered ? FrameOrigin::DeadReckoned : FrameOrigin::Tracked)
                << i;
        }
        EXPECT_EQ(tracked.submap, 0);
        EXPECT_LT((tracked.T_world_cam.t - (onCircle(0).inverse() * truth).t).norm(), 0.02) << i;
    }
}

Frame coveredFrame(const Camera& camera, double stamp_s) {
    Frame frame;
    frame.grid = KeypointGrid({}, camera.width, camera.height);
    frame.stamp_s = stamp_s;
    return frame;
}

/** Along a wall that repeats every 1.6 m; the lens is covered while the robot drives on into what
 *  it has not seen yet, which looks like what it has. */
TEST(VisualSlam, aPlaceThatLooksAlikeIsNotBelievedAgainstTheWheels) {
    auto world = SyntheticWorld::repeatingWall(1.6, 12);
    const Camera camera;
    VisualSlam slam(SlamOptions{}, camera);
    for (int i = 0; i < 260; ++i) {
        const SE3 truth(Eigen::Matrix3d::Identity(), Eigen::Vector3d(3 + 0.02 * i, 0, 0));
        const bool covered = i >= 60 && i < 180;
        Frame frame =
            covered ? coveredFrame(camera, i / 30.0) : world.view(truth, i / 30.0, camera);
        frame.reckoning.T_odometry_cam =
            SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0202 * i, 0, 0));
        const TrackedFrame tracked = slam.track(std::move(frame));
        EXPECT_NE(tracked.origin, FrameOrigin::Lost) << i;
        EXPECT_LT((tracked.T_world_cam.t - Eigen::Vector3d(0.02 * i, 0, 0)).norm(), 0.05) << i;
    }
}

/** Corners that noise makes before something flat are no scene to go on from. */
TEST(VisualSlam, makesNoMapOfNoise) {
    SyntheticWorld world;
    const Camera camera;
    VisualSlam slam(SlamOptions{}, camera);
    for (int i = 0; i < 30; ++i) slam.track(world.view(onCircle(0.01 * i), i / 30.0, camera));
    const std::size_t keyframes = slam.keyframes().size();
    for (int i = 30; i < 90; ++i) {
        SyntheticWorld noise(12000, i);
        const TrackedFrame tracked = slam.track(noise.view(onCircle(0.3), i / 30.0, camera));
        EXPECT_EQ(tracked.origin, FrameOrigin::Lost) << i;
    }
    EXPECT_EQ(slam.keyframes().size(), keyframes);
}

/** A map of part of the circle, and the world it was made in. */
struct MappedWorld {
    SyntheticWorld world{24000};
    Camera camera;
    MapSnapshot map;

    MappedWorld() {
        VisualSlam slam(SlamOptions{}, camera);
        for (int i = 0; i < 60; ++i) slam.track(world.view(onCircle(0.02 * i), i + 1, camera));
        slam.finish();
        map = slam.snapshot();
    }
};

/** The circle on from the middle of the map to beyond its end. */
std::vector<TrackedFrame> localizedOnTheCircle(MappedWorld& mapped, int frames, VisualSlam& slam) {
    for (int i = 0; i < frames; ++i) {
        const auto frame =
            slam.track(mapped.world.view(onCircle(0.8 + 0.02 * i), i + 1, mapped.camera));
        if (frame.keyframe) slam.closeLoops(*frame.keyframe);
    }
    slam.finish();
    return slam.frames();
}

TEST(VisualSlam, localizesInAMapThatStaysWhereItIs) {
    MappedWorld mapped;
    VisualSlam slam(SlamOptions{}, mapped.camera, mapped.map, MapUse::Localize);
    const auto frames = localizedOnTheCircle(mapped, 60, slam);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const SE3 truth = onCircle(0).inverse() * onCircle(0.8 + 0.02 * static_cast<double>(i));
        EXPECT_EQ(frames[i].origin, i == 0 ? FrameOrigin::Recovered : FrameOrigin::Tracked) << i;
        EXPECT_LT((frames[i].T_world_cam.t - truth.t).norm(), 0.01) << i;
    }
    const auto keyframes = slam.keyframes();
    for (const Keyframe& before : mapped.map.keyframes) {
        const KeyframeView& after = keyframes[before.id];
        EXPECT_EQ(after.culled, before.culled);
        if (before.culled) continue;
        EXPECT_LT(((before.T_cam_world * after.T_world_cam).t).norm(), 1e-9) << before.id;
    }
}

std::vector<std::pair<int, int>> covisibleEnds(const PoseGraph& graph) {
    std::vector<std::pair<int, int>> pairs;
    for (const PoseEdge& edge : graph.edges) {
        if (edge.kind == EdgeKind::Covisibility) pairs.emplace_back(edge.from, edge.to);
    }
    return pairs;
}

TEST(VisualSlam, tellsWhatItsGraphConnectsWithoutMakingIt) {
    MappedWorld mapped;
    VisualSlam slam(SlamOptions{}, mapped.camera, mapped.map, MapUse::Extend);
    localizedOnTheCircle(mapped, 60, slam);
    EXPECT_GT(slam.covisibility().size(), 3u);
    EXPECT_EQ(slam.covisibility(), covisibleEnds(slam.poseGraph()));
}

TEST(VisualSlam, keepsFewOfItsOwnKeyframesWhereItLocalizes) {
    MappedWorld mapped;
    SlamOptions options;
    options.mapper.localization_keyframes = 3;
    VisualSlam slam(options, mapped.camera, mapped.map, MapUse::Localize);
    const auto frames = localizedOnTheCircle(mapped, 60, slam);
    std::size_t own = 0, living = 0;
    for (const KeyframeView& keyframe : slam.keyframes()) {
        if (keyframe.id < static_cast<int>(mapped.map.keyframes.size())) continue;
        ++own;
        living += !keyframe.culled;
    }
    EXPECT_GT(own, 6u);
    EXPECT_LE(living, 3u);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const SE3 truth = onCircle(0).inverse() * onCircle(0.8 + 0.02 * static_cast<double>(i));
        EXPECT_LT((frames[i].T_world_cam.t - truth.t).norm(), 0.02) << i;
    }
}

TEST(VisualSlam, localizesWithAnotherCamera) {
    MappedWorld mapped;
    Intrinsics other = mapped.camera.intrinsics();
    other.fx *= 1.1;
    other.fy *= 1.1;
    other.cx += 5;
    mapped.camera = other;
    VisualSlam slam(SlamOptions{}, mapped.camera, mapped.map, MapUse::Localize);
    const auto frames = localizedOnTheCircle(mapped, 40, slam);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const SE3 truth = onCircle(0).inverse() * onCircle(0.8 + 0.02 * static_cast<double>(i));
        EXPECT_NE(frames[i].origin, FrameOrigin::Lost) << i;
        EXPECT_LT((frames[i].T_world_cam.t - truth.t).norm(), 0.01) << i;
    }
}

TEST(VisualSlam, extendsAMapBeyondWhatItShowed) {
    MappedWorld mapped;
    VisualSlam slam(SlamOptions{}, mapped.camera, mapped.map, MapUse::Extend);
    for (int i = 0; i < 60; ++i) {
        const SE3 truth = onCircle(0.8 + 0.02 * i);
        const auto frame = slam.track(mapped.world.view(truth, i + 1, mapped.camera));
        if (frame.keyframe) slam.findLoops(*frame.keyframe);
    }
    slam.finish();
    const auto frames = slam.frames();
    for (int i = 0; i < 60; ++i) {
        const SE3 truth = onCircle(0).inverse() * onCircle(0.8 + 0.02 * i);
        EXPECT_NE(frames[i].origin, FrameOrigin::Lost) << i;
        EXPECT_LT((frames[i].T_world_cam.t - truth.t).norm(), 0.01) << i;
    }
    EXPECT_GT(slam.keyframes().size(), mapped.map.keyframes.size() + 3);
    EXPECT_GT(slam.snapshot().landmarks.size(), mapped.map.landmarks.size());
}

TEST(VisualSlam, elsewhereItIsLostAndBeginsAPartOfItsOwn) {
    MappedWorld mapped;
    const SlamOptions options;
    VisualSlam slam(options, mapped.camera, mapped.map, MapUse::Localize);
    for (int i = 1; i <= 10; ++i) {
        const auto frame = slam.track(mapped.world.view(onCircle(4 + 0.02 * i), i, mapped.camera));
        const bool lost = i < options.recovery.dead_reckoned_keyframe_after;
        EXPECT_EQ(frame.origin, lost ? FrameOrigin::Lost : FrameOrigin::Tracked) << i;
        EXPECT_EQ(frame.submap == 0, lost) << i;
    }
}

TEST(VisualSlam, refusesMapsThatDoNotFit) {
    const MappedWorld mapped;
    SlamOptions other;
    other.features.levels = 5;
    EXPECT_THROW(VisualSlam(other, mapped.camera, mapped.map, MapUse::Localize), Error);
    Intrinsics zoomed = mapped.camera.intrinsics();
    zoomed.fx *= 1.1;
    EXPECT_THROW(VisualSlam(SlamOptions{}, zoomed, mapped.map, MapUse::Extend), Error);
    EXPECT_NO_THROW(VisualSlam(SlamOptions{}, zoomed, mapped.map, MapUse::Localize));
}

TEST(VisualSlam, givesTheSameBitsTwice) {
    const SlamRun a = runOn(circle(0.3, 60)), b = runOn(circle(0.3, 60));
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (std::size_t i = 0; i < a.frames.size(); ++i) {
        EXPECT_EQ((a.frames[i].T_world_cam.t - b.frames[i].T_world_cam.t).norm(), 0);
        EXPECT_EQ((a.frames[i].T_world_cam.R - b.frames[i].T_world_cam.R).norm(), 0);
    }
}

TEST(VisualSlam, waitsForAFirstFrameWithDepth) {
    std::vector<std::optional<SE3>> poses(3);
    for (int i = 0; i < 5; ++i) poses.emplace_back(onCircle(0.01 * i));
    const SlamRun run = runOn(poses);
    EXPECT_EQ(lost(run), 3);
    EXPECT_EQ(run.frames[3].keyframe, 0);
}

TEST(VisualSlam, refusesStampsThatDoNotRise) {
    SyntheticWorld world;
    const Camera camera;
    VisualSlam slam(SlamOptions{}, camera);
    slam.track(world.view(onCircle(0), 1.0, camera));
    EXPECT_THROW(slam.track(world.view(onCircle(0), 1.0, camera)), Error);
}

TEST(VisualSlam, odometryEdgeIsTheRelativePoseWithPlausibleInformation) {
    SyntheticWorld world(24000);
    const Camera camera;
    VisualSlam slam(SlamOptions{}, camera);
    for (int i = 0; i < 60; ++i) slam.track(world.view(onCircle(0.02 * i), i + 1.0, camera));
    slam.finish();
    const auto keyframes = slam.keyframes();
    ASSERT_GE(keyframes.size(), 3u);
    const PoseEdge edge = slam.odometryEdge(2);
    const SE3 expected = keyframes[1].T_world_cam.inverse() * keyframes[2].T_world_cam;
    EXPECT_LT(edge.T_from_to.minus(expected).norm(), 1e-9);
    const Matrix6d covariance = edge.information.inverse();
    for (int i = 0; i < 6; ++i) {
        EXPECT_GT(std::sqrt(covariance(i, i)), 1e-5);
        EXPECT_LT(std::sqrt(covariance(i, i)), 0.02);
    }
}

}  // namespace
}  // namespace rgbd_graphslam
