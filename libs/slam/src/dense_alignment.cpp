#include "rgbd_graphslam/slam/dense_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "rgbd_graphslam/estimation/robust_kernel.h"

namespace rgbd_graphslam {
namespace {

constexpr int pyramid_levels = 3;
constexpr int iterations_a_level = 10;
constexpr double converged = 1e-5;  // m, rad

constexpr double surface_sigma_m = 0.01;
/** Pairs further apart show different surfaces, at the coarsest and the finest level. */
constexpr double widest_pair_m[pyramid_levels] = {0.06, 0.12, 0.25};
/** Of gray values in units of their standard deviation. */
constexpr double gray_sigma = 0.15;
constexpr double least_contrast = 5;
constexpr double huber_sigmas = 1.5;
constexpr double steepest_step = 1.08;  // of depth between neighbors on one surface

constexpr double least_depth_share = 0.25, least_overlap = 0.35, least_fitting = 0.65;
/** Of the pairs that must lie on surfaces rather than on their edges. */
constexpr double least_smooth = 0.3;
/** Neighboring pixels err alike: as many count as one. */
constexpr double alike_pixels = 50;
constexpr double largest_sigma = 0.03;  // m, rad
constexpr double largest_step_m = 0.6, largest_step_rad = 0.6;

/** The reference with all that does not change while aligning. */
struct Surface {
    explicit Surface(const DenseView& v) : view(v), camera(v.camera) {
        points.resize(view.gray.size());
        normals.resize(view.gray.size(), Eigen::Vector3d::Zero());
        for (int y = 0; y < camera.height; ++y) {
            for (int x = 0; x < camera.width; ++x) {
                points[index(x, y)] = camera.unproject(x, y, view.depth_m[index(x, y)]);
            }
        }
        for (int y = 1; y + 1 < camera.height; ++y) {
            for (int x = 1; x + 1 < camera.width; ++x) findNormal(x, y);
        }
    }
    int index(int x, int y) const { return y * camera.width + x; }

    /** The zero vector stays where the surface breaks. */
    void findNormal(int x, int y) {
        const int around[] = {index(x - 1, y), index(x + 1, y), index(x, y - 1), index(x, y + 1)};
        const float z = view.depth_m[index(x, y)];
        for (const int i : around) {
            const float other = view.depth_m[i];
            if (z <= 0 || other <= 0 || other > z * steepest_step || z > other * steepest_step) {
                return;
            }
        }
        const Eigen::Vector3d across = points[around[1]] - points[around[0]];
        const Eigen::Vector3d down = points[around[3]] - points[around[2]];
        normals[index(x, y)] = down.cross(across).normalized();
    }

    const DenseView& view;
    const Camera& camera;
    std::vector<Eigen::Vector3d> points, normals;  // m, in the reference's camera
};

struct GrayStatistics {
    double mean = 0, deviation = 1;
};

/** A pixel of the view on the reference. */
struct Pair {
    int view_pixel = 0, reference_pixel = 0;  // the nearest one
    Eigen::Vector3d point;                    // of the view, in the reference's camera
    Eigen::Vector2d pixel;
};

class Level {
  public:
    Level(const DenseView& reference, const DenseView& view, double widest_m)
        : surface_(reference), view_(view), widest_m_(widest_m) {
        uses_gray_ = reference.contrast() > least_contrast && view.contrast() > least_contrast;
    }

    void align(SE3& T) {
        for (int i = 0; i < iterations_a_level; ++i) {
            evaluate(T);
            const Vector6d step = -(hessian_ + Matrix6d::Identity()).ldlt().solve(gradient_);
            if (!step.allFinite()) return;
            T = T.retract(step);
            if (step.norm() < converged) break;
        }
    }

    /** Whether the last alignment is to be believed. */
    bool good(const SE3& T) {
        evaluate(T);
        const double sharing = static_cast<double>(pairs_.size()) / std::max(1, with_depth_);
        overlap_ = sharing;
        if (sharing < least_overlap) return false;
        if (surfaces_ < least_smooth * static_cast<double>(pairs_.size())) return false;
        if (fitting_surfaces_ < least_fitting * surfaces_) return false;
        if (uses_gray_ && fitting_grays_ < least_fitting * grays_) return false;
        const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(hessian_ - informationOfNoise());
        return solver.eigenvalues()[0] > alike_pixels / (largest_sigma * largest_sigma);
    }
    double overlap() const { return overlap_; }

