/** How a measurement constrains states: the interface between sensors and solvers. */
#pragma once
#include <vector>

#include "rgbd_graphslam/estimation/robust_kernel.h"
#include "rgbd_graphslam/estimation/states.h"

namespace rgbd_graphslam {

/** Pose and motion are blocks of their own: most factors need only the pose. */
enum class StateKind { Pose, Motion, Point };

/** Numbers in a state's tangent vector. */
constexpr int tangentSize(StateKind kind) {
    return kind == StateKind::Pose ? 6 : kind == StateKind::Motion ? 9 : 3;
}

/** Numbers that store a state: a pose is its rotation by columns, then its translation; the others
 *  are their own tangent vectors. */
constexpr int blockSize(StateKind kind) {
    return kind == StateKind::Pose ? 12 : tangentSize(kind);
}

/** Names a state of a problem. */
struct StateKey {
    StateKind kind = StateKind::Pose;
    /** Of the keyframe or point in `States`. */
    int index = 0;
};
inline StateKey poseKey(int keyframe) {
    return {StateKind::Pose, keyframe};
}
inline StateKey motionKey(int keyframe) {
    return {StateKind::Motion, keyframe};
}
inline StateKey pointKey(int point) {
    return {StateKind::Point, point};
}

inline SE3 poseFrom(const double* block) {
    return {Eigen::Map<const Eigen::Matrix3d>(block), Eigen::Map<const Eigen::Vector3d>(block + 9)};
}
inline void store(const SE3& pose, double* block) {
    Eigen::Map<Eigen::Matrix3d> rotation(block);
    Eigen::Map<Eigen::Vector3d> translation(block + 9);
    rotation = pose.R;
    translation = pose.t;
}
inline MotionState motionFrom(const double* block) {
    const Eigen::Map<const Vector9d> numbers(block);
    return {numbers.head<3>(), numbers.segment<3>(3), numbers.tail<3>()};
}
inline void store(const MotionState& motion, double* block) {
    Eigen::Map<Vector9d>{block} << motion.velocity, motion.gyro_bias, motion.accelerometer_bias;
}

/** The values of a factor's states, in the order in which the factor names them. */
class StateBlocks {
  public:
    explicit StateBlocks(const double* const* blocks) : blocks_(blocks) {}

    /** T_body_world */
    SE3 pose(int i) const { return poseFrom(blocks_[i]); }
    MotionState motion(int i) const { return motionFrom(blocks_[i]); }
    Eigen::Vector3d point(int i) const { return Eigen::Map<const Eigen::Vector3d>(blocks_[i]); }

  private:
    const double* const* blocks_;
};

/** Where a factor writes its residual and derivatives. */
class Linearization {
  public:
    /** \param jacobians null when no derivatives are wanted; one per state, each a row-major matrix
     *         of one row per residual and blockSize() columns, or null if not wanted */
    Linearization(double* residual, double* const* jacobians)
        : residual_(residual), jacobians_(jacobians) {}

    bool wantsJacobians() const { return jacobians_ != nullptr; }

    template <int rows>
    void setResidual(const Eigen::Matrix<double, rows, 1>& residual) {
        Eigen::Map<Eigen::Matrix<double, rows, 1>>{residual_} = residual;
    }

    /** \param jacobian derivative of the residual by the tangent vector of the factor's i-th state
     */
    template <int rows, int columns>
    void setJacobian(int i, const Eigen::Matrix<double, rows, columns>& jacobian) {
        if (!jacobians_ || !jacobians_[i]) return;
        // Ceres multiplies by the derivative of its manifold, which selects the first columns.
        constexpr int stored = columns == 6 ? blockSize(StateKind::Pose) : columns;
        Eigen::Map<Eigen::Matrix<double, rows, stored, Eigen::RowMajor>> block(jacobians_[i]);
        block.template leftCols<columns>() = jacobian;
        block.template rightCols<stored - columns>().setZero();
    }

  private:
    double* residual_;
    double* const* jacobians_;
};

/** A measurement as a term of the cost: half the kernel's cost of the squared whitened residual.
 *  A new sensor is a new class derived from this one; all solvers evaluate it as it is. */
class Factor {
  public:
    virtual ~Factor() = default;

    /** The states that the residual depends on. */
    virtual std::vector<StateKey> states() const = 0;

    virtual int residualSize() const = 0;

    virtual RobustKernel kernel() const { return {}; }

    /** Writes the residual, divided by its standard deviation ("whitened"), and its derivatives by
     *  the tangent vector of each state. Must give the same numbers each time and be safe to call
     *  from several threads.
     *  \return false where the residual is not defined, such as for a point behind the camera */
    virtual bool linearize(const StateBlocks& states, Linearization& out) const = 0;
};

}  // namespace rgbd_graphslam
