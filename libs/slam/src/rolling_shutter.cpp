#include "rgbd_graphslam/slam/rolling_shutter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "rgbd_graphslam/estimation/reprojection.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t fewest_observations = 1000, most_observations = 20000;
constexpr int fewest_keyframes = 10;
constexpr int most_iterations = 100, stretches = 10;
constexpr double converged = 1e-7;
constexpr double shortest_readout_s = 0.005, clear_sigmas = 4;
/** Video cameras read an image in less than the period of 15 Hz. An estimate beyond it, as seen at
 * low resolution and 10 Hz, has another cause. */
constexpr double longest_readout_s = 1.0 / 15;

using Vectors = std::vector<Eigen::Vector2d>;

double dot(const Vectors& a, const Vectors& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

/** A block of the normal equations that can be solved however few observations it has. */
template <int n>
Eigen::LDLT<Eigen::Matrix<double, n, n>> factored(Eigen::Matrix<double, n, n> block) {
    block.diagonal().array() += 1e-9 * block.diagonal().maxCoeff() + 1e-12;
    return Eigen::LDLT<Eigen::Matrix<double, n, n>>(block);
}

/** What moves of poses and landmarks do to whitened observations: the matrix J, by its blocks. */
class Moves {
  public:
    explicit Moves(const std::vector<RowObservation>& observations) : observations_(observations) {
        for (const RowObservation& o : observations) {
            pose_of_.push_back(indexOf(o.keyframe, poses_));
            landmark_of_.push_back(indexOf(o.landmark, landmarks_));
        }
        factorBlocks();
    }

    /** Its columns taken out of `values` by conjugate gradients, each block of unknowns
     *  preconditioned by its own normal equations. */
    Vectors projectedOut(Vectors values) const {
        Eigen::VectorXd gradient = transposedTimes(values), z = preconditioned(gradient), p = z;
        double descent = gradient.dot(z);
        const double first = descent;
        for (int i = 0; i < most_iterations && descent > converged * first; ++i) {
            const Vectors q = times(p);
            const double step = descent / dot(q, q);
            for (std::size_t o = 0; o < values.size(); ++o) values[o] -= step * q[o];
            gradient = transposedTimes(values);
            z = preconditioned(gradient);
            const double before = descent;
            descent = gradient.dot(z);
            p = z + descent / before * p;
        }
        return values;
    }

  private:
    using Indices = std::map<int, int>;

    static int indexOf(int id, Indices& indices) {
        return indices.try_emplace(id, static_cast<int>(indices.size())).first->second;
    }

    void factorBlocks() {
        std::vector<Matrix6d> of_poses(poses_.size(), Matrix6d::Zero());
        std::vector<Eigen::Matrix3d> of_landmarks(landmarks_.size(), Eigen::Matrix3d::Zero());
        for (std::size_t o = 0; o < observations_.size(); ++o) {
            const RowObservation& seen = observations_[o];
            const double weight = 1 / (seen.sigma_px * seen.sigma_px);
            of_poses[pose_of_[o]] += weight * seen.by_pose.transpose() * seen.by_pose;
            of_landmarks[landmark_of_[o]] +=
                weight * seen.by_landmark.transpose() * seen.by_landmark;
        }
        for (const auto& block : of_poses) pose_blocks_.push_back(factored<6>(block));
        for (const auto& block : of_landmarks) landmark_blocks_.push_back(factored<3>(block));
    }

    Eigen::Index landmarkAt(std::size_t o) const {
        return static_cast<Eigen::Index>(6 * poses_.size()) + 3 * landmark_of_[o];
    }

    Vectors times(const Eigen::VectorXd& x) const {
        Vectors result(observations_.size());
        for (std::size_t o = 0; o < result.size(); ++o) {
            const RowObservation& seen = observations_[o];
            result[o] = (seen.by_pose * x.segment<6>(6 * pose_of_[o]) +
                         seen.by_landmark * x.segment<3>(landmarkAt(o))) /
                        seen.sigma_px;
        }
        return result;
    }

    Eigen::VectorXd transposedTimes(const Vectors& values) const {
        Eigen::VectorXd x = Eigen::VectorXd::Zero(
            static_cast<Eigen::Index>(6 * poses_.size() + 3 * landmarks_.size()));
        for (std::size_t o = 0; o < values.size(); ++o) {
            const RowObservation& seen = observations_[o];
            const Eigen::Vector2d weighted = values[o] / seen.sigma_px;
            x.segment<6>(6 * pose_of_[o]) += seen.by_pose.transpose() * weighted;
            x.segment<3>(landmarkAt(o)) += seen.by_landmark.transpose() * weighted;
        }
        return x;
    }

    Eigen::VectorXd preconditioned(Eigen::VectorXd x) const {
        for (std::size_t k = 0; k < poses_.size(); ++k) {
            auto part = x.segment<6>(static_cast<Eigen::Index>(6 * k));
            part = pose_blocks_[k].solve(part).eval();
        }
        for (std::size_t l = 0; l < landmarks_.size(); ++l) {
            auto part = x.segment<3>(static_cast<Eigen::Index>(6 * poses_.size() + 3 * l));
            part = landmark_blocks_[l].solve(part).eval();
        }
        return x;
    }

    const std::vector<RowObservation>& observations_;
    Indices poses_, landmarks_;
    std::vector<int> pose_of_, landmark_of_;
    std::vector<Eigen::LDLT<Matrix6d>> pose_blocks_;
    std::vector<Eigen::LDLT<Eigen::Matrix3d>> landmark_blocks_;
};

/** Share of a sum over observations that each stretch of them has. */
template <class Term>
std::vector<double> sumsByStretch(std::size_t observations, Term term) {
    std::vector<double> sums(stretches, 0.0);
    for (std::size_t o = 0; o < observations; ++o) sums[o * stretches / observations] += term(o);
    return sums;
}

int keyframesIn(const std::vector<RowObservation>& observations) {
    int count = 1;
    for (std::size_t o = 1; o < observations.size(); ++o) {
        count += observations[o].keyframe != observations[o - 1].keyframe;
    }
    return count;
}

double total(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

/** Image velocity of a point by the poses of the frames around, px/s. */
std::optional<Eigen::Vector2d> velocityOf(const Eigen::Vector3d& point, const StampedPose& before,
                                          const StampedPose& after, const Camera& camera) {
    const Eigen::Vector3d p0 = before.T_world_cam.inverse() * point,
                          p1 = after.T_world_cam.inverse() * point;
    if (p0.z() < nearest_depth_m || p1.z() < nearest_depth_m) return std::nullopt;
    return (camera.project(p1) - camera.project(p0)) / (after.stamp_s - before.stamp_s);
}

/** The frames just before and after a moment; nothing at the ends and in gaps. */
std::optional<std::pair<StampedPose, StampedPose>> framesAround(const Trajectory& frames,
                                                                double stamp_s) {
    constexpr double longest_s = 0.25, same_s = 1e-6;
    const auto later = [](const StampedPose& pose, double s) { return pose.stamp_s < s; };
    const auto at = std::lower_bound(frames.begin(), frames.end(), stamp_s - same_s, later);
    const bool known = at != frames.end() && std::abs(at->stamp_s - stamp_s) < same_s;
    if (!known || at == frames.begin() || at + 1 == frames.end()) return std::nullopt;
    if ((at + 1)->stamp_s - (at - 1)->stamp_s > longest_s) return std::nullopt;
    return std::pair(*(at - 1), *(at + 1));
}

std::optional<RowObservation> rowObservation(const MapSnapshot& map, const Keyframe& keyframe,
                                             int keypoint, const StampedPose& before,
                                             const StampedPose& after) {
    const int landmark = keyframe.landmarks[static_cast<std::size_t>(keypoint)];
    const bool by_first = keyframe.frame.keypoints[static_cast<std::size_t>(keypoint)].camera == 0;
    if (landmark == no_landmark || !by_first) return std::nullopt;
    const Eigen::Vector3d& point = map.landmarks[static_cast<std::size_t>(landmark)].position;
    const Eigen::Vector3d p = keyframe.T_cam_world * point;
    const Camera camera = map.rig.cameras.front().model.rectified();
    const auto velocity = velocityOf(point, before, after, camera);
    if (!velocity || p.z() < nearest_depth_m) return std::nullopt;
    const Keypoint& seen = keyframe.frame.keypoints[static_cast<std::size_t>(keypoint)];
    const Measurement plain{seen.u, seen.v, 0, 1, 0};
    RowObservation o;
    o.keyframe = keyframe.id;
    o.landmark = landmark;
    o.row = (seen.v + 0.5) / camera.height - 0.5;
    o.residual_px = -residual(camera, p, plain).head<2>();
    o.sigma_px = std::pow(map.scale_factor, seen.octave);
    o.velocity_px_s = *velocity;
    const Matrix23d J = residualJacobian(camera, p, plain).topRows<2>();
    o.by_pose = byPose(J, p);
    o.by_landmark = J * keyframe.T_cam_world.R;
    return o;
}

}  // namespace

std::optional<ReadoutTime> estimateReadoutTime(const std::vector<RowObservation>& observations) {
    if (observations.size() < fewest_observations) return std::nullopt;
    if (keyframesIn(observations) < fewest_keyframes) return std::nullopt;
    Vectors shear;
    for (const RowObservation& o : observations) {
        shear.emplace_back(o.row * o.velocity_px_s / o.sigma_px);
    }
    shear = Moves(observations).projectedOut(std::move(shear));
    const auto explained = sumsByStretch(observations.size(), [&](std::size_t o) {
        return shear[o].dot(observations[o].residual_px) / observations[o].sigma_px;
    });
    const auto squares =
        sumsByStretch(observations.size(), [&](std::size_t o) { return shear[o].squaredNorm(); });
    const double all = total(squares);
    if (!(all > 1e-9)) return std::nullopt;
    ReadoutTime readout{total(explained) / all, 0, observations.size()};
    double variance = 0;
    for (int i = 0; i < stretches; ++i) {
        const double off = explained[i] - readout.seconds * squares[i];
        variance += off * off / (all * all);
    }
    readout.sigma_s = std::sqrt(variance * stretches / (stretches - 1));
    return readout;
}

std::optional<ReadoutTime> estimateReadoutTime(const MapSnapshot& map, const Trajectory& frames) {
    std::vector<RowObservation> observations;
    for (const Keyframe& keyframe : map.keyframes) {
        if (keyframe.culled || observations.size() > most_observations) continue;
        const auto around = framesAround(frames, keyframe.frame.stamp_s);
        if (!around) continue;
        for (int k = 0; k < static_cast<int>(keyframe.landmarks.size()); ++k) {
            const auto seen = rowObservation(map, keyframe, k, around->first, around->second);
            if (seen) observations.push_back(*seen);
        }
    }
    return estimateReadoutTime(observations);
}

bool isRollingShutter(const ReadoutTime& readout) {
    const double seconds = std::abs(readout.seconds);
    return seconds > shortest_readout_s && seconds < longest_readout_s &&
           seconds > clear_sigmas * readout.sigma_s;
}

}  // namespace rgbd_graphslam
