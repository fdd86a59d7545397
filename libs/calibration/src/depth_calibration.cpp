#include "rgbd_graphslam/calibration/depth_calibration.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/depth_noise.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {

constexpr int stride_px = 3;
constexpr std::size_t fewest_readings = 1000;
/** Readings farther from the board's plane are not of it; of the last rounds, in deviations. */
constexpr double widest_m = 0.10, most_sigmas = 3;
constexpr int rounds = 12, rough_rounds = 4;
/** Neighboring views tell how fast the board moves. */
constexpr double longest_step_s = 0.25;
/** Delays (s) less certain are not told. */
constexpr double worst_delay_sigma_s = 0.002;
constexpr double bin_m = 0.25;

/** Translation, rotation, scale, delay. */
constexpr int unknowns = 8;
using Vector = Eigen::Matrix<double, unknowns, 1>;
using Matrix = Eigen::Matrix<double, unknowns, unknowns>;

/** A plane in the color camera's frame: normal . p = distance. */
struct Plane {
    Eigen::Vector3d normal;
    double distance = 0;
};

Plane planeOf(const SE3& T_cam_board) {
    const Eigen::Vector3d normal = T_cam_board.R.col(2);
    return {normal, normal.dot(T_cam_board.t)};
}

/** A view ready to be measured: its plane at the time of the depth image, and how it changes. */
struct View {
    Plane plane, per_s;
    bool moves = false;
    SE3 T_board_cam;
    const BoardDepth* source = nullptr;
};

/** One reading on the board. */
struct Reading {
    std::size_t view = 0;
    Eigen::Vector3d point_m;  // as measured, depth camera
};

std::vector<View> viewsOf(const std::vector<BoardDepth>& all) {
    std::vector<View> views;
    for (std::size_t i = 0; i < all.size(); ++i) {
        View view{planeOf(all[i].T_cam_board),
                  {Eigen::Vector3d::Zero(), 0},
                  false,
                  all[i].T_cam_board.inverse(),
                  &all[i]};
        if (i > 0 && i + 1 < all.size()) {
            const double span_s = all[i + 1].stamp_s - all[i - 1].stamp_s;
            const Plane before = planeOf(all[i - 1].T_cam_board);
            const Plane after = planeOf(all[i + 1].T_cam_board);
            if (span_s > 0 && span_s <= longest_step_s) {
                view.per_s = {(after.normal - before.normal) / span_s,
                              (after.distance - before.distance) / span_s};
                view.moves = true;
            }
        }
        const double late_s = all[i].depth_stamp_s - all[i].stamp_s;
        view.plane.normal += late_s * view.per_s.normal;
        view.plane.distance += late_s * view.per_s.distance;
        views.push_back(view);
    }
    return views;
}

bool isInside(const std::vector<Eigen::Vector2d>& convex, const Eigen::Vector2d& p) {
    bool left = true, right = true;
    for (std::size_t i = 0; i < convex.size(); ++i) {
        const Eigen::Vector2d edge = convex[(i + 1) % convex.size()] - convex[i],
                              to = p - convex[i];
        const double side = edge.x() * to.y() - edge.y() * to.x();
        left = left && side >= 0;
        right = right && side <= 0;
    }
    return left || right;
}

/** What is estimated, and one round of it. */
class Adjustment {
  public:
    Adjustment(const std::vector<BoardDepth>& all, const DepthCameraOptions& options)
        : options_(options), views_(viewsOf(all)) {
        state_.T_color_depth = options.T_color_depth;
        collect();
    }

    void run() {
        for (int round = 0; round < rounds; ++round) {
            const double limit = round < rough_rounds ? 1e9 : most_sigmas;
            step(limit);
        }
    }

    DepthCalibration result() const;
    std::size_t readings() const { return readings_.size(); }

  private:
    struct State {
        SE3 T_color_depth;
        double scale = 1, delay_s = 0;
    };

    /** Readings that the calibration so far puts on the board. */
    void collect() {
        const CameraModel camera(options_.camera);
        for (std::size_t v = 0; v < views_.size(); ++v) {
            const cv::Mat& depth = views_[v].source->depth;
            for (int y = 0; y < depth.rows; y += stride_px) {
                const auto* row = depth.ptr<std::uint16_t>(y);
                for (int x = 0; x < depth.cols; x += stride_px) {
                    if (row[x] == 0) continue;
                    const Eigen::Vector3d p = camera.unproject(x, y, row[x] * options_.unit_m);
                    if (isOnBoard(views_[v], p)) readings_.push_back({v, p});
                }
            }
        }
    }

    bool isOnBoard(const View& view, const Eigen::Vector3d& point_m) const {
        const Eigen::Vector3d p = view.T_board_cam * (state_.T_color_depth * point_m);
        return std::abs(p.z()) < widest_m && isInside(view.source->region_m, p.head<2>());
    }

    double sigma(const Reading& reading) const {
        return spread_ * noise_.sigma(reading.point_m.z());
    }

    /** Distance from the plane (m), and its derivatives by the unknowns. */
    double residual(const Reading& reading, Vector& J) const {
        const View& view = views_[reading.view];
        const Eigen::Vector3d n = view.plane.normal + state_.delay_s * view.per_s.normal;
        const double d = view.plane.distance + state_.delay_s * view.per_s.distance;
        const Eigen::Vector3d scaled = state_.scale * reading.point_m;
        const Eigen::Vector3d p = state_.T_color_depth * scaled;
        J.head<3>() = n;
        J.segment<3>(3) = p.cross(n);
        J[6] = n.dot(state_.T_color_depth.R * reading.point_m);
        J[7] = view.per_s.normal.dot(p) - view.per_s.distance;
        return n.dot(p) - d;
    }

