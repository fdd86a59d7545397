#include "lens_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace rgbd_graphslam {
namespace {

using Lens = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

constexpr int samples_per_side = 25;
/** Tangents of half the field of view that is looked at, until the image ends. */
constexpr double most_tangent = 3;

/** Brown's distortion of a point, linear in k1, k2, p1, p2, k3: what each adds. */
Eigen::Matrix<double, 2, 5> brownTerms(const Eigen::Vector2d& p) {
    const double x = p.x(), y = p.y(), r2 = p.squaredNorm();
    Eigen::Matrix<double, 2, 5> terms;
    terms << x * r2, x * r2 * r2, 2 * x * y, r2 + 2 * x * x, x * r2 * r2 * r2,  //
        y * r2, y * r2 * r2, r2 + 2 * y * y, 2 * x * y, y * r2 * r2 * r2;
    return terms;
}

/** Ratio of two polynomials of r^2, with Brown's tangential part. */
Lens rational(std::vector<double> D) {
    D.resize(8);
    return [D](const Eigen::Vector2d& p) -> Eigen::Vector2d {
        const double r2 = p.squaredNorm();
        const double over = 1 + r2 * (D[0] + r2 * (D[1] + r2 * D[4]));
        const double under = 1 + r2 * (D[5] + r2 * (D[6] + r2 * D[7]));
        const Eigen::Matrix<double, 2, 5> terms = brownTerms(p);
        return p * (over / under) + terms.col(2) * D[2] + terms.col(3) * D[3];
    };
}

Lens equidistant(std::vector<double> D) {
    D.resize(4);
    return [D](const Eigen::Vector2d& p) -> Eigen::Vector2d {
        const double r = p.norm(), angle = std::atan(r), a2 = angle * angle;
        const double bent = angle * (1 + a2 * (D[0] + a2 * (D[1] + a2 * (D[2] + a2 * D[3]))));
        return r > 0 ? Eigen::Vector2d(p * (bent / r)) : p;
    };
}

/** Points that the lens shows in the image, z = 1. */
std::vector<Eigen::Vector2d> pointsInImage(const Lens& lens, const Camera& camera) {
    const auto seen = [&](const Eigen::Vector2d& p) {
        const Eigen::Vector2d bent = lens(p);
        return camera.contains(
            {camera.fx * bent.x() + camera.cx, camera.fy * bent.y() + camera.cy});
    };
    std::vector<Eigen::Vector2d> points;
    constexpr int directions = 4 * samples_per_side;
    for (int d = 0; d < directions; ++d) {
        const double turn = 2 * M_PI * d / directions;
        const Eigen::Vector2d direction(std::cos(turn), std::sin(turn));
        for (int i = 1; i <= 4 * samples_per_side; ++i) {
            const Eigen::Vector2d p = direction * (most_tangent * i / (4 * samples_per_side));
            if (!seen(p)) break;
            points.push_back(p);
        }
    }
    return points;
}

double fit(const Lens& lens, Camera& camera) {
    const auto points = pointsInImage(lens, camera);
    if (points.size() < 5) return std::numeric_limits<double>::infinity();
    Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> b = Eigen::Matrix<double, 5, 1>::Zero();
    for (const Eigen::Vector2d& p : points) {
        const Eigen::Matrix<double, 2, 5> terms = brownTerms(p);
        A += terms.transpose() * terms;
        b += terms.transpose() * (lens(p) - p);
    }
    const Eigen::Matrix<double, 5, 1> D = A.ldlt().solve(b);
    std::copy(D.data(), D.data() + 5, camera.distortion.begin());
    double worst = 0;
    for (const Eigen::Vector2d& p : points) {
        const Eigen::Vector2d error = p + brownTerms(p) * D - lens(p);
        worst = std::max(worst, std::hypot(camera.fx * error.x(), camera.fy * error.y()));
    }
    return worst;
}

}  // namespace

double fitLens(const std::string& model, const std::vector<double>& coefficients, Camera& camera) {
    camera.distortion = {};
    const bool none = std::all_of(coefficients.begin(), coefficients.end(),
                                  [](double value) { return value == 0; });
    const bool brown = model.empty() || model == "plumb_bob" || coefficients.size() <= 5;
    if (model == "equidistant" || model == "fisheye") return fit(equidistant(coefficients), camera);
    if (none) return 0;
    if (brown) {
        const auto count = std::min<std::size_t>(5, coefficients.size());
        std::copy_n(coefficients.begin(), count, camera.distortion.begin());
        return 0;
    }
    if (model == "rational_polynomial") return fit(rational(coefficients), camera);
    return std::numeric_limits<double>::infinity();
}

}  // namespace rgbd_graphslam
