#include "run_scene.h"

#include <algorithm>
#include <utility>

#include "rgbd_graphslam/core/free_memory.h"
#include "rgbd_graphslam/mapping/framing.h"
#include "rgbd_graphslam/viewer/keyframe_view.h"
#include "rgbd_graphslam/viewer/scene_parts.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t most_moving_triangles = 40000;
/** Above the floor, and above the first camera while the floor is not known. */
constexpr double lowest_ceiling_m = 2, lowest_live_ceiling_m = 0.6, no_ceiling_m = 1e9;

/** Two vertices for every line up to a stamp. */
template <class List>
std::size_t verticesUntil(const List& list, std::optional<double> stamp_s) {
    if (!stamp_s) return whole;
    const auto end = std::upper_bound(list.begin(), list.end(), *stamp_s,
                                      [](double s, const auto& e) { return s < e.stamp_s; });
    return 2 * static_cast<std::size_t>(end - list.begin());
}

}  // namespace

void RunScene::show(RunData run) {
    run_ = std::move(run);
    live_revision_.reset();
    lowest_ceiling_m_ = run_.up_is_guessed ? no_ceiling_m : lowest_ceiling_m;
    Framing framing = framingOf(run_.points, run_.keyframes, run_.trajectory,
                                ceilingCut(run_.trajectory, lowest_ceiling_m_));
    box_ = framing.box;
    framed_ = std::move(framing.points);
    contents_ = contentsOf(run_);
    pictures_.assign(run_.keyframes.size(), {});
    renderer_.clearKeyframePoints();
    floor_.reset();
    if (!box_.isEmpty()) floor_ = floorGrid(box_);
    renderer_.geometry().setLines(Part::Floor,
                                  floor_ ? floorLines(*floor_, floor_color) : Vertices{});
    showPoses();
    showTruth();
    renderer_.geometry().setTriangles(Part::Grid,
                                      run_.grid ? gridTriangles(*run_.grid) : Vertices{});
    renderer_.geometry().setMesh({}, {}, {});
    renderer_.geometry().setOctree({});
    renderer_.geometry().setFreeSpace({});
    renderer_.setPoints(chunked(pointVertices(run_.points)));
    freeMemory(run_.points);  // the renderer has them
}

void RunScene::showPoses() {
    renderer_.geometry().setLines(Part::Path,
                                  pathLines(run_.trajectory, run_.unplaced_s, trajectory_color));
    renderer_.geometry().setLines(Part::Loops, edgeLines(run_.keyframes, run_.loops, loop_color));
    renderer_.geometry().setLines(Part::Covisibility,
                                  edgeLines(run_.keyframes, run_.covisibility, covisibility_color));
    Vertices before;
    const auto sessions = pieces(run_.keyframes_before_loops, run_.earlier_keyframes);
    for (const Trajectory& session : sessions) {
        const bool is_latest = &session == &sessions.back();  // unplaced frames are of that one
        const Vertices lines =
            pathLines(session, is_latest ? run_.unplaced_s : std::vector<double>(), before_color);
        before.insert(before.end(), lines.begin(), lines.end());
    }
    renderer_.geometry().setLines(Part::BeforeLoops, before);
    setCamera(camera_);
}

void RunScene::showTruth() {
    errors_ = trueErrors(run_.trajectory, run_.truth);
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
    error_scale_ = visibleScale(errors_, box_.isEmpty() ? 0 : box_.diagonal().norm());
    for (const TrueError& error : errors_) {
        const Eigen::Vector3d way = error.truth - error.estimate;
        pairs.emplace_back(error.estimate, error.estimate + error_scale_ * way);
    }
    renderer_.geometry().setLines(Part::Errors, pairLines(pairs, error_color));
    // The truth has poses at frames only: one without shows that nobody measured.
    std::vector<double> frames_s = run_.unplaced_s;
    for (const StampedPose& pose : run_.trajectory) frames_s.push_back(pose.stamp_s);
    std::sort(frames_s.begin(), frames_s.end());
    renderer_.geometry().setLines(Part::TruePath, pathLines(run_.truth, frames_s, truth_color));
}