  private:
    void evaluate(const SE3& T) {
        hessian_.setZero();
        gradient_.setZero();
        surfaces_ = fitting_surfaces_ = grays_ = fitting_grays_ = 0;
        findPairs(T);
        if (uses_gray_) normalizeGray();
        for (const Pair& pair : pairs_) {
            addSurface(pair);
            if (uses_gray_) addGray(pair);
        }
    }

    void findPairs(const SE3& T) {
        pairs_.clear();
        with_depth_ = 0;
        const Camera& c = surface_.camera;
        for (int y = 0; y < c.height; ++y) {
            for (int x = 0; x < c.width; ++x) {
                const int i = surface_.index(x, y);
                if (view_.depth_m[i] <= 0) continue;
                ++with_depth_;
                Pair pair;
                pair.view_pixel = i;
                pair.point = T * view_.camera.unproject(x, y, view_.depth_m[i]);
                if (pair.point.z() < 0.1) continue;
                pair.pixel = c.project(pair.point);
                const double u = pair.pixel.x(), v = pair.pixel.y();
                if (!(u >= 1 && v >= 1 && u < c.width - 2 && v < c.height - 2)) continue;
                pair.reference_pixel = surface_.index(static_cast<int>(std::lround(u)),
                                                      static_cast<int>(std::lround(v)));
                pairs_.push_back(pair);
            }
        }
    }

    /** What the noise of normals adds to the information: a flat thing seems to hold every
     *  direction, as each reading tilts the surface a little. Normals of pixels that share no
     *  reading tilt independently, so that products of two show the surface without the noise. */
    Matrix6d informationOfNoise() const {
        Matrix6d noise = Matrix6d::Zero();
        for (const Pair& pair : pairs_) {
            const Eigen::Vector3d& normal = surface_.normals[pair.reference_pixel];
            const Eigen::Vector3d& other = surface_.normals[independentNeighbor(pair)];
            if (normal.isZero() || other.isZero()) continue;
            const double distance = normal.dot(pair.point - surface_.points[pair.reference_pixel]);
            const double sigma = sigmaOf(pair);
            if (std::abs(distance) > 3 * sigma) continue;
            const Vector6d a = surfaceJacobian(pair.point, normal) / sigma;
            const Vector6d b = surfaceJacobian(pair.point, other) / sigma;
            noise.noalias() += 0.5 * (a - b) * (a - b).transpose();
        }
        return noise;
    }

    int independentNeighbor(const Pair& pair) const {
        constexpr int apart = 3;
        const int column = pair.reference_pixel % surface_.camera.width;
        return pair.reference_pixel + (column >= apart ? -apart : apart);
    }

    /** Errors of depth grow with its square. */
    static double sigmaOf(const Pair& pair) {
        return surface_sigma_m * std::max(1.0, 0.25 * pair.point.squaredNorm());
    }

    static Vector6d surfaceJacobian(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
        Vector6d jacobian;
        jacobian << normal, point.cross(normal);
        return jacobian;
    }

    void add(double residual, const Vector6d& jacobian) {
        const double weight = huber(residual * residual, huber_sigmas * huber_sigmas).weight;
        hessian_.noalias() += weight * jacobian * jacobian.transpose();
        gradient_.noalias() += weight * residual * jacobian;
    }

    void addSurface(const Pair& pair) {
        const Eigen::Vector3d& normal = surface_.normals[pair.reference_pixel];
        if (normal.isZero()) return;
        const double distance = normal.dot(pair.point - surface_.points[pair.reference_pixel]);
        ++surfaces_;
        const double sigma = sigmaOf(pair);
        if (std::abs(distance) > widest_m_ + 3 * (sigma - surface_sigma_m)) return;
        fitting_surfaces_ += std::abs(distance) < 3 * sigma;
        add(distance / sigma, surfaceJacobian(pair.point, normal) / sigma);
    }

