#include "rgbd_graphslam/geometry/lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rgbd_graphslam {
namespace {

/** A polynomial 1 + a s + b s^2 + c s^3 and its derivative by s. */
struct Cubic {
    double a, b, c;
    double operator()(double s) const { return 1 + s * (a + s * (b + s * c)); }
    double slope(double s) const { return a + s * (2 * b + s * 3 * c); }
};

Cubic numerator(const std::array<double, 8>& k) {
    return {k[0], k[1], k[4]};
}

Cubic denominator(const std::array<double, 8>& k) {
    return {k[5], k[6], k[7]};
}

Eigen::Vector2d distorted(const std::array<double, 8>& k, const Eigen::Vector2d& n) {
    const double x = n.x(), y = n.y(), r2 = n.squaredNorm();
    const double radial = numerator(k)(r2) / denominator(k)(r2);
    return {x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x),
            y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y};
}

/** Of distorted() by n. */
Eigen::Matrix2d planeJacobian(const std::array<double, 8>& k, const Eigen::Vector2d& n) {
    const double x = n.x(), y = n.y(), r2 = n.squaredNorm();
    const Cubic over = numerator(k), under = denominator(k);
    const double radial = over(r2) / under(r2);
    const double slope = (over.slope(r2) - radial * under.slope(r2)) / under(r2);  // by r^2
    const double mixed = 2 * (slope * x * y + k[2] * x + k[3] * y);
    Eigen::Matrix2d J;
    J << radial + 2 * slope * x * x + 2 * k[2] * y + 6 * k[3] * x, mixed,  //
        mixed, radial + 2 * slope * y * y + 6 * k[2] * y + 2 * k[3] * x;
    return J;
}

/** At as many places as tell a fold of these polynomials. */
template <class Slope>
bool isPositiveUpTo(double end, const Slope& slope) {
    constexpr int steps = 64;
    for (int i = 1; i <= steps; ++i) {
        if (!(slope(end * i / steps) > 0)) return false;
    }
    return true;
}

double polynomial(const std::array<double, 4>& k, double angle) {
    const double a2 = angle * angle;
    return angle * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

double slopeOf(const std::array<double, 4>& k, double angle) {
    const double a2 = angle * angle;
    return 1 + a2 * (3 * k[0] + a2 * (5 * k[1] + a2 * (7 * k[2] + a2 * 9 * k[3])));
}

/** With polynomial(k, angle) = radius. */
double angleOf(const std::array<double, 4>& k, double radius) {
    constexpr int iterations = 30;
    double angle = std::min(radius, M_PI / 2);
    for (int i = 0; i < iterations; ++i) {
        const double step = (polynomial(k, angle) - radius) / slopeOf(k, angle);
        angle -= step;
        if (std::abs(step) < 1e-15) break;
    }
    return angle;
}

template <std::size_t count>
std::array<double, count> padded(const std::vector<double>& coefficients) {
    if (coefficients.size() > count) throw std::invalid_argument("too many lens coefficients");
    std::array<double, count> all{};
    std::copy(coefficients.begin(), coefficients.end(), all.begin());
    return all;
}

}  // namespace

bool BrownLens::isNone() const {
    return std::all_of(coefficients.begin(), coefficients.end(), [](double k) { return k == 0; });
}

bool BrownLens::isRational() const {
    return coefficients[5] != 0 || coefficients[6] != 0 || coefficients[7] != 0;
}

Eigen::Vector2d BrownLens::image(const Eigen::Vector3d& p) const {
    return distorted(coefficients, {p.x() / p.z(), p.y() / p.z()});
}

Matrix23d BrownLens::jacobian(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d n(p.x() / p.z(), p.y() / p.z());
    Matrix23d plane;
    plane << 1, 0, -n.x(), 0, 1, -n.y();
    return planeJacobian(coefficients, n) * plane / p.z();
}

Eigen::Vector3d BrownLens::ray(const Eigen::Vector2d& image) const {
    constexpr int iterations = 12, newton_iterations = 8;
    Eigen::Vector2d n = image;
    for (int i = 0; i < iterations; ++i) n += image - distorted(coefficients, n);
    for (int i = 0; isRational() && i < newton_iterations; ++i) {
        n += planeJacobian(coefficients, n).inverse() * (image - distorted(coefficients, n));
    }
    return {n.x(), n.y(), 1};
}

