#include "rgbd_graphslam/slam/tracker.h"

#include <algorithm>

#include "keypoint_alignment.h"
#include "projected_search.h"
#include "rgbd_graphslam/core/free_memory.h"
#include "rgbd_graphslam/slam/keypoint_measurement.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/matcher.h"
#include "rgbd_graphslam/slam/ransac_alignment.h"

namespace rgbd_graphslam {
namespace {

constexpr float motion_match_ratio = 0.9f;
constexpr float map_match_ratio = 0.85f;
constexpr double widest_view_change_cosine = 0.5;
/** Windows around a pose by dead reckoning reach so many standard deviations. */
constexpr double window_sigmas = 2.5;
/** With wider windows, as a share of the image, most matches would be wrong. */
constexpr double widest_window = 0.25;
constexpr int fewest_aligned = 15;
/** Of all matches, for a pose that no landmark confirms. */
constexpr double least_agreement = 0.5;

/** A point that few keyframes have seen is not only less exact: people who walk through the view
 * are made of such points, and outnumber the room when they are near. */
double trustIn(std::size_t observations) {
    constexpr double trust[] = {0.2, 0.2, 0.5, 1};
    return trust[std::min<std::size_t>(observations, 3)];
}

/** A landmark may look different from elsewhere. */
bool isSeenFromItsSide(const ProjectedLandmark& projected, const Landmark& landmark) {
    return projected.to_camera.dot(landmark.view_direction) >=
           widest_view_change_cosine * projected.distance_m;
}

/** The matched keypoints in rising order with what they show. */
struct KeypointMatches {
    std::vector<int> keypoints;
    std::vector<PointMatch> matches;
};

KeypointMatches collect(const Frame& frame, const std::vector<int>& landmarks, const SlamMap& map,
                        const SensorOptions& sensor) {
    KeypointMatches result;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        if (landmarks[i] == no_landmark) continue;
        const Keypoint& keypoint = frame.keypoints[i];
        const Landmark& landmark = map.landmark(landmarks[i]);
        result.keypoints.push_back(static_cast<int>(i));
        result.matches.push_back({landmark.position,
                                  measurementOf(keypoint, map.scaleOf(keypoint.octave), sensor),
                                  trustIn(landmark.observations.size()), keypoint.camera});
    }
    return result;
}

}  // namespace

std::vector<PointMatch> matchesOf(const Frame& frame, const std::vector<int>& landmarks,
                                  const SlamMap& map, const SensorOptions& sensor) {
    return collect(frame, landmarks, map, sensor).matches;
}

Tracker::Tracker(const SlamOptions& options, const RigCameras& cameras, SlamMap& map)
    : options_(options), cameras_(cameras), map_(map) {}

SE3 Tracker::lastPose() const {
    return last_->T_cam_reference * map_.T_cam_world(last_->reference_keyframe);
}

void Tracker::setLast(Frame frame, LocatedFrame located, int reference_keyframe, bool keep_motion) {
    motion_ = keep_motion && last_ ? located.T_cam_world * lastPose().inverse() : SE3();
    landmarks_before_ = last_ ? std::move(last_->landmarks) : std::vector<int>();
    freeMemory(frame.patches);
    last_ = Last{std::move(frame), std::move(located.landmarks), reference_keyframe,
                 located.T_cam_world * map_.T_cam_world(reference_keyframe).inverse()};
}

void Tracker::save(ByteWriter& out) const {
    encodePose(motion_, out);
    putNumbers(landmarks_before_, out);
    putFlag(hasLast(), out);
    if (!last_) return;
    put(last_->frame, out);
    putNumbers(last_->landmarks, out);
    out.putCount(last_->reference_keyframe);
    encodePose(last_->T_cam_reference, out);
}

void Tracker::load(ByteReader& in) {
    motion_ = decodePose(in);
    landmarks_before_ = getLandmarks(in, map_.landmarks().size());
    last_.reset();
    if (!getFlag(in)) return;
    Last last;
    last.frame = getFrame(in, cameras_, map_.levels());
    last.landmarks = getLandmarks(in, map_.landmarks().size());
    if (last.landmarks.size() != last.frame.keypoints.size()) {
        throw DamagedBytes("landmarks of a frame without their keypoints");
    }
    last.reference_keyframe = getIndex(in, map_.keyframes().size(), "keyframe");
    last.T_cam_reference = decodePose(in);
    last_ = std::move(last);
}