void RunScene::update(const LiveRun& live) {
    if (live_revision_ == live.revisions()) return extendPath(live.run());
    live_revision_ = live.revisions();
    run_ = live.run();
    contents_ = liveContents();
    lowest_ceiling_m_ = lowest_live_ceiling_m;
    if (live.lastFrame()) camera_ = live.lastFrame()->camera;
    for (const StampedPose& pose : run_.trajectory) box_.extend(pose.T_world_cam.t);
    showPoses();
}

/** \param longer what run_ was, with new poses behind */
void RunScene::extendPath(const RunData& longer) {
    const std::size_t old = run_.trajectory.size();
    run_.unplaced_s = longer.unplaced_s;
    run_.trajectory.insert(run_.trajectory.end(),
                           longer.trajectory.begin() + static_cast<std::ptrdiff_t>(old),
                           longer.trajectory.end());
    const std::size_t joint = std::max<std::size_t>(old, 1) - 1;  // the last pose drawn so far
    const Trajectory added(run_.trajectory.begin() + static_cast<std::ptrdiff_t>(joint),
                           run_.trajectory.end());
    for (const StampedPose& pose : added) box_.extend(pose.T_world_cam.t);
    renderer_.geometry().extendLines(Part::Path, 2 * joint,
                                     pathLines(added, run_.unplaced_s, trajectory_color));
}

void RunScene::showClouds(const std::vector<std::pair<std::size_t, Vertices>>& clouds) {
    for (const auto& [keyframe, points] : clouds) showCloud(keyframe, points);
}

void RunScene::showCloud(std::size_t keyframe, const Vertices& points) {
    renderer_.setKeyframePoints(keyframe, points);
    if (renderer_.points() > 0) return;  // the map is larger, and has fewer strays
    Eigen::AlignedBox3f box;
    for (const Vertex& point : points) box.extend(point.position);
    box_.extend(box.cast<double>());
}

void RunScene::setCamera(const Camera& camera) {
    camera_ = camera;
    const double depth_m = frustumDepth(run_.keyframes);
    drawn_keyframes_ = sparseKeyframes(run_.keyframes, depth_m);
    Trajectory drawn;
    for (const std::size_t k : drawn_keyframes_) drawn.push_back(run_.keyframes[k]);
    renderer_.geometry().setLines(Part::Keyframes,
                                  frustumLines(drawn, camera, depth_m, keyframe_color));
}

std::size_t RunScene::keyframeVertices(std::size_t keyframes) const {
    const auto end = std::lower_bound(drawn_keyframes_.begin(), drawn_keyframes_.end(), keyframes);
    return vertices_a_frustum * static_cast<std::size_t>(end - drawn_keyframes_.begin());
}

void RunScene::add(RecordingLoader::News news) {
    if (news.camera) setCamera(*news.camera);
    for (KeyframePicture& picture : news.pictures) {
        showCloud(picture.keyframe, picture.points);
        freeMemory(picture.points);  // the renderer has them
        pictures_[picture.keyframe] = std::move(picture);
    }
}

void RunScene::frame(OrbitCamera& camera, const Eigen::Vector2i& size_px,
                     const Eigen::Vector2d& share) const {
    if (renderer_.points() > 0 && !framed_.empty()) {
        camera.frame(framed_, size_px, share);
    } else if (!box_.isEmpty()) {  // grown by the clouds of keyframes
        camera.frame(box_, size_px, share);
    }
}

void RunScene::markNow(std::optional<double> stamp_s) {
    if (stamp_s == now_s_) return;
    now_s_ = stamp_s;
    const auto pose = stamp_s ? poseNear(run_.trajectory, *stamp_s) : std::nullopt;
    renderer_.geometry().setLines(Part::NowCamera,
                                  pose ? frustumLines({{*stamp_s, *pose}}, camera_,
                                                      2 * frustumDepth(run_.keyframes), now_color)
                                       : Vertices{});
}

