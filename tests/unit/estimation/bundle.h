/** Bundle adjustment problems whose truth is known. */
#pragma once
#include "measurements.h"
#include "rgbd_graphslam/estimation/bundle_adjustment.h"

namespace rgbd_graphslam {

struct Bundle {
    BundleProblem problem;
    std::vector<SE3> truth;  // T_body_world
};

/** Eight keyframes, the last two fixed, see 200 points; the others and the points start off.
 *  \param noise in standard deviations
 *  \param wrong share of measurements that are 40 px off */
inline Bundle someBundle(unsigned seed, double noise, double wrong,
                         const std::vector<MountedCamera>& cameras = {MountedCamera()}) {
    RandomInputs random(seed);
    Bundle bundle;
    BundleProblem& problem = bundle.problem;
    problem.cameras = cameras;
    problem.free_keyframes = 6;
    for (int k = 0; k < 8; ++k) {
        bundle.truth.emplace_back(rotationExp({0.02 * k, 0.05 * k, 0}),
                                  Eigen::Vector3d(0.1 * k, 0, 0.05 * k));
        const Vector6d off = k < 6 ? random.tangent(0.02, 0.02) : Vector6d::Zero().eval();
        problem.states.keyframes.push_back({bundle.truth.back().retract(off), {}});
    }
    for (int p = 0; p < 200; ++p) {
        const int camera = p % static_cast<int>(cameras.size());
        const Eigen::Vector3d p_cam(random.uniform(-1, 1), random.uniform(-0.7, 0.7),
                                    random.uniform(1.5, 4));
        const Eigen::Vector3d point = cameras[camera].T_cam_body().inverse() * p_cam;
        problem.states.points.push_back(point + random.vector(0.03));
        for (int k = 0; k < 8; ++k) {
            const Eigen::Vector3d q = cameras[camera].fromBody(bundle.truth[k] * point);
            Measurement m = measurementOf(q, cameras[camera].camera(), random, noise, p % 5 > 0);
            if (random.uniform(0, 1) < wrong) m.u += 40;
            problem.observations.push_back({k, p, m, camera});
        }
    }
    return bundle;
}

/** m and rad; of the free keyframes. */
inline double largestError(const Bundle& bundle) {
    double largest = 0;
    for (int k = 0; k < bundle.problem.free_keyframes; ++k) {
        const SE3& pose = bundle.problem.states.keyframes[k].T_body_world;
        largest = std::max(largest, pose.minus(bundle.truth[k]).norm());
    }
    return largest;
}

inline double largestDifference(const States& a, const States& b) {
    double largest = 0;
    for (std::size_t k = 0; k < a.keyframes.size(); ++k) {
        largest = std::max(largest, a.keyframes[k].minus(b.keyframes[k]).norm());
    }
    return largest;
}

}  // namespace rgbd_graphslam