std::vector<FeatureView> Tracker::features() const {
    std::vector<FeatureView> features;
    if (!last_) return features;
    for (std::size_t i = 0; i < last_->landmarks.size(); ++i) {
        const Keypoint& keypoint = last_->frame.keypoints[i];
        const int landmark = last_->landmarks[i];
        const bool is_new = landmark == no_landmark;
        features.push_back({{keypoint.u, keypoint.v},
                            is_new ? FeatureView::State::New : FeatureView::State::Tracked,
                            keypoint.camera});
    }
    addMissed(features);
    return features;
}

void Tracker::addMissed(std::vector<FeatureView>& features) const {
    std::vector<int> found = last_->landmarks;
    std::sort(found.begin(), found.end());
    const SE3 T_cam_world = lastPose();
    for (const int landmark : landmarks_before_) {
        if (landmark == no_landmark || !map_.landmark(landmark).alive) continue;
        if (std::binary_search(found.begin(), found.end(), landmark)) continue;
        cameras_.visitViews(T_cam_world * map_.landmark(landmark).position,
                            [&](int camera, const Eigen::Vector2d& pixel, double /*depth_m*/) {
                                features.push_back({pixel, FeatureView::State::Lost, camera});
                                return false;
                            });
    }
}

std::optional<LocatedFrame> Tracker::track(Frame& frame, const std::optional<SE3>& by_sensors) {
    if (!last_) return std::nullopt;
    const SE3 predicted = by_sensors.value_or(motion_ * lastPose());
    for (const double window :
         {options_.tracker.motion_window_px, options_.tracker.wide_window_px}) {
        PoseSolution solution;
        const std::vector<int> landmarks = matchLast(frame, predicted, window, solution);
        if (solution.inliers < options_.tracker.min_inliers) continue;
        if (auto located =
                trackLocalMap(frame, solution.T_body_world, landmarks, KernelShape::GemanMcClure)) {
            return located;
        }
    }
    return std::nullopt;
}

std::optional<LocatedFrame> Tracker::followLast(const Frame& frame, const SE3& predicted) const {
    if (!last_) return std::nullopt;
    for (const double window :
         {options_.tracker.motion_window_px, options_.tracker.wide_window_px}) {
        PoseSolution solution;
        std::vector<int> landmarks = matchLast(frame, predicted, window, solution);
        const double matches = static_cast<double>(solution.inlier.size());
        if (solution.inliers <
            std::max<double>(options_.tracker.min_inliers, least_agreement * matches)) {
            continue;
        }
        return LocatedFrame{solution.T_body_world, std::move(landmarks), solution.inliers};
    }
    return std::nullopt;
}

/** Matches the points of the last frame, landmarks or not, and solves for the pose.
 *  \return landmarks of the inliers, one per keypoint */
std::vector<int> Tracker::matchLast(const Frame& frame, const SE3& predicted, double window_px,
                                    PoseSolution& solution) const {
    const SE3 T_world_last = lastPose().inverse();
    std::vector<Eigen::Vector3d> positions(last_->frame.keypoints.size());
    std::vector<double> trust(positions.size(), trustIn(0));
    MatchTable table(frame);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Keypoint& keypoint = last_->frame.keypoints[i];
        const int landmark = last_->landmarks[i];
        if (landmark != no_landmark && map_.landmark(landmark).alive) {
            positions[i] = map_.landmark(landmark).position;
            trust[i] = trustIn(map_.landmark(landmark).observations.size());
        } else if (keypoint.depth_m > 0) {
            positions[i] = T_world_last * cameras_.pointOf(keypoint);
        } else {
            continue;
        }
        const auto radius = static_cast<float>(window_px * map_.scaleOf(keypoint.octave));
        cameras_.visitViews(predicted * positions[i], [&](int camera, const Eigen::Vector2d& pixel,
                                                          double /*depth_m*/) {
            return table.search(static_cast<int>(i), last_->frame.descriptors[i],
                                windowAt(camera, pixel, radius, keypoint.octave),
                                options_.tracker.max_hamming, motion_match_ratio);
        });
    }
    const auto pairs = table.matches();
    std::vector<PointMatch> matches;
    for (const auto& [keypoint, point] : pairs) {
        const Keypoint& k = frame.keypoints[keypoint];
        matches.push_back({positions[point],
                           measurementOf(k, map_.scaleOf(k.octave), options_.sensor), trust[point],
                           k.camera});
    }
    solution = solvePose(cameras_.mounted(), matches, predicted);
    std::vector<int> landmarks(frame.keypoints.size(), no_landmark);
    for (std::size_t m = 0; m < pairs.size(); ++m) {
        const int landmark = last_->landmarks[pairs[m].second];
        if (!solution.inlier[m] || landmark == no_landmark) continue;
        if (map_.landmark(landmark).alive) landmarks[pairs[m].first] = landmark;
    }
    return landmarks;
}

