#include "rgbd_graphslam/graphslam/slam_job.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "checkpoint.h"
#include "interruption.h"
#include "live_feed.h"
#include "output_texts.h"
#include "process_usage.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rgbd_observation.h"
#include "rgbd_graphslam/graphslam/frame_stream.h"
#include "rgbd_graphslam/graphslam/graph_slam_session.h"
#include "rgbd_graphslam/graphslam/sparse_map_file.h"
#include "rgbd_graphslam/live/viewer_launch.h"
#include "rgbd_graphslam/mapping/level_survey.h"
#include "rgbd_graphslam/mapping/map_builder.h"
#include "rgbd_graphslam/report/keyframe_sheet.h"
#include "rgbd_graphslam/report/run_report.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "truth_comparison.h"

namespace rgbd_graphslam {
namespace {

class Stopwatch {
  public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/** The part of the map with most of the frames. */
int largestPart(const std::vector<TrackedFrame>& frames) {
    std::map<int, int> count;
    for (const TrackedFrame& frame : frames) count[frame.part] += frame.origin != FrameOrigin::Lost;
    const auto fewer = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto most = std::max_element(count.begin(), count.end(), fewer);
    return most == count.end() ? 0 : most->first;
}

double pathLength(const Trajectory& trajectory) {
    double length = 0;
    for (std::size_t i = 1; i < trajectory.size(); ++i) {
        length += (trajectory[i].T_world_cam.t - trajectory[i - 1].T_world_cam.t).norm();
    }
    return length;
}

/** Keyframes chained by the relative poses that tracking measured between them, before any loop. */
Trajectory chained(Trajectory keyframes, const std::vector<SE3>& T_previous_keyframe) {
    for (std::size_t k = 1; k < keyframes.size(); ++k) {
        keyframes[k].T_world_cam = keyframes[k - 1].T_world_cam * T_previous_keyframe[k];
    }
    return keyframes;
}

constexpr const char* sparse_map_name = "map.sparse";

std::optional<SparseMap> readStart(const SlamJob& job) {
    if (job.map_folder.empty() || job.resume) return std::nullopt;
    return readSparseMap(job.map_folder + "/" + sparse_map_name);
}

GraphSlamSession makeSession(const SlamJob& job, const FrameStream& stream,
                             std::optional<SparseMap>& start) {
    if (!start) return {job.options.slam, stream.firstFrame()};
    return {job.options.slam, stream.firstFrame(), std::move(start->snapshot), job.map_use};
}

class Job {
  public:
    Job(const SlamJob& job, std::optional<SparseMap> start)
        : job_(job),
          start_(std::move(start)),
          stream_(job.rawlog, job.options.run),
          session_(makeSession(job, stream_, start_)),
          live_feed_(job.out_folder),
          level_(job.options.maps) {
        if (job.resume) {
            goOn();
        } else if (start_ && !job.localises()) {
            for (const KeyframeView& k : session_.slam().keyframes()) noteKeyframe(k.id);
            first_keyframe_ = static_cast<int>(T_previous_keyframe_.size());
        }
        checkpoints_.emplace(job, T_previous_keyframe_.size());
        if (!job.resume) checkpoints_->remove();  // of an earlier run
    }

    ~Job() { stream_.stop(); }  // frames read ahead are prepared by the session, which goes first
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    JobReport run() {
        if (job_.view) launchViewer(job_.out_folder);
        track();
        const bool can_go_on = interruption_.requested() && checkpoints_->enabled();
        if (can_go_on) writeCheckpoint();
        session_.finish();
        describe();
        write();
        if (can_go_on) {
            sayInfo("interrupted; --resume " + job_.out_folder + " goes on from here");
        } else {
            checkpoints_->remove();
        }
        return report_;
    }

  private:
    void goOn();
    void readOver(std::size_t frames);
    void writeCheckpoint();
    void save(ByteWriter& out) const;
    void load(ByteReader& in);

    void track();
    void trackOne(const StreamedFrame& frame);
    void noteKeyframe(int keyframe);
    void keepPictures(int keyframe, const mrpt::obs::CObservation3DRangeScan::Ptr& observation);
    std::optional<StreamedFrame> nextFrame();
    bool finished() const;
    void checkLimits();
    std::string progressNote() const;
    std::vector<std::string> allWarnings() const;

    void describe();
    void countFrames();
    Trajectory located() const;
    bool apart(int part) const { return part != part_; }
    void evaluate(const Trajectory& estimate);
    void describeLoops(const Trajectory& truth);
    void collectStages();

