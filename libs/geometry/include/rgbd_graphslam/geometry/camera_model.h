/** Camera models: from points to pixels and back. */
#pragma once
#include <Eigen/Core>

#include "rgbd_graphslam/geometry/lens.h"

namespace rgbd_graphslam {

/** A calibration as files state it: plain numbers, nothing computed. Pixel (0, 0) is the center of
 *  the top-left pixel. */
struct Intrinsics {
    int width = 640, height = 480;
    double fx = 525, fy = 525, cx = 319.5, cy = 239.5;  // px
    Lens lens;

    bool hasDistortion() const { return !isNone(lens); }
};

bool operator==(const Intrinsics& a, const Intrinsics& b);
inline bool operator!=(const Intrinsics& a, const Intrinsics& b) {
    return !(a == b);
}

/** Projects points of the optical frame (x right, y down, z forward, m) to the pixels of one
 * camera.
 *
 *  Every camera has a *pinhole camera* beside it, with the same focal lengths and principal point
 *  and no lens: distort() and undistort() go from pixels of one to those of the other. Nobody but
 *  this class computes with focal lengths; intrinsics() is for reading and writing calibrations. */
class CameraModel {
  public:
    CameraModel() : CameraModel(Intrinsics()) {}
    CameraModel(const Intrinsics& intrinsics);

    int width, height;  // px

    Intrinsics intrinsics() const;
    bool hasDistortion() const { return distorts_; }
    bool contains(const Eigen::Vector2d& pixel) const {
        return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= width - 1 &&
               pixel.y() <= height - 1;
    }

    /** The pixel in which the sensor sees a point; see isValid(). */
    Eigen::Vector2d project(const Eigen::Vector3d& p) const {
        if (distorts_) return throughLens(p);
        return {in_.fx * p.x() / p.z() + in_.cx, in_.fy * p.y() / p.z() + in_.cy};
    }
    /** The same. \param inverse_z 1 / p.z(), for those who have it already */
    Eigen::Vector2d project(const Eigen::Vector3d& p, double inverse_z) const {
        if (distorts_) return throughLens(p);
        return {in_.fx * p.x() * inverse_z + in_.cx, in_.fy * p.y() * inverse_z + in_.cy};
    }
    /** Jacobian of project() by the point (px/m), times a weight. */
    Matrix23d projectionJacobian(const Eigen::Vector3d& p, double weight = 1) const {
        if (distorts_) return lensJacobian(p, weight);
        const double inverse_z = 1 / p.z(), inverse_z2 = inverse_z * inverse_z;
        Matrix23d J;
        J << weight * in_.fx * inverse_z, 0, -weight * in_.fx * p.x() * inverse_z2,  //
            0, weight * in_.fy * inverse_z, -weight * in_.fy * p.y() * inverse_z2;
        return J;
    }
    /** Gradient by the point of a function of the pixel, its gradient by the pixel being `g`:
     *  projectionJacobian(p)^T g. */
    Eigen::Vector3d pointGradient(const Eigen::Vector2d& g, const Eigen::Vector3d& p) const {
        if (distorts_) return lensJacobian(p, 1).transpose() * g;
        return {g.x() * in_.fx / p.z(), g.y() * in_.fy / p.z(),
                -(g.x() * in_.fx * p.x() + g.y() * in_.fy * p.y()) / (p.z() * p.z())};
    }

    /** The point of depth z (m, along the optical axis) that the sensor sees in a pixel; no number
     *  for a ray 90 degrees and more from the axis. */
    Eigen::Vector3d unproject(double u, double v, double z) const {
        if (distorts_) return throughLens(u, v, z);
        return {(u - in_.cx) * z / in_.fx, (v - in_.cy) * z / in_.fy, z};
    }
    /** Unit vector towards what the sensor sees in a pixel. */
    Eigen::Vector3d bearing(const Eigen::Vector2d& pixel) const;
    /** Jacobian of unproject() by the pixel, m/px; the third row is zero, since z is given. */
    Eigen::Matrix<double, 3, 2> unprojectionJacobian(const Eigen::Vector2d& pixel, double z) const;

    /** Pixels per radian at the principal point, along x and y: a length of l m at depth z there
     *  covers l / z times as many pixels. */
    Eigen::Vector2d pixelsPerRadian() const { return {in_.fx, in_.fy}; }
    /** Pixels per steradian at the principal point. */
    double pixelsPerSteradian() const { return in_.fx * in_.fy; }
    /** Side (rad) of the square that covers the solid angle of a pixel. */
    double pixelAngle(const Eigen::Vector2d& pixel) const;
    /** Horizontal field of view of pinhole(), rad. */
    double fieldOfView() const;

    /** Whether this point's pixel is its own: in front of the camera and short of where the lens
     *  folds the image over, so that project() and unproject() invert each other. */
    bool isValid(const Eigen::Vector3d& p) const;
    /** Whether unproject() inverts project() to within a pixel all over the image. */
    bool isInvertible() const;

    /** The same without the lens. */
    CameraModel pinhole() const;
    /** The camera in whose pixels keypoints are given: pinhole(), except that a fisheye, whose view
     *  no plane can hold, keeps its own. */
    CameraModel rectified() const;
    /** The pixel of rectified() that shows what the sensor saw in this one. */
    Eigen::Vector2d rectify(const Eigen::Vector2d& seen) const;
    /** Inverse of rectify(). */
    Eigen::Vector2d unrectify(const Eigen::Vector2d& rectified) const;
    /** Of images of which every pixel is the mean of a block of `block_px` squared. */
    CameraModel shrunk(int block_px) const;
    /** Of images that keep every n-th pixel of every n-th row. */
    CameraModel subsampled(int n) const;

    /** From the plane z = 1 to a pixel of pinhole(). */
    Eigen::Vector2d fromPlane(const Eigen::Vector2d& n) const {
        return {in_.fx * n.x() + in_.cx, in_.fy * n.y() + in_.cy};
    }
    /** Inverse of fromPlane(). */
    Eigen::Vector2d toPlane(const Eigen::Vector2d& pixel) const {
        return {(pixel.x() - in_.cx) / in_.fx, (pixel.y() - in_.cy) / in_.fy};
    }
    /** From homogeneous pixels of pinhole() to rays (x, y, 1). */
    Eigen::Matrix3d inverseMatrix() const;

  private:
    Eigen::Vector2d throughLens(const Eigen::Vector3d& p) const;
    Eigen::Vector3d throughLens(double u, double v, double z) const;
    Matrix23d lensJacobian(const Eigen::Vector3d& p, double weight) const;

    bool isFisheye() const { return std::holds_alternative<KannalaBrandtLens>(in_.lens); }

    Intrinsics in_;
    bool distorts_;
};

/** Of images resized by a factor to this size: the border of the image, half a pixel beyond the
 *  centers of its outermost ones, stays in place. */
Intrinsics scaled(const Intrinsics& camera, double factor, int width, int height);

}  // namespace rgbd_graphslam