std::optional<LocatedFrame> Tracker::trackLocalMap(Frame& frame, const SE3& T_cam_world,
                                                   const std::vector<int>& landmarks,
                                                   KernelShape kernel) {
    LocatedFrame located;
    located.landmarks = landmarks;
    located.expected = searchLocalLandmarks(frame, T_cam_world, located.landmarks);
    if (options_.tracker.align_keypoints) {
        alignKeypoints(frame, located.landmarks, T_cam_world, cameras_, map_);
    }
    const auto found = collect(frame, located.landmarks, map_, options_.sensor);
    const PoseSolution solution = solvePose(cameras_.mounted(), found.matches, T_cam_world, kernel);
    if (solution.inliers < options_.tracker.min_inliers) return std::nullopt;
    located.T_cam_world = solution.T_body_world;
    located.inliers = solution.inliers;
    located.information = solution.information;
    for (std::size_t m = 0; m < found.keypoints.size(); ++m) {
        const int keypoint = found.keypoints[m];
        int& landmark = located.landmarks[keypoint];
        if (solution.inlier[m]) {
            map_.noteFound(landmark);
        } else {
            landmark = no_landmark;
            frame.keypoints[keypoint].aligned = false;
        }
    }
    return located;
}

bool Tracker::solveAgain(const Frame& frame, LocatedFrame& located) const {
    const auto found = collect(frame, located.landmarks, map_, options_.sensor);
    const PoseSolution solution = solvePose(cameras_.mounted(), found.matches, located.T_cam_world,
                                            KernelShape::GemanMcClure);
    if (solution.inliers < options_.tracker.min_inliers) return false;
    located.T_cam_world = solution.T_body_world;
    located.inliers = solution.inliers;
    located.information = solution.information;
    for (std::size_t m = 0; m < found.keypoints.size(); ++m)
        if (!solution.inlier[m]) located.landmarks[found.keypoints[m]] = no_landmark;
    return true;
}

/** Living landmarks of the keyframes that see the matched ones, without the matched ones. */
std::vector<int> Tracker::localLandmarks(const std::vector<int>& matched) {
    ++search_;
    visited_.resize(map_.landmarks().size(), 0);
    for (const int landmark : matched) {
        if (landmark != no_landmark) visited_[landmark] = search_;
    }
    auto keyframes = map_.observers(matched);
    if (keyframes.empty() && last_) keyframes = {{last_->reference_keyframe, 0}};
    if (static_cast<int>(keyframes.size()) > options_.tracker.max_local_keyframes) {
        keyframes.resize(options_.tracker.max_local_keyframes);
    }
    std::vector<int> numbers;
    for (const Covisibility& c : keyframes) numbers.push_back(c.keyframe);
    return landmarksOf(numbers);
}

/** Without those that this search has visited. */
std::vector<int> Tracker::landmarksOf(const std::vector<int>& keyframes) {
    std::vector<int> local;
    for (const int keyframe : keyframes) {
        for (const int landmark : map_.keyframe(keyframe).landmarks) {
            if (landmark == no_landmark || visited_[landmark] == search_) continue;
            visited_[landmark] = search_;
            local.push_back(landmark);
        }
    }
    return local;
}

