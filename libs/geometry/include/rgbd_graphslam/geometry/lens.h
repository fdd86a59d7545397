/** Lenses: how far from a pinhole a camera bends its rays.
 *
 *  A lens maps points of the optical frame to its normalized image, the image in units of the focal
 *  length with the principal point at the origin. Without distortion that is (x / z, y / z). */
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <variant>
#include <vector>

namespace rgbd_graphslam {

using Matrix23d = Eigen::Matrix<double, 2, 3>;

/** Radial and tangential distortion of the plane z = 1: Brown's "Decentering distortion of lenses"
 *  (1966), and the rational model of Claus and Fitzgibbon's "A rational function lens distortion
 *  model for general cameras" (2005) as OpenCV and ROS have it. All zero is no distortion. */
struct BrownLens {
    /** OpenCV's order: k1, k2, p1, p2, k3 ("plumb bob"), k4, k5, k6 ("rational"). */
    std::array<double, 8> coefficients{};

    bool isNone() const;
    bool isRational() const;
    /** \param p optical frame, z > 0 */
    Eigen::Vector2d image(const Eigen::Vector3d& p) const;
    /** Of image() by p. */
    Matrix23d jacobian(const Eigen::Vector3d& p) const;
    /** A point with z = 1 that has this image: fixed-point iteration, then Newton's for the
     *  rational model. Anything, or no number, where the lens has no inverse. */
    Eigen::Vector3d ray(const Eigen::Vector2d& image) const;
    /** Distance from the axis for z = 1; infinite behind the camera. */
    static double eccentricity(const Eigen::Vector3d& p);
    /** Whether the image grows outward up to that distance, so that no two points share a pixel. */
    bool growsTo(double eccentricity) const;
};

/** Fisheye with an odd polynomial of the angle from the axis: Kannala and Brandt's "A generic
 * camera model and calibration method for conventional, wide-angle, and fish-eye lenses" (2006),
 * radially symmetric part, as OpenCV ("fisheye") and ROS ("equidistant") have it. */
struct KannalaBrandtLens {
    /** k1 to k4: image radius = angle (1 + k1 angle^2 + ... + k4 angle^8). */
    std::array<double, 4> coefficients{};

    /** \param p optical frame, any but the origin */
    Eigen::Vector2d image(const Eigen::Vector3d& p) const;
    Matrix23d jacobian(const Eigen::Vector3d& p) const;
    /** The unit vector with this image (Newton's method); no number without an inverse. */
    Eigen::Vector3d ray(const Eigen::Vector2d& image) const;
    /** Angle from the axis, rad. */
    static double eccentricity(const Eigen::Vector3d& p);
    /** As BrownLens::growsTo(). */
    bool growsTo(double eccentricity) const;
};

using Lens = std::variant<BrownLens, KannalaBrandtLens>;

bool operator==(const BrownLens& a, const BrownLens& b);
bool operator==(const KannalaBrandtLens& a, const KannalaBrandtLens& b);

bool isNone(const Lens& lens);

/** "none", "plumb_bob" (5 coefficients), "rational" (8) or "kannala_brandt" (4). */
std::string lensModel(const Lens& lens);

/** As many as the model has, in its order; five zeros for "none". */
std::vector<double> lensCoefficients(const Lens& lens);

/** The inverse of the two above; missing coefficients are zero.
 *  \throws std::invalid_argument for a model of another name or too many coefficients */
Lens makeLens(const std::string& model, const std::vector<double>& coefficients);

}  // namespace rgbd_graphslam
