/** The motion of the last seconds, with all older measurements as a prior. */
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "rgbd_graphslam/estimation/factor.h"
#include "rgbd_graphslam/estimation/imu_preintegration.h"

namespace rgbd_graphslam {

using Vector18d = Eigen::Matrix<double, 18, 1>;
using Matrix18d = Eigen::Matrix<double, 18, 18>;

/** Pose and motion of a body, and gravity. Its tangent vector is that of the keyframe state, then
 *  that of gravity. */
struct InertialState {
    KeyframeState body;
    /** In the world, m/s^2: a world made by a camera need not be level, and turns as it drifts. */
    Eigen::Vector3d gravity{0, 0, -9.81};

    InertialState retract(const Vector18d& delta) const;
    Vector18d minus(const InertialState& other) const;
    /** The same in another world. */
    InertialState in(const SE3& T_new_world) const;
};

/** A pose that the camera tells. */
struct MeasuredPose {
    SE3 T_body_world;
    /** Inverse covariance of its left perturbation. */
    Matrix6d information = Matrix6d::Identity();
};

/** A chain of states, each tied to the next: a fixed-lag smoother. Gauss-Newton on the block
 *  tridiagonal normal equations; the oldest states are marginalized into a prior (Sibley, Matthies
 *  and Sukhatme, "Sliding window filter with application to planetary landing", 2010). Costs some
 *  20 us a state and iteration. */
class InertialWindow {
  public:
    struct Node {
        double stamp_s = 0;
        InertialState state;
        std::optional<MeasuredPose> measured;
        /** Which tie it to the next node: they name this node's states by index 0 and the next
         *  node's by 1, gravity as points. */
        std::vector<std::shared_ptr<const Factor>> links;
    };

    /** How gravity may change. */
    struct GravityModel {
        double strength = 9.81, strength_sigma = 0.01;  // m/s^2
        double walk = 0.003;  // of its direction and strength, m/s^2 per square root of a second
    };

    InertialWindow() = default;
    explicit InertialWindow(const GravityModel& gravity) : gravity_(gravity) {}

    /** Begins with one state. \param sigma standard deviations of its tangent vector, positive */
    void start(double stamp_s, const InertialState& state, const Vector18d& sigma);
    bool started() const { return !nodes_.empty(); }

    /** \param links to the newest node so far
     *  \param covariance of the new state, until the next optimize() */
    void add(Node node, std::vector<std::shared_ptr<const Factor>> links,
             const Matrix18d& covariance);
    void link(std::size_t node, std::shared_ptr<const Factor> factor);
    void measure(std::size_t node, const std::optional<MeasuredPose>& measured) {
        nodes_[node].measured = measured;
    }

    /** \return how far the newest state moved in the last iteration, in standard deviations */
    double optimize(int iterations);

    /** Drops the oldest nodes, whose measurements become a prior, until so many remain. */
    void marginalize(std::size_t keep);

    const std::vector<Node>& nodes() const { return nodes_; }
    /** Of the newest state, by the last optimize(). */
    const Matrix18d& covariance() const { return covariance_; }

    /** The world has moved. */
    void transform(const SE3& T_new_world);

    struct Prior {
        InertialState mean;
        Matrix18d information = Matrix18d::Identity();
    };
    /** Of the oldest state. */
    const Prior& prior() const { return prior_; }
    /** As another window was. */
    void restore(const Prior& prior, std::vector<Node> nodes, const Matrix18d& covariance);

  private:
    struct NormalEquations;
    NormalEquations linearized(std::size_t count) const;

    GravityModel gravity_;
    std::vector<Node> nodes_;
    Prior prior_;
    Matrix18d covariance_ = Matrix18d::Identity();
};

/** What a factor makes of an error of the first state, and what it adds: an error of the next state
 *  is F times that of the first plus one of covariance Q. */
struct Propagation {
    Matrix18d F = Matrix18d::Identity(), Q = Matrix18d::Zero();

    Matrix18d operator()(const Matrix18d& covariance) const {
        const Matrix18d carried = F * covariance * F.transpose() + Q;
        return 0.5 * (carried + carried.transpose());
    }
};

/** \param factor of 15 residuals that ties the two states, such as ImuFactor with gravity at point
 * 0 \param gravity_walk variance that gravity gains, (m/s^2)^2 */
Propagation propagationOf(const InertialState& state, const InertialState& next,
                          const Factor& factor, double gravity_walk);

/** Where readings lead to. \param T_imu_body as for ImuFactor
 *  \param increment with the biases of the state */
InertialState carriedOn(const InertialState& state, const ImuIncrement& increment,
                        const SE3& T_imu_body);

}  // namespace rgbd_graphslam