std::optional<LocatedFrame> Tracker::trackAround(Frame& frame, const ExpectedPose& expected,
                                                 const std::vector<int>& keyframes) {
    std::vector<int> landmarks(frame.keypoints.size(), no_landmark);
    const auto aligned = alignAround(frame, expected, keyframes, landmarks);
    if (!aligned) return std::nullopt;
    return trackLocalMap(frame, *aligned, landmarks);
}

/** \param landmarks of the keypoints that agree with the pose */
std::optional<SE3> Tracker::alignAround(const Frame& frame, const ExpectedPose& expected,
                                        const std::vector<int>& keyframes,
                                        std::vector<int>& landmarks) {
    std::vector<std::pair<int, int>> pairs;
    std::vector<PointMatch> matches;
    std::vector<Eigen::Vector3d> points_cam;
    for (const auto& [keypoint, id] : matchAround(frame, expected, keyframes)) {
        const Keypoint& k = frame.keypoints[keypoint];
        if (k.depth_m <= 0) continue;
        pairs.emplace_back(keypoint, id);
        matches.push_back({map_.landmark(id).position,
                           measurementOf(k, map_.scaleOf(k.octave), options_.sensor), 1, k.camera});
        points_cam.push_back(cameras_.pointOf(k));
    }
    if (static_cast<int>(matches.size()) < fewest_aligned) return std::nullopt;
    const auto aligned =
        alignRobustly(cameras_, matches, points_cam, options_.loops.ransac_iterations, 0);
    if (!aligned || aligned->inliers < fewest_aligned) return std::nullopt;
    for (std::size_t m = 0; m < pairs.size(); ++m) {
        if (aligned->inlier[m]) landmarks[pairs[m].first] = pairs[m].second;
    }
    return solvePose(cameras_.mounted(), matches, aligned->T_cam_world).T_body_world;
}

/** \return (keypoint, landmark) */
std::vector<std::pair<int, int>> Tracker::matchAround(const Frame& frame,
                                                      const ExpectedPose& expected,
                                                      const std::vector<int>& keyframes) {
    ++search_;
    visited_.resize(map_.landmarks().size(), 0);
    ProjectedSearch search(frame, expected.T_cam_world, cameras_, map_);
    for (const int id : landmarksOf(keyframes)) {
        search.visitViews(id, [&](const ProjectedLandmark& view) {
            const CameraModel& camera = cameras_[view.camera].camera();
            const double uncertain_px = window_sigmas * camera.pixelsPerRadian().x() *
                                        (expected.sigma_m / view.depth_m + expected.sigma_rad);
            const int octave = search.octave(view);
            if (uncertain_px > widest_window * camera.width || !search.isInPyramid(octave))
                return false;
            return search.search(view, octave,
                                 {options_.tracker.map_window_px, uncertain_px,
                                  options_.tracker.max_hamming, map_match_ratio});
        });
    }
    return search.matches();
}

/** \return how many landmarks the pose puts into the images */
int Tracker::searchLocalLandmarks(const Frame& frame, const SE3& T_cam_world,
                                  std::vector<int>& landmarks) {
    int expected = 0;
    ProjectedSearch search(frame, T_cam_world, cameras_, map_);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
        if (landmarks[i] == no_landmark) continue;
        search.reserve(static_cast<int>(i));
        map_.noteExpected(landmarks[i]);
        ++expected;
    }
    const SearchLimits limits{options_.tracker.map_window_px, 0, options_.tracker.max_hamming,
                              map_match_ratio};
    for (const int id : localLandmarks(landmarks)) {
        bool in_view = false;
        search.visitViews(id, [&](const ProjectedLandmark& view) {
            if (!isSeenFromItsSide(view, map_.landmark(id))) return false;
            const int octave = search.octave(view);
            if (!search.isInPyramid(octave)) return false;
            in_view = true;
            return search.search(view, octave, limits);
        });
        if (!in_view) continue;
        map_.noteExpected(id);
        ++expected;
    }
    for (const auto& [keypoint, landmark] : search.matches()) landmarks[keypoint] = landmark;
    return expected;
}

}  // namespace rgbd_graphslam