    double referenceGray(int x, int y) const { return surface_.view.gray[surface_.index(x, y)]; }

    /** Bilinear, with its derivative. */
    double sample(const Eigen::Vector2d& pixel, Eigen::Vector2d& gradient) const {
        const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
        const double a = pixel.x() - x, b = pixel.y() - y;
        const double g00 = referenceGray(x, y), g10 = referenceGray(x + 1, y);
        const double g01 = referenceGray(x, y + 1), g11 = referenceGray(x + 1, y + 1);
        gradient = {(1 - b) * (g10 - g00) + b * (g11 - g01),
                    (1 - a) * (g01 - g00) + a * (g11 - g10)};
        return (1 - b) * ((1 - a) * g00 + a * g10) + b * ((1 - a) * g01 + a * g11);
    }

    void normalizeGray() {
        Eigen::Vector2d unused;
        of_reference_ = statistics([&](const Pair& p) { return sample(p.pixel, unused); });
        of_view_ = statistics([&](const Pair& p) { return view_.gray[p.view_pixel]; });
    }

    template <class Gray>
    GrayStatistics statistics(Gray&& gray) const {
        double sum = 0, squares = 0;
        for (const Pair& pair : pairs_) {
            const double g = gray(pair);
            sum += g;
            squares += g * g;
        }
        const double count = std::max<double>(1, static_cast<double>(pairs_.size()));
        const double mean = sum / count;
        return {mean, std::sqrt(std::max(1.0, squares / count - mean * mean))};
    }

    void addGray(const Pair& pair) {
        Eigen::Vector2d gradient;
        const double seen = (view_.gray[pair.view_pixel] - of_view_.mean) / of_view_.deviation;
        const double expected =
            (sample(pair.pixel, gradient) - of_reference_.mean) / of_reference_.deviation;
        const double residual = (expected - seen) / gray_sigma;
        ++grays_;
        fitting_grays_ += std::abs(residual) < 3;
        const Eigen::Vector2d g = gradient / (of_reference_.deviation * gray_sigma);
        const Eigen::Vector3d& p = pair.point;
        const Eigen::Vector3d by_point = surface_.camera.pointGradient(g, p);
        Vector6d jacobian;
        jacobian << by_point, p.cross(by_point);
        add(residual, jacobian);
    }

    const Surface surface_;
    const DenseView& view_;
    const double widest_m_;
    bool uses_gray_ = false;
    std::vector<Pair> pairs_;
    GrayStatistics of_reference_, of_view_;
    Matrix6d hessian_;
    Vector6d gradient_;
    int with_depth_ = 0, surfaces_ = 0, fitting_surfaces_ = 0, grays_ = 0, fitting_grays_ = 0;
    double overlap_ = 0;
};

std::vector<DenseView> pyramidOf(const DenseView& view) {
    std::vector<DenseView> levels{view};
    while (static_cast<int>(levels.size()) < pyramid_levels)
        levels.push_back(halved(levels.back()));
    return levels;
}

}  // namespace

std::optional<DenseAlignment> alignDensely(const DenseView& reference, const DenseView& view,
                                           const SE3& initial) {
    if (reference.depthShare() < least_depth_share || view.depthShare() < least_depth_share) {
        return std::nullopt;
    }
    const auto references = pyramidOf(reference), views = pyramidOf(view);
    DenseAlignment alignment;
    SE3& T = alignment.T_reference_view;
    T = initial;
    for (int l = pyramid_levels - 1; l > 0; --l) {
        Level(references[l], views[l], widest_pair_m[l]).align(T);
    }
    Level finest(references[0], views[0], widest_pair_m[0]);
    finest.align(T);
    if (!finest.good(T)) return std::nullopt;
    const SE3 correction = initial.inverse() * T;
    if (correction.t.norm() > largest_step_m || correction.angle() > largest_step_rad) {
        return std::nullopt;
    }
    alignment.overlap = finest.overlap();
    return alignment;
}

}  // namespace rgbd_graphslam
