#include "bag_sensors.h"

#include <algorithm>

#include "bag_calibration.h"
#include "lower_case.h"
#include "ros_observations.h"

namespace rgbd_graphslam {
namespace {

bool namesWorld(const std::string& frame) {
    const std::string name = lowerCase(frame);
    const std::vector<std::string> words = {"world",     "map",      "mocap",        "vicon",
                                            "optitrack", "qualisys", "ground_truth", "groundtruth"};
    return std::any_of(words.begin(), words.end(),
                       [&](const std::string& word) { return contains(name, word); });
}

bool namesOdometry(const std::string& frame) {
    return contains(lowerCase(frame), "odom");
}

std::string countOf(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what;
}

/** Characters at the start that two names share. */
std::size_t sharedStart(const std::string& a, const std::string& b) {
    const auto end = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    return static_cast<std::size_t>(end.first - a.begin());
}

/** The topic with readings whose name shares most with `beside`; the first of equals. */
const ImuTopic* nearestWith(const std::vector<ImuTopic>& topics, const std::string& beside,
                            std::vector<StampedVector> ImuTopic::*readings) {
    const ImuTopic* nearest = nullptr;
    for (const ImuTopic& topic : topics) {
        const bool nearer =
            !nearest || sharedStart(topic.name, beside) > sharedStart(nearest->name, beside);
        if (!(topic.*readings).empty() && nearer) nearest = &topic;
    }
    return nearest;
}

/** The path of the robot's base in a frame named odom; `named` says which. */
Trajectory odometryOfTree(const FrameTree& frames, std::string& named) {
    Trajectory best;
    bool best_is_base = false;
    for (const std::string& frame : frames.frames()) {
        const bool is_base = contains(frame, "base");
        for (const std::string& above : frames.framesAbove(frame)) {
            if (!namesOdometry(above) || (best_is_base && !is_base)) continue;
            const Trajectory path = frames.pathOf(frame, above);
            if (path.empty() || (is_base == best_is_base && !best.empty())) continue;
            best = path;
            best_is_base = is_base;
            named = above + " to " + frame;
        }
    }
    return best;
}

}  // namespace

std::optional<SE3> Mounts::of(const std::string& frame) const {
    if (reference_.empty()) return namesBase(frame) ? std::optional(SE3()) : std::nullopt;
    const auto T = frames_.fixedPose(reference_, frame);
    if (!T) return std::nullopt;
    return T_base_reference_ * *T;
}

const ImuTopic* takeImu(const BagSurvey& survey, const std::string& beside, RgbdSequence& sequence,
                        std::vector<std::string>& used) {
    const ImuTopic* acceleration = nearestWith(survey.imus, beside, &ImuTopic::acceleration);
    const ImuTopic* gyroscope = nearestWith(survey.imus, beside, &ImuTopic::angular_velocity);
    if (acceleration) {
        sequence.acceleration = acceleration->acceleration;
        used.push_back(acceleration->name);
        sequence.notes.push_back("accelerometer: " + acceleration->name + ", " +
                                 countOf(sequence.acceleration.size(), "readings"));
    }
    if (gyroscope) {
        sequence.angular_velocity = gyroscope->angular_velocity;
        used.push_back(gyroscope->name);
        sequence.notes.push_back("gyroscope: " + gyroscope->name + ", " +
                                 countOf(sequence.angular_velocity.size(), "readings"));
    }
    return acceleration ? acceleration : gyroscope;
}

void takeOdometry(const BagSurvey& survey, RgbdSequence& sequence, std::vector<std::string>& used) {
    for (const OdometryTopic& topic : survey.odometry) {
        if (namesWorld(topic.frame) || namesWorld(topic.name)) continue;
        sequence.odometry = topic.poses;
        used.push_back(topic.name);
        sequence.notes.push_back("odometry: " + topic.name + ", " +
                                 countOf(topic.poses.size(), "poses in the plane"));
        return;
    }
    std::string named;
    for (const auto& [stamp_s, T] : odometryOfTree(survey.frames, named)) {
        sequence.odometry.push_back({stamp_s, planarPose(T)});
    }
    if (sequence.odometry.empty()) return;
    sequence.notes.push_back("odometry: /tf, " + named + ", " +
                             countOf(sequence.odometry.size(), "poses in the plane"));
}

void takeTruth(const BagSurvey& survey, const std::string& camera_frame, RgbdSequence& sequence) {
    std::string world;
    for (const std::string& above : survey.frames.framesAbove(camera_frame)) {
        if (!namesWorld(above)) continue;
        Trajectory path = survey.frames.pathOf(camera_frame, above);
        if (path.size() <= sequence.truth.size()) continue;
        sequence.truth = std::move(path);
        world = above;
    }
    sequence.notes.push_back(
        sequence.truth.empty()
            ? "no ground truth: in /tf the camera does not move in a frame named after a world, a "
              "map or a motion capture system"
            : "ground truth: /tf, " + world + " to " + camera_frame + ", " +
                  countOf(sequence.truth.size(), "poses"));
}

void takeScans(const BagSurvey& survey, const Mounts& mounts, RgbdSequence& sequence,
               std::vector<std::string>& used) {
    for (const auto& topic : survey.scans) {
        const auto T_base_laser = mounts.of(topic.messages.front().header.frame);
        for (const ros::LaserScan& scan : topic.messages) {
            sequence.others.push_back(
                toObservation(scan, topic.name, T_base_laser ? *T_base_laser : SE3()));
        }
        used.push_back(topic.name);
        sequence.notes.push_back("laser: " + topic.name + ", " +
                                 countOf(topic.messages.size(), "scans") +
                                 (T_base_laser ? "" : "; its pose on the robot is not recorded"));
    }
}

void takeFixes(const BagSurvey& survey, const Mounts& mounts, RgbdSequence& sequence,
               std::vector<std::string>& used) {
    for (const auto& topic : survey.fixes) {
        const auto T_base_antenna = mounts.of(topic.messages.front().header.frame);
        for (const ros::NavSatFix& fix : topic.messages) {
            sequence.others.push_back(
                toObservation(fix, topic.name, T_base_antenna ? *T_base_antenna : SE3()));
        }
        used.push_back(topic.name);
        sequence.notes.push_back("GPS: " + topic.name + ", " +
                                 countOf(topic.messages.size(), "fixes"));
    }
}

}  // namespace rgbd_graphslam