    MapInputs mapInputs() const;
    std::vector<MapSession> sessions() const;
    void write();
    void writeLocalisation() const;
    void writeMap();
    void writePoses(const MapInputs& upright, const SE3& T_up_world) const;
    void writeReport();
    std::string path(const char* name) const { return job_.out_folder + "/" + name; }

    const SlamJob& job_;
    std::optional<SparseMap> start_;  // its snapshot is the session's
    FrameStream stream_;
    GraphSlamSession session_;
    LiveFeed live_feed_;
    Interruption interruption_;
    WarningRecord warnings_;
    std::vector<std::string> earlier_warnings_;  // before the checkpoint
    std::optional<CheckpointWriter> checkpoints_;
    JobReport report_;
    std::optional<double> first_stamp_s_, last_stamp_s_;
    std::size_t frames_read_ = 0;           // tracked or left out
    int first_keyframe_ = 0;                // of this rawlog
    int part_ = 0;                          // of the map that is written
    std::vector<SE3> T_previous_keyframe_;  // one a keyframe, the identity for the first
    KeyframeSheet keyframe_sheet_;
    LevelSurvey level_;
    Trajectory truth_;  // beside the estimate, in its world
};

/** Takes up what the checkpoint knows. */
void Job::goOn() {
    const Checkpoint checkpoint = readCheckpoint(job_.out_folder);
    try {
        ByteReader in(checkpoint.state);
        load(in);
    } catch (const DamagedBytes& e) {
        throw Error("the checkpoint in '" + job_.out_folder + "' makes no sense: " + e.what(),
                    "run it from the start");
    }
    readOver(frames_read_);
    sayInfo("goes on at frame " + std::to_string(frames_read_) + " with " +
            std::to_string(T_previous_keyframe_.size()) + " keyframes");
}

/** Other sensors and the keyframes' images are looked at on the way. */
void Job::readOver(std::size_t frames) {
    const std::vector<TrackedFrame> tracked = session_.slam().frames();
    auto known = tracked.begin();
    for (std::size_t i = 0; i < frames; ++i) {
        const auto frame = stream_.skip();
        if (!frame) throw Error("the rawlog '" + job_.rawlog + "' ends before its checkpoint");
        for (const auto& observation : frame->before) level_.note(*observation);
        const bool left_out =
            known == tracked.end() || toSeconds(frame->observation->timestamp) != known->stamp_s;
        if (left_out) continue;
        if (!first_stamp_s_) first_stamp_s_ = known->stamp_s;
        last_stamp_s_ = known->stamp_s;
        if (known->keyframe) keepPictures(*known->keyframe, frame->observation);
        ++known;
    }
    report_.frames = tracked.size();
    report_.out_of_order = frames - tracked.size();
}

void Job::writeCheckpoint() {
    const ThreadClock clock;
    ByteWriter out;
    save(out);
    sayDetail("checkpoint: " + std::to_string(out.bytes().size() / 1000) + " kB in " +
              std::to_string(clock.cpuMs()) + " ms");
    checkpoints_->write(T_previous_keyframe_.size(), out.take());
}

void Job::save(ByteWriter& out) const {
    out.putCount(frames_read_);
    out.putCount(first_keyframe_);
    out.putCount(T_previous_keyframe_.size());
    for (const SE3& pose : T_previous_keyframe_) encodePose(pose, out);
    out.put(report_.tracking_wall_s);
    out.put(report_.tracking_cpu_s);
    out.putCount(report_.frame_times.size());
    for (const FrameTime& time : report_.frame_times) {
        out.put(time.stamp_s);
        out.put(time.wall_ms);
    }
    const auto warnings = allWarnings();
    out.putCount(warnings.size());
    for (const std::string& warning : warnings) out.putText(warning);
    putFlag(start_.has_value(), out);
    if (start_) {
        encodePose(start_->T_up_world, out);
        encode(start_->sessions, out);
    }
    session_.save(out);
}

void Job::load(ByteReader& in) {
    frames_read_ = in.get<std::uint32_t>();
    first_keyframe_ = in.get<std::int32_t>();
    T_previous_keyframe_.resize(in.getCount(pose_bytes));
    for (SE3& pose : T_previous_keyframe_) pose = decodePose(in);
    report_.tracking_wall_s = getFinite(in);
    report_.tracking_cpu_s = getFinite(in);
    report_.frame_times.resize(in.getCount(2 * sizeof(double)));
    for (FrameTime& time : report_.frame_times) {
        time.stamp_s = getFinite(in);
        time.wall_ms = getFinite(in);
    }
    earlier_warnings_.resize(in.getCount(sizeof(std::uint32_t)));
    for (std::string& warning : earlier_warnings_) warning = in.getText();
    if (getFlag(in)) {
        start_.emplace().T_up_world = decodePose(in);
        start_->sessions = decodeSessions(in);
    }
    session_.load(in);
}

std::vector<std::string> Job::allWarnings() const {
    std::vector<std::string> all = earlier_warnings_;
    const auto own = warnings_.warnings();
    all.insert(all.end(), own.begin(), own.end());
    return all;
}

void Job::track() {
    const Stopwatch watch;
    const double cpu_before = processCpuSeconds();
    const double earlier_wall_s = report_.tracking_wall_s, earlier_cpu_s = report_.tracking_cpu_s;
    Progress progress("tracking", stream_.expectedFrames());
    stream_.start([&](const RgbdImage& image) { return session_.prepare(image); });
    while (!finished()) {
        const auto frame = nextFrame();
        if (!frame) break;
        trackOne(*frame);
        ++frames_read_;
        checkLimits();
        report_.tracking_wall_s = earlier_wall_s + watch.seconds();
        report_.tracking_cpu_s = earlier_cpu_s + processCpuSeconds() - cpu_before;
        if (checkpoints_->due(T_previous_keyframe_.size())) writeCheckpoint();
        progress.expect(stream_.expectedFrames());
        progress.update(frame->index + 1, progressNote());
    }
}

bool Job::finished() const {
    const auto most = static_cast<std::size_t>(job_.options.run.max_frames);
    return interruption_.requested() || !report_.limit.empty() ||
           (most > 0 && report_.frames >= most);
}

void Job::checkLimits() {
    const RunOptions& run = job_.options.run;
    std::string reached;
    if (run.max_keyframes > 0 && T_previous_keyframe_.size() >= std::size_t(run.max_keyframes)) {
        reached = "max_keyframes = " + std::to_string(run.max_keyframes);
    } else if (run.max_memory_mb > 0 && peakMemoryMb() >= run.max_memory_mb) {
        reached = "max_memory_mb = " + std::to_string(run.max_memory_mb);
    }
    if (reached.empty()) return;
    report_.limit =
        "the limit " + reached + " is reached after " + std::to_string(report_.frames) + " frames";
    sayWarning(report_.limit + ", the rest of the rawlog is left out; raise it in [RunOptions]");
}

std::optional<StreamedFrame> Job::nextFrame() {
    try {
        return stream_.next();
    } catch (const Error& e) {
        report_.damage = e.what();
        return std::nullopt;
    }
}

void Job::trackOne(const StreamedFrame& frame) {
    for (const auto& observation : frame.before) level_.note(*observation);
    const double stamp_s = frame.prepared.stamp_s;
    if (last_stamp_s_ && stamp_s <= *last_stamp_s_) {
        if (report_.out_of_order++ == 0) {
            sayWarning("frame " + std::to_string(frame.index) + " at " + std::to_string(stamp_s) +
                       " s is not later than the one before and is left out, as are all such");
        }
        return;
    }
    last_stamp_s_ = stamp_s;
    if (!first_stamp_s_) first_stamp_s_ = stamp_s;
    ++report_.frames;
    const Stopwatch watch;
    const TrackedFrame tracked = session_.step(frame.observation, frame.prepared);
    report_.frame_times.push_back({stamp_s, 1e3 * watch.seconds()});
    live_feed_.note(frame, tracked, report_.frame_times.back().wall_ms, session_);
    if (!tracked.keyframe) return;
    noteKeyframe(*tracked.keyframe);
    keepPictures(*tracked.keyframe, frame.observation);
}

/** Of the frame last looked at: what report and maps will need. */
void Job::keepPictures(int keyframe, const mrpt::obs::CObservation3DRangeScan::Ptr& observation) {
    const RgbdImage image = toRgbdImage(observation);
    keyframe_sheet_.add(keyframe, *last_stamp_s_ - *first_stamp_s_, image.color);
    if (!start_) level_.addKeyframe(keyframe, image, cameraOf(*observation));
}

void Job::noteKeyframe(int keyframe) {
    T_previous_keyframe_.push_back(keyframe > 0 ? session_.slam().odometryEdge(keyframe).T_from_to
                                                : SE3());
}

std::string Job::progressNote() const {
    const std::size_t loops = session_.slam().loops().size();
    return std::to_string(T_previous_keyframe_.size()) + " keyframes" +
           (loops > 0 ? ", " + std::to_string(loops) + " loops" : "");
}

void Job::describe() {
    report_.interrupted = interruption_.requested();
    const VisualSlam& slam = session_.slam();
    part_ = start_ ? slam.keyframes().front().part : largestPart(slam.frames());
    countFrames();
    const auto all = sessions();
    for (std::size_t s = 0; s + 1 < all.size(); ++s) {
        const int keyframes = all[s + 1].first_keyframe - all[s].first_keyframe;
        report_.earlier.push_back({all[s].rawlog, static_cast<std::size_t>(keyframes)});
    }
    for (const KeyframeView& keyframe : slam.keyframes()) {
        ++report_.keyframes;
        report_.culled_keyframes += keyframe.culled;
        if (apart(keyframe.part)) report_.apart_keyframes.push_back(keyframe.id);
    }
    report_.landmarks = slam.landmarks().size();
    for (const PoseEdge& edge : slam.poseGraph().edges) {
        if (edge.kind == EdgeKind::Covisibility) report_.covisibility_edges.push_back(edge);
    }
    if (report_.apart > 0) {
        sayWarning(std::to_string(report_.apart) +
                   " frames are in parts of the map that no loop has joined with the rest: they "
                   "have no pose in trajectory.txt");
    }
    const Trajectory trajectory = located();
    report_.path_m = pathLength(trajectory);
    evaluate(trajectory);
    collectStages();
}

void Job::countFrames() {
    for (const TrackedFrame& frame : session_.slam().frames()) {
        report_.tracked += frame.origin == FrameOrigin::Tracked;
        report_.recovered += frame.origin == FrameOrigin::Recovered;
        report_.weak += frame.origin == FrameOrigin::Weak;
        report_.lost += frame.origin == FrameOrigin::Lost;
        report_.apart += frame.origin != FrameOrigin::Lost && apart(frame.part);
    }
}

/** Frames with a known place in the map. */
Trajectory Job::located() const {
    Trajectory trajectory;
    for (const TrackedFrame& frame : session_.slam().frames()) {
        if (frame.origin == FrameOrigin::Lost || apart(frame.part)) continue;
        trajectory.push_back({frame.stamp_s, frame.T_world_cam});
    }
    return trajectory;
}

void Job::evaluate(const Trajectory& estimate) {
    Trajectory truth = stream_.truth();
    for (StampedPose& pose : truth) pose.T_world_cam = pose.T_world_cam * session_.T_base_cam();
    describeLoops(truth);
    const auto comparison = compareWithTruth(estimate, truth);
    if (!comparison) return;
    report_.ate_rmse_m = comparison->ate.translation_m.rmse;
    report_.ate_pairs = comparison->ate.pairs.size();
    report_.ate_fitted_scale = comparison->ate.fitted_scale;
    truth_ = comparison->truth;
}

/** The truth is of this rawlog only, whatever stamps the keyframes of an earlier session have. */
void Job::describeLoops(const Trajectory& truth) {
    const std::vector<KeyframeView> keyframes = session_.slam().keyframes();
    const auto is_false = [](const ReportedLoop& loop) {
        return loop.error_m && *loop.error_m > false_loop_m;
    };
    for (const PoseEdge& edge : session_.slam().poseGraph().edges) {
        if (edge.kind != EdgeKind::Loop) continue;
        ReportedLoop loop{edge.from, edge.to, edge.inliers, std::nullopt};
        if (!job_.localises() && std::min(edge.from, edge.to) >= first_keyframe_) {
            loop.error_m =
                edgeErrorM(edge, keyframes[edge.from].stamp_s, keyframes[edge.to].stamp_s, truth);
        }
        report_.loops.push_back(loop);
    }
    if (truth.empty() || job_.localises()) return;
    report_.false_loops = std::count_if(report_.loops.begin(), report_.loops.end(), is_false);
}

void Job::collectStages() {
    report_.stages = stream_.times().all();
    const auto of_session = session_.stageTimes();
    report_.stages.insert(report_.stages.end(), of_session.begin(), of_session.end());
}

MapInputs Job::mapInputs() const {
    MapInputs inputs;
    inputs.rawlog = job_.rawlog;
    inputs.earlier = report_.earlier;
    inputs.trajectory = located();
    inputs.apart = report_.apart_keyframes;
    for (const KeyframeView& keyframe : session_.slam().keyframes()) {
        inputs.keyframes.push_back({keyframe.stamp_s, keyframe.T_world_cam});
    }
    for (const ReportedLoop& loop : report_.loops) {
        inputs.loops.push_back({loop.from, loop.to, loop.inliers});
    }
    if (!inputs.loops.empty()) {
        inputs.keyframes_before_loops = chained(inputs.keyframes, T_previous_keyframe_);
    }
    return inputs;
}

/** The earlier ones' and this one. */
std::vector<MapSession> Job::sessions() const {
    std::vector<MapSession> all;
    if (start_) all = start_->sessions;
    const std::string rawlog = std::filesystem::absolute(job_.rawlog).lexically_normal().string();
    all.push_back({rawlog, first_keyframe_});
    return all;
}

void Job::writePoses(const MapInputs& upright, const SE3& T_up_world) const {
    writeTextAtomically(path("trajectory.txt"), toTumText(upright.trajectory));
    writeTextAtomically(path("keyframes.txt"), toTumText(upright.keyframes));
    if (!upright.keyframes_before_loops.empty()) {
        writeTextAtomically(path("keyframes_before_loops.txt"),
                            toTumText(upright.keyframes_before_loops));
    }
    if (!truth_.empty()) {
        Trajectory truth = truth_;
        for (StampedPose& pose : truth) pose.T_world_cam = T_up_world * pose.T_world_cam;
        writeTextAtomically(path("truth.txt"), toTumText(truth));
    }
    session_.writeGraph(path("graph.graph"), T_up_world);
}

void Job::writeReport() {
    const Stopwatch watch;
    writeAtomically(path("keyframes.jpg"), [&](const std::string& temporary) {
        return cv::imwrite(temporary, keyframe_sheet_.picture(), {cv::IMWRITE_JPEG_QUALITY, 80});
    });
    writeRunReport(job_.out_folder, job_.out_folder);
    sayDetail("report.html took " + std::to_string(1e3 * watch.seconds()) + " ms");
}

void Job::write() {
    writeTextAtomically(path("config.ini"), configText(job_.options));
    writeTextAtomically(path("frames.csv"), framesCsv(session_.slam().frames()));
    writeTextAtomically(path("frame_times.csv"), frameTimesCsv(report_.frame_times));
    if (start_ && located().empty()) {
        throw Error("none of the " + std::to_string(report_.frames) + " frames of '" + job_.rawlog +
                        "' was found in the map of '" + job_.map_folder + "'",
                    "check that both show the same place, and the calibration");
    }
    if (job_.localises()) {
        writeLocalisation();
    } else {
        writeMap();
    }
    report_.peak_memory_mb = peakMemoryMb();
    report_.warnings = allWarnings();
    writeTextAtomically(path("summary.json"), summaryJson(job_, report_));
    const bool has_keyframes = report_.keyframes > static_cast<std::size_t>(first_keyframe_);
    if (!job_.localises() && has_keyframes) writeReport();
}

void Job::writeLocalisation() const {
    Trajectory trajectory = located();
    for (StampedPose& pose : trajectory) pose.T_world_cam = start_->T_up_world * pose.T_world_cam;
    writeTextAtomically(path("trajectory.txt"), toTumText(trajectory));
}

void Job::writeMap() {
    writeTextAtomically(path("covisibility.csv"), covisibilityCsv(report_.covisibility_edges));
    const MapInputs inputs = mapInputs();
    if (inputs.keyframes.empty()) {
        if (!report_.damage.empty()) throw Error(report_.damage);
        throw Error("none of the " + std::to_string(report_.frames) + " frames of '" + job_.rawlog +
                        "' could start a map",
                    "check depth scale and calibration, and that the camera sees texture");
    }
    const SE3 T_up_world =
        start_ ? start_->T_up_world : level_.uprightFromWorld(inputs, session_.T_base_cam());
    const MapInputs upright = transformed(T_up_world, inputs);
    writePoses(upright, T_up_world);
    writeSparseMap(path(sparse_map_name),
                   {session_.slam().snapshot(), T_up_world, configHash(job_.options), sessions()});
    const Stopwatch watch;
    if (job_.options.run.dense_maps) writeMaps(upright, job_.options.maps, job_.out_folder);
    report_.maps_wall_s = watch.seconds();
}

}  // namespace

SlamJob resumedJob(const std::string& out_folder) {
    SlamJob job = readCheckpoint(out_folder).job;
    job.resume = true;
    return job;
}

JobReport runSlamJob(const SlamJob& job) {
    auto start = readStart(job);
    makeWritableFolder(job.out_folder);
    return Job(job, std::move(start)).run();
}

}  // namespace rgbd_graphslam
