/** Between our types and MRPT's. What differs between MRPT versions belongs here. */
#pragma once
#include <mrpt/core/Clock.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <cmath>

#include "rgbd_graphslam/geometry/camera_model.h"
#include "rgbd_graphslam/geometry/se3.h"

namespace rgbd_graphslam {

/** MRPT's sensor frame (x forward, y left, z up) to the optical frame (x right, y down, z forward).
 */
inline const SE3 T_optical_from_mrpt((Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished(),
                                     Eigen::Vector3d::Zero());

inline SE3 toSE3(const mrpt::poses::CPose3D& pose) {
    const auto& R = pose.getRotationMatrix();
    SE3 T;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) T.R(i, j) = R(i, j);
    }
    T.t = {pose.x(), pose.y(), pose.z()};
    return T;
}

inline mrpt::poses::CPose3D toCPose3D(const SE3& T) {
    mrpt::math::CMatrixDouble33 R;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) R(i, j) = T.R(i, j);
    }
    return mrpt::poses::CPose3D(R, mrpt::math::TPoint3D(T.t.x(), T.t.y(), T.t.z()));
}

/** UNIX time in seconds. Double precision holds today's stamps to 0.3 us. */
inline double toSeconds(mrpt::Clock::time_point time) {
    static const mrpt::Clock::time_point epoch = mrpt::Clock::fromDouble(0);
    return static_cast<double>((time - epoch).count()) / mrpt::Clock::period::den;
}

/** Rounded to the microsecond, so that the decimals of a dataset's stamps survive.
 *  \param stamp_s UNIX time in seconds */
inline mrpt::Clock::time_point toMrptTime(double stamp_s) {
    static const mrpt::Clock::time_point epoch = mrpt::Clock::fromDouble(0);
    const auto microseconds = static_cast<mrpt::Clock::rep>(std::llround(stamp_s * 1e6));
    return epoch + mrpt::Clock::duration(microseconds * (mrpt::Clock::period::den / 1000000));
}

/** MRPT keeps k3 and k4 of a fisheye where the plumb-bob model has k3 and k4. */
inline Lens toLens(const mrpt::img::TCamera& camera) {
    switch (camera.distortion) {
        case mrpt::img::DistortionModel::plumb_bob:
            return BrownLens{camera.dist};
        case mrpt::img::DistortionModel::kannala_brandt:
            return KannalaBrandtLens{{camera.k1(), camera.k2(), camera.k3(), camera.k4()}};
        default:
            return BrownLens{};
    }
}

inline Intrinsics toCamera(const mrpt::img::TCamera& camera) {
    Intrinsics result;
    result.width = static_cast<int>(camera.ncols);
    result.height = static_cast<int>(camera.nrows);
    result.fx = camera.fx();
    result.fy = camera.fy();
    result.cx = camera.cx();
    result.cy = camera.cy();
    result.lens = toLens(camera);
    return result;
}

inline mrpt::img::TCamera toTCamera(const Intrinsics& camera) {
    mrpt::img::TCamera result;
    result.ncols = static_cast<uint32_t>(camera.width);
    result.nrows = static_cast<uint32_t>(camera.height);
    result.setIntrinsicParamsFromValues(camera.fx, camera.fy, camera.cx, camera.cy);
    if (const auto* fisheye = std::get_if<KannalaBrandtLens>(&camera.lens)) {
        const auto& [k1, k2, k3, k4] = fisheye->coefficients;
        result.setDistortionKannalaBrandt(k1, k2, k3, k4);
    } else if (camera.hasDistortion()) {
        result.distortion = mrpt::img::DistortionModel::plumb_bob;
        result.dist = std::get<BrownLens>(camera.lens).coefficients;
    }
    return result;
}

}  // namespace rgbd_graphslam