    void step(double limit) {
        Matrix A = Matrix::Zero();
        Vector b = Vector::Zero(), J;
        std::vector<double> whitened;
        for (const Reading& reading : readings_) {
            const double e = residual(reading, J), s = sigma(reading);
            whitened.push_back(std::abs(e) / s);
            if (whitened.back() > limit) continue;
            A += J * J.transpose() / (s * s);
            b -= J * e / (s * s);
        }
        hold(A);
        information_ = A;
        const Vector change = A.ldlt().solve(b);
        state_.T_color_depth = state_.T_color_depth.retract(change.head<6>());
        state_.scale += change[6];
        state_.delay_s += change[7];
        spread_ *= std::max(1e-3, 1.4826 * percentileOf(std::move(whitened), 0.5));
    }

    /** Unknowns that are given, or that nothing tells, stay. */
    void hold(Matrix& A) const {
        if (options_.registered) A.topLeftCorner<6, 6>().diagonal().array() += 1e18;
        A(7, 7) += 1e2;  // 0.1 s
    }

    double scaleOfView(std::size_t view) const;

    const DepthCameraOptions options_;
    const DepthNoise noise_;
    const std::vector<View> views_;
    std::vector<Reading> readings_;
    State state_;
    double spread_ = 1;  // of the noise against its model
    Matrix information_ = Matrix::Identity();
};

/** The scale by the median of one view's readings alone, relative to that of all. */
double Adjustment::scaleOfView(std::size_t view) const {
    std::vector<double> scales;
    Vector J;
    for (const Reading& reading : readings_) {
        if (reading.view != view) continue;
        const double e = residual(reading, J);
        if (std::abs(e) < most_sigmas * sigma(reading) && std::abs(J[6]) > 1e-6)
            scales.push_back(state_.scale - e / J[6]);
    }
    return scales.size() < 50 ? 0 : percentileOf(std::move(scales), 0.5);
}

std::vector<DepthErrorBin> binned(const std::vector<std::pair<double, double>>& errors) {
    std::vector<DepthErrorBin> bins;
    for (const auto& [depth_m, error_m] : errors) {
        const auto i = static_cast<std::size_t>(depth_m / bin_m);
        if (i >= bins.size()) bins.resize(i + 1);
        bins[i].depth_m += depth_m;
        bins[i].bias_m += error_m;
        bins[i].sigma_m += error_m * error_m;
        ++bins[i].readings;
    }
    std::vector<DepthErrorBin> full;
    for (DepthErrorBin bin : bins) {
        if (bin.readings < 100) continue;
        const auto count = static_cast<double>(bin.readings);
        bin.depth_m /= count;
        bin.bias_m /= count;
        bin.sigma_m = std::sqrt(std::max(0.0, bin.sigma_m / count - bin.bias_m * bin.bias_m));
        full.push_back(bin);
    }
    return full;
}

DepthCalibration Adjustment::result() const {
    DepthCalibration result;
    result.scale = state_.scale;
    result.T_color_depth = state_.T_color_depth;
    result.readings = readings_.size();
    std::vector<double> scales;
    for (std::size_t v = 0; v < views_.size(); ++v) {
        const double scale = scaleOfView(v);
        if (scale > 0) scales.push_back(scale);
    }
    result.views = scales.size();
    result.scale_sigma = statisticsOf(scales).std /
                         std::sqrt(static_cast<double>(std::max<std::size_t>(1, scales.size())));
    const Matrix covariance = information_.inverse();
    result.delay_sigma_s = std::sqrt(covariance(7, 7));
    const bool moved =
        std::any_of(views_.begin(), views_.end(), [](const View& v) { return v.moves; });
    if (moved && result.delay_sigma_s < worst_delay_sigma_s) result.delay_s = state_.delay_s;
    std::vector<std::pair<double, double>> errors;
    std::vector<double> distances;
    Vector J;
    for (const Reading& reading : readings_) {
        const double e = residual(reading, J);
        if (std::abs(e) > most_sigmas * sigma(reading) || std::abs(J[6]) < 1e-6) continue;
        distances.push_back(e);
        // Along the depth: the slant of the board stretches it.
        errors.emplace_back(reading.point_m.z(), e / J[6] * reading.point_m.z());
    }
    result.rms_m = statisticsOf(distances).rmse;
    result.errors = binned(errors);
    return result;
}

}  // namespace

DepthCalibration calibrateDepth(const std::vector<BoardDepth>& views, const Intrinsics& color,
                                const DepthCameraOptions& options) {
    DepthCameraOptions wanted = options;
    if (options.registered) wanted.camera = color;
    Adjustment adjustment(views, wanted);
    if (adjustment.readings() < fewest_readings) {
        throw Error(std::to_string(adjustment.readings()) + " depth readings lie on the board",
                    "show it 0.5 to 2 m away, and check depth_units and the pose of the depth "
                    "camera");
    }
    adjustment.run();
    return adjustment.result();
}

}  // namespace rgbd_graphslam
