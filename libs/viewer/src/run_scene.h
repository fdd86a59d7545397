/** A run in the 3-D view. */
#pragma once
#include <optional>
#include <vector>

#include "rgbd_graphslam/mapping/view_scale.h"
#include "rgbd_graphslam/viewer/live_run.h"
#include "rgbd_graphslam/viewer/recording_loader.h"
#include "rgbd_graphslam/viewer/replay.h"
#include "rgbd_graphslam/viewer/run_data.h"
#include "rgbd_graphslam/viewer/true_errors.h"
#include "rgbd_graphslam/viewer/view_switches.h"
#include "rgbd_graphslam/viewer/viewer_settings.h"
#include "scene_renderer.h"

namespace rgbd_graphslam {

/** Keeps the run's data and fills the renderer with them. */
class RunScene {
  public:
    explicit RunScene(SceneRenderer& renderer) : renderer_(renderer) {}

    /** Takes the place of the run before. */
    void show(RunData run);
    /** Poses and loops of a run that goes on. */
    void update(const LiveRun& live);
    void showClouds(const std::vector<std::pair<std::size_t, Vertices>>& clouds);
    void add(RecordingLoader::News news);
    /** \param stamp_s where the camera is drawn; nothing draws none */
    void markNow(std::optional<double> stamp_s);
    void select(std::optional<std::size_t> keyframe);
    /** One point as a cross, two with a line between them. */
    void markPoints(const std::vector<Eigen::Vector3d>& points, double cross_m);

    /** Makes what is switched on for the first time and takes long to make. */
    void prepare(const ViewerSettings& settings);
    /** What is drawn at a moment. \param stamp_s nothing stands for the whole run */
    SceneView viewAt(std::optional<double> stamp_s, const ViewerSettings& settings) const;

    const RunData& run() const { return run_; }
    /** None where the truth is not known. */
    const std::vector<TrueError>& errors() const { return errors_; }
    /** How many times longer than they are errors are drawn. */
    int errorScale() const { return error_scale_; }
    /** \return nullptr while it is not read */
    const KeyframePicture* picture(std::size_t keyframe) const;
    Eigen::AlignedBox3d box() const { return box_; }
    /** Turns a camera's view on most of the map. \param share as OrbitCamera::frame() takes it */
    void frame(OrbitCamera& camera, const Eigen::Vector2i& size_px,
               const Eigen::Vector2d& share) const;
    /** Nothing without a map. */
    const std::optional<FloorGrid>& floor() const { return floor_; }
    const RunContents& contents() const { return contents_; }

  private:
    void showCloud(std::size_t keyframe, const Vertices& points);
    void showPoses();
    void showTruth();
    void extendPath(const RunData& longer);
    void setCamera(const Camera& camera);
    /** Of the first so many keyframes. */
    std::size_t keyframeVertices(std::size_t keyframes) const;

    SceneRenderer& renderer_;
    RunData run_;
    std::optional<std::size_t> live_revision_;
    RunContents contents_;
    Eigen::AlignedBox3d box_;
    std::vector<Eigen::Vector3d> framed_;  // within the box; few where there is no fused map
    std::optional<FloorGrid> floor_;
    std::vector<std::size_t> drawn_keyframes_;  // rising
    Camera camera_;
    std::vector<TrueError> errors_;
    int error_scale_ = 1;
    std::vector<KeyframePicture> pictures_;  // one per keyframe, empty while not read
    std::optional<double> now_s_;
    double lowest_ceiling_m_ = 2;
};

}  // namespace rgbd_graphslam
