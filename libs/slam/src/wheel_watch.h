/** How far wheels are to be believed. */
#pragma once
#include <Eigen/Core>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/estimation/wheel_preintegration.h"

namespace rgbd_graphslam {

/** Learns the wheels' radius and noise while the camera sees, and tells slips by chi-square. */
class WheelWatch {
  public:
    /** With the radius and noise learnt so far.
     *  \param blind_way_m since the map was seen: an error of the radius is the same all the way */
    WheelIncrement corrected(WheelIncrement increment, double blind_way_m) const;

    /** \param residual (x, y, yaw) of a corrected increment against what else is known
     *  \param covariance of the residual
     *  \return whether the wheels slipped */
    bool slipped(const Eigen::Vector3d& residual, const Eigen::Matrix3d& covariance);

    /** Learns from an increment without slip whose true motion is seen.
     *  \param raw as the wheels tell it
     *  \param sigma_m of the true way */
    void learn(const WheelIncrement& raw, const PlanarPose& seen, double sigma_m);

    double scale() const { return scale_; }
    double scaleSigma() const;
    /** Of the last slipped(). */
    double chi2() const { return chi2_; }

    void save(ByteWriter& out) const;
    /** \throws DamagedBytes */
    void load(ByteReader& in);

  private:
    double scale_ = 1, scale_variance_ = 9e-4;
    /** Variances of way and turn over those of the noise model. */
    double way_excess_ = 4, turn_excess_ = 4;
    /** Of the last slipped(): squared residuals over their variances. */
    double chi2_ = 0, way_chi2_ = 0, turn_chi2_ = 0;
};

}  // namespace rgbd_graphslam