bool BrownLens::growsTo(double eccentricity) const {
    const Cubic over = numerator(coefficients), under = denominator(coefficients);
    return isPositiveUpTo(eccentricity, [&](double r) {
        const double s = r * r, radial = over(s) / under(s);
        if (!(under(s) > 0)) return -1.;
        return radial + 2 * s * (over.slope(s) - radial * under.slope(s)) / under(s);
    });
}

double BrownLens::eccentricity(const Eigen::Vector3d& p) {
    if (!(p.z() > 0)) return std::numeric_limits<double>::infinity();
    return p.head<2>().norm() / p.z();
}

Eigen::Vector2d KannalaBrandtLens::image(const Eigen::Vector3d& p) const {
    const double r = p.head<2>().norm();
    if (r == 0) return {0, 0};
    return p.head<2>() * (polynomial(coefficients, std::atan2(r, p.z())) / r);
}

Matrix23d KannalaBrandtLens::jacobian(const Eigen::Vector3d& p) const {
    const double x = p.x(), y = p.y(), z = p.z();
    const double r = p.head<2>().norm(), distance2 = p.squaredNorm();
    Matrix23d J;
    if (r < 1e-7 * z) {
        J << 1 / z, 0, -x / (z * z), 0, 1 / z, -y / (z * z);
        return J;
    }
    const double angle = std::atan2(r, z), slope = slopeOf(coefficients, angle);
    const double scale = polynomial(coefficients, angle) / r;
    const double bend = (slope * z / distance2 - scale) / (r * r);
    J << scale + bend * x * x, bend * x * y, -slope * x / distance2,  //
        bend * x * y, scale + bend * y * y, -slope * y / distance2;
    return J;
}

Eigen::Vector3d KannalaBrandtLens::ray(const Eigen::Vector2d& image) const {
    const double radius = image.norm();
    if (radius == 0) return {0, 0, 1};
    const double angle = angleOf(coefficients, radius);
    const Eigen::Vector2d outward = image * (std::sin(angle) / radius);
    return {outward.x(), outward.y(), std::cos(angle)};
}

bool KannalaBrandtLens::growsTo(double eccentricity) const {
    return isPositiveUpTo(eccentricity, [&](double angle) { return slopeOf(coefficients, angle); });
}

double KannalaBrandtLens::eccentricity(const Eigen::Vector3d& p) {
    return std::atan2(p.head<2>().norm(), p.z());
}

bool operator==(const BrownLens& a, const BrownLens& b) {
    return a.coefficients == b.coefficients;
}

bool operator==(const KannalaBrandtLens& a, const KannalaBrandtLens& b) {
    return a.coefficients == b.coefficients;
}

bool isNone(const Lens& lens) {
    const auto* brown = std::get_if<BrownLens>(&lens);
    return brown && brown->isNone();
}

std::string lensModel(const Lens& lens) {
    const auto* brown = std::get_if<BrownLens>(&lens);
    if (!brown) return "kannala_brandt";
    if (brown->isNone()) return "none";
    return brown->isRational() ? "rational" : "plumb_bob";
}

std::vector<double> lensCoefficients(const Lens& lens) {
    const auto all = std::visit(
        [](const auto& l) {
            return std::vector<double>(l.coefficients.begin(), l.coefficients.end());
        },
        lens);
    const auto* brown = std::get_if<BrownLens>(&lens);
    return brown && !brown->isRational() ? std::vector<double>(all.begin(), all.begin() + 5) : all;
}

Lens makeLens(const std::string& model, const std::vector<double>& coefficients) {
    if (model == "kannala_brandt") return KannalaBrandtLens{padded<4>(coefficients)};
    if (model == "rational") return BrownLens{padded<8>(coefficients)};
    if (model != "plumb_bob" && model != "none") {
        throw std::invalid_argument("no lens model '" + model + "'");
    }
    const std::array<double, 5> k = padded<5>(coefficients);
    if (model == "none") return BrownLens{};
    return BrownLens{{k[0], k[1], k[2], k[3], k[4]}};
}

}  // namespace rgbd_graphslam
