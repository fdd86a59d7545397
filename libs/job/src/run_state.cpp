#include "run_state.h"

#include <algorithm>
#include <filesystem>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/input/masking_source.h"
#include "rgbd_graphslam/input/rawlog_source.h"

namespace rgbd_graphslam {
namespace {

/** Of the pixels, those whose depth is in the range that is used. */
double usedDepthShare(const RgbdImage& image, const FeatureOptions& features) {
    constexpr int step = 4;
    const double nearest = std::max(1.0, features.depth_min_m / image.depth_unit_m),
                 farthest = features.farthestDepthM() / image.depth_unit_m;
    std::size_t used = 0, all = 0;
    for (int v = 0; v < image.depth.rows; v += step) {
        const auto* row = image.depth.ptr<std::uint16_t>(v);
        for (int u = 0; u < image.depth.cols; u += step, ++all) {
            used += row[u] >= nearest && row[u] <= farthest;
        }
    }
    return static_cast<double>(used) / static_cast<double>(std::max<std::size_t>(1, all));
}

bool isStereo(const Rig& rig) {
    return std::all_of(rig.cameras.begin(), rig.cameras.end(),
                       [](const RigCamera& camera) { return camera.disparity_m_px > 0; });
}

/** \return the job, whose open settings the recording decides */
const SlamJob& settled(SlamJob& job, const RecordingSurvey& survey, const Rig& rig) {
    constexpr double stereo_depth_max_m = 100;  // errors grow with distance as the solvers know
    double& depth_max_m = job.options.slam.features.depth_max_m;
    if (depth_max_m > 0) return job;
    if (isStereo(rig)) {
        depth_max_m = stereo_depth_max_m;
        return job;
    }
    depth_max_m = survey.suitableDepthMaxM();
    if (depth_max_m > default_depth_max_m) {
        sayInfo(formatted("depth_max_m = %g: %.0f %% of the depth readings are beyond %g m",
                          depth_max_m, 100 * survey.shareBeyond(default_depth_max_m),
                          default_depth_max_m));
    }
    return job;
}

GraphSlamSession makeSession(const SlamJob& job, const FrameStream& stream,
                             std::optional<SparseMap>& start) {
    if (!start) return {job.options.slam, stream.rig()};
    return {job.options.slam, stream.rig(), std::move(start->snapshot), job.map_use};
}

std::shared_ptr<ObservationSource> openSource(const SlamJob& job) {
    std::shared_ptr<ObservationSource> source = job.live;
    if (!source) source = std::make_shared<RawlogSource>(job.rawlog);
    const std::string& moving = job.options.semantics.moving_classes;
    return moving.empty() ? source : std::make_shared<MaskingSource>(source, moving);
}

/** A live frame that waits for its turn is late already: one is prepared while another is tracked.
 */
ReadAhead readAhead(const SlamJob& job) {
    const RunOptions& run = job.options.run;
    if (job.live) return {std::min(run.threads, 2), 1};
    return {run.threads, run.frames_ahead};
}

}  // namespace

RunState::RunState(const SlamJob& slam_job, std::optional<SparseMap> start_map)
    : job(slam_job),
      start(std::move(start_map)),
      stream(openSource(job), readAhead(job), job.sensor_label),
      survey(stream.lookAhead(stream.surveyFrames(RecordingSurvey::frames))),
      session(makeSession(settled(job, survey, stream.rig()), stream, start)),
      level(job.options.maps),
      sensors(stream.firstFrame()) {
    if (!start) return;
    for (const KeyframeView& keyframe : session.slam().keyframes()) noteKeyframe(keyframe.id);
    first_keyframe = static_cast<int>(T_previous_keyframe.size());
}

RunState::~RunState() {
    if (job.live) job.live->end();
    stream.stop();
}

void RunState::noteKeyframe(int keyframe) {
    T_previous_keyframe.push_back(keyframe > 0 ? session.slam().odometryEdge(keyframe).T_from_to
                                               : SE3());
}

void RunState::noteEntry(const StreamedFrame& frame) {
    // The record of a live run has entries of its own, and others between.
    if (frame.camera == 0 && !job.live)
        entries.push_back({toSeconds(frame.observation->timestamp), frame.entry});
}

void RunState::keepPictures(int keyframe,
                            const mrpt::obs::CObservation3DRangeScan::Ptr& observation) {
    if (job.localizes()) return;
    const RgbdImage image = toRgbdImage(observation);
    depth_shares.push_back(usedDepthShare(image, job.options.slam.features));
    keyframe_sheet.add(keyframe, *last_stamp_s - *first_stamp_s,
                       image.color.empty() ? image.gray : image.color);
    if (!start) level.addKeyframe(keyframe, image, cameraOf(*observation));
}

std::vector<std::string> RunState::allWarnings() const {
    std::vector<std::string> all = earlier_warnings;
    const auto own = warnings.warnings();
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

std::vector<MapSession> RunState::sessions() const {
    std::vector<MapSession> all;
    if (start) all = start->sessions;
    const std::string rawlog = std::filesystem::absolute(job.rawlog).lexically_normal().string();
    all.push_back({rawlog, first_keyframe, job.sensor_label});
    return all;
}

bool RunState::hasPlace(const TrackedFrame& frame) const {
    return frame.origin != FrameOrigin::Lost && !disconnected(frame.submap);
}

Trajectory RunState::located() const {
    Trajectory trajectory;
    for (const TrackedFrame& frame : session.slam().frames()) {
        if (hasPlace(frame)) trajectory.push_back({frame.stamp_s, frame.T_world_cam});
    }
    return trajectory;
}

std::vector<double> RunState::unplaced() const {
    std::vector<double> stamps_s;
    for (const TrackedFrame& frame : session.slam().frames()) {
        if (!hasPlace(frame)) stamps_s.push_back(frame.stamp_s);
    }
    return stamps_s;
}

}  // namespace rgbd_graphslam
