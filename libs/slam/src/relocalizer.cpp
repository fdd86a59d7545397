#include "relocalizer.h"

#include <algorithm>
#include <utility>

#include "keyframe_alignment.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr int most_places = 5;
/** Views further apart from the predicted one show little of it; a radian counts as a meter. */
constexpr double widest_view_m = 4, widest_view_rad = 1.2;
/** Candidates closer to each other are one place. */
constexpr double one_place_m = 0.2, one_place_rad = 0.2;
/** A second place with this share of the best one's inliers leaves it undecided. */
constexpr double rival_share = 0.6;
/** One frame is enough with so many times the inliers of a loop, and after a loss also this share
 * of the landmarks that should be in sight: a place that merely looks alike shows fewer of them. */
constexpr double convincing_inliers = 1.5, convincing_share = 0.25;
/** Otherwise so many frames in a row must show the place, the camera moving no faster. */
constexpr int convincing_frames = 3;
constexpr double fastest_m_s = 2, fastest_rad_s = 2, slack_m = 0.05, slack_rad = 0.05;

struct Distance {
    double m = 0, rad = 0;
};

Distance between(const SE3& a, const SE3& b) {
    const SE3 motion = a * b.inverse();
    return {motion.t.norm(), motion.angle()};
}

}  // namespace

std::optional<LocatedFrame> Relocalizer::find(Frame& frame,
                                              const std::optional<Prediction>& predicted) {
    std::vector<Candidate> candidates;
    const auto add = [&](std::optional<Candidate> candidate) {
        if (!candidate || candidate->agreement == Agreement::Contradicted) return false;
        candidates.push_back(std::move(*candidate));
        return candidates.back().agreement == Agreement::Confirmed;
    };
    const bool confirmed = predicted && add(lookAround(frame, *predicted));
    if (!confirmed) {
        for (const int keyframe : places_.placesLike(frame, most_places)) {
            add(lookAt(frame, keyframe, predicted));
        }
    }
    const Candidate* best = likeliest(candidates);
    if (!best || !believes(*best, predicted.has_value())) {
        if (!best) forget();
        return std::nullopt;
    }
    forget();
    frame = best->frame;
    return best->located;
}

/** Living keyframes with a view like the predicted one, nearest first. */
std::vector<int> Relocalizer::keyframesAround(const Prediction& predicted) const {
    std::vector<std::pair<double, int>> near;
    for (const Keyframe& keyframe : map_.keyframes()) {
        if (keyframe.culled || keyframe.submap != predicted.submap) continue;
        const Distance apart = between(keyframe.T_cam_world, predicted.T_cam_world);
        if (apart.m > predicted.prior.scale() * widest_view_m || apart.rad > widest_view_rad)
            continue;
        near.emplace_back(apart.m + apart.rad, keyframe.id);
    }
    std::sort(near.begin(), near.end());
    const auto most = static_cast<std::size_t>(options_.tracker.max_local_keyframes);
    if (near.size() > most) near.resize(most);
    std::vector<int> keyframes;
    keyframes.reserve(near.size());
    for (const auto& [distance, keyframe] : near) keyframes.push_back(keyframe);
    return keyframes;
}

std::optional<Relocalizer::Candidate> Relocalizer::lookAround(const Frame& frame,
                                                              const Prediction& predicted) {
    const PoseSpread& spread = predicted.prior.spread();
    Frame copy = frame;
    auto located = tracker_.trackAround(copy, {predicted.T_cam_world, spread.m, spread.rad},
                                        keyframesAround(predicted));
    if (!located) return std::nullopt;
    Candidate candidate = judged(std::move(copy), std::move(*located), predicted);
    const bool enough = candidate.agreement == Agreement::Confirmed ||
                        candidate.located.inliers >= options_.loops.min_inliers;
    if (!enough) return std::nullopt;
    return candidate;
}

/** As much proof as a loop needs: a wrong place is worse than none. */
std::optional<Relocalizer::Candidate> Relocalizer::lookAt(
    const Frame& frame, int keyframe, const std::optional<Prediction>& predicted) {
    const auto aligned =
        alignWithKeyframe(frame, map_.keyframe(keyframe), map_, cameras_, options_);
    if (!aligned) return std::nullopt;
    Frame copy = frame;
    auto located = tracker_.trackLocalMap(copy, aligned->T_cam_world, aligned->landmarks);
    if (!located || located->inliers < options_.loops.min_inliers) return std::nullopt;
    return judged(std::move(copy), std::move(*located), predicted);
}