void RunScene::select(std::optional<std::size_t> keyframe) {
    Vertices lines;
    if (keyframe) {
        lines = frustumLines({run_.keyframes[*keyframe]}, camera_, 2 * frustumDepth(run_.keyframes),
                             selection_color);
    }
    renderer_.geometry().setLines(Part::Selection, lines);
}

void RunScene::markPoints(const std::vector<Eigen::Vector3d>& points, double cross_m) {
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> lines;
    for (const Eigen::Vector3d& point : points) {
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d arm = cross_m * Eigen::Vector3d::Unit(axis);
            lines.emplace_back(point - arm, point + arm);
        }
    }
    if (points.size() == 2) lines.emplace_back(points[0], points[1]);
    renderer_.geometry().setLines(Part::Measure, pairLines(lines, measure_color));
}

void RunScene::prepare(const ViewerSettings& settings) {
    if (settings.mesh && !run_.mesh.triangles.empty()) {
        renderer_.geometry().setMesh(meshVertices(run_.mesh), run_.mesh.triangles,
                                     fewerTriangles(run_.mesh, most_moving_triangles));
        run_.mesh = {};  // the renderer has it
    }
    if (settings.octree && !run_.octree.occupied.empty())
        renderer_.geometry().setOctree(outerFaces(std::exchange(run_.octree.occupied, {})));
    if (settings.free_space && !run_.octree.free.empty())
        renderer_.geometry().setFreeSpace(outerFaces(std::exchange(run_.octree.free, {})));
}

SceneView RunScene::viewAt(std::optional<double> stamp_s, const ViewerSettings& settings) const {
    const ReplayState now = replayAt(run_, stamp_s.value_or(1e300));
    SceneView view;
    const auto put = [&](Part part, bool shown, std::size_t vertices) {
        view.of(part) = shown ? vertices : 0;
    };
    put(Part::Floor, settings.floor, whole);
    put(Part::Grid, settings.grid, whole);
    put(Part::Mesh, settings.mesh, whole);
    put(Part::Octree, settings.octree, whole);
    put(Part::FreeSpace, settings.free_space, whole);
    put(Part::Path, settings.trajectory, 2 * std::max<std::size_t>(now.poses, 1) - 2);
    put(Part::Keyframes, settings.keyframes, keyframeVertices(now.keyframes));
    put(Part::Covisibility, settings.covisibility, 2 * now.covisibility);
    put(Part::Loops, settings.loops, 2 * now.loops);
    put(Part::BeforeLoops, settings.before_loops, whole);
    put(Part::TruePath, settings.truth, verticesUntil(run_.truth, stamp_s));
    put(Part::Errors, settings.errors, verticesUntil(errors_, stamp_s));
    for (const Part part : {Part::NowCamera, Part::Selection, Part::Measure})
        put(part, true, whole);
    view.points = settings.points;
    // Clouds of a running SLAM are there before the map that names their keyframes.
    const bool is_replay = stamp_s && !live_revision_, has_maps = renderer_.points() > 0;
    if (is_replay) {
        view.keyframe_clouds = std::max<std::size_t>(now.keyframes, 1);
    } else if (live_revision_ || !has_maps) {
        view.keyframe_clouds = whole;
    }
    view.color_by_height = settings.colors == "height";
    if (!box_.isEmpty()) {
        view.height_range_m = {static_cast<float>(box_.min().z()),
                               static_cast<float>(box_.max().z())};
    }
    if (settings.cut_ceiling) {
        view.highest_m = static_cast<float>(ceilingCut(run_.trajectory, lowest_ceiling_m_));
    }
    view.least_point_px = static_cast<float>(settings.point_size_px);
    return view;
}

const KeyframePicture* RunScene::picture(std::size_t keyframe) const {
    const bool there = keyframe < pictures_.size() && !pictures_[keyframe].color_jpeg.empty();
    return there ? &pictures_[keyframe] : nullptr;
}

}  // namespace rgbd_graphslam