Relocalizer::Candidate Relocalizer::judged(Frame frame, LocatedFrame located,
                                           const std::optional<Prediction>& predicted) const {
    Candidate candidate;
    candidate.submap = map_.keyframe(map_.observers(located.landmarks).front().keyframe).submap;
    if (predicted && predicted->submap == candidate.submap) {
        candidate.agreement =
            predicted->prior.judge(predicted->T_cam_world * located.T_cam_world.inverse());
    }
    candidate.frame = std::move(frame);
    candidate.located = std::move(located);
    return candidate;
}

/** \return none where another place is nearly as good */
const Relocalizer::Candidate* Relocalizer::likeliest(
    const std::vector<Candidate>& candidates) const {
    const auto better = [](const Candidate& a, const Candidate& b) {
        const bool a_confirmed = a.agreement == Agreement::Confirmed;
        const bool b_confirmed = b.agreement == Agreement::Confirmed;
        if (a_confirmed != b_confirmed) return a_confirmed;
        return a.located.inliers > b.located.inliers;
    };
    const Candidate* best = nullptr;
    for (const Candidate& candidate : candidates) {
        if (!best || better(candidate, *best)) best = &candidate;
    }
    if (!best || best->agreement == Agreement::Confirmed) return best;
    for (const Candidate& other : candidates) {
        const Distance apart = between(best->located.T_cam_world, other.located.T_cam_world);
        const bool elsewhere = other.submap != best->submap ||
                               apart.m > sceneScale(best->frame) * one_place_m ||
                               apart.rad > one_place_rad;
        if (elsewhere && other.located.inliers > rival_share * best->located.inliers) {
            return nullptr;
        }
    }
    return best;
}

/** \param after_a_loss rather than at the start of a run, where there is no trajectory to bend */
bool Relocalizer::believes(const Candidate& candidate, bool after_a_loss) {
    const LocatedFrame& located = candidate.located;
    if (candidate.agreement == Agreement::Confirmed) return true;
    if (located.inliers >= convincing_inliers * options_.loops.min_inliers &&
        (!after_a_loss || located.inliers >= convincing_share * located.expected)) {
        return true;
    }
    const double stamp_s = candidate.frame.stamp_s;
    bool goes_on = false;
    if (supposed_) {
        const SE3 before = supposed_->T_cam_keyframe * map_.T_cam_world(supposed_->keyframe);
        const Distance moved = between(located.T_cam_world, before);
        const double passed_s = stamp_s - supposed_->stamp_s;
        goes_on = map_.keyframe(supposed_->keyframe).submap == candidate.submap &&
                  moved.m < sceneScale(candidate.frame) * (slack_m + fastest_m_s * passed_s) &&
                  moved.rad < slack_rad + fastest_rad_s * passed_s;
    }
    const int keyframe = map_.observers(located.landmarks).front().keyframe;
    supposed_ = Supposition{keyframe, located.T_cam_world * map_.T_cam_world(keyframe).inverse(),
                            stamp_s, goes_on ? supposed_->frames + 1 : 1};
    return supposed_->frames >= convincing_frames;
}

void Relocalizer::save(ByteWriter& out) const {
    putFlag(supposed_.has_value(), out);
    if (!supposed_) return;
    out.putCount(supposed_->keyframe);
    encodePose(supposed_->T_cam_keyframe, out);
    out.put(supposed_->stamp_s);
    out.put<std::int32_t>(supposed_->frames);
}

void Relocalizer::load(ByteReader& in) {
    supposed_.reset();
    if (!getFlag(in)) return;
    Supposition supposed;
    supposed.keyframe = getIndex(in, map_.keyframes().size(), "keyframe");
    supposed.T_cam_keyframe = decodePose(in);
    supposed.stamp_s = getFinite(in);
    supposed.frames = getTally(in);
    supposed_ = supposed;
}

}  // namespace rgbd_graphslam
