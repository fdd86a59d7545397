#include "rgbd_graphslam/dataset/lens_check.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <variant>

#include "rgbd_graphslam/core/formatted.h"
#include "straight_edges.h"

namespace rgbd_graphslam {
namespace {

/** Length of an edge that says something, of the image's width. */
constexpr double shortest_share = 0.1;
/** Where an edge's deviation (px²) begins to look like that of a curve. */
constexpr double usual_deviation_px2 = 0.05, most_deviation_px2 = 0.3;
constexpr std::size_t points_per_edge = 48;

constexpr std::size_t fewest_frames = 8, fewest_bins = 15;
constexpr double smallest_share = 0.01, smallest_k1 = 0.03, least_sigmas = 6, least_straight = 0.6;

constexpr int directions = 12, offsets = 12;

using Points = Eigen::Matrix2Xd;

bool isFisheye(const CameraModel& camera) {
    return std::holds_alternative<KannalaBrandtLens>(camera.intrinsics().lens);
}

double triedK1(int i) {
    return -LensCheck::reach + i * LensCheck::step;
}

/** Some points of an edge on the plane at distance 1, without the calibrated lens. */
Points normalized(const EdgePoints& edge, const CameraModel& camera) {
    const std::size_t n = std::min(points_per_edge, edge.size());
    Points points(2, n);
    for (std::size_t i = 0; i < n; ++i) {
        const cv::Point2f& p = edge[i * (edge.size() - 1) / (n - 1)];
        points.col(static_cast<Eigen::Index>(i)) = camera.unproject(p.x, p.y, 1).head<2>();
    }
    return points;
}

/** Where points would lie without a lens with this k1, which moved them from r to r (1 + k1 r²):
 *  Newton's method for the quotient of both. Where the image would fold over, the last place before
 *  that. */
Points undistorted(const Points& points, double k1) {
    const Eigen::Array<double, 1, Eigen::Dynamic> bend =
        (k1 * points.colwise().squaredNorm().array()).max(-4.0 / 27);
    Eigen::Array<double, 1, Eigen::Dynamic> quotient = 1 / (1 + bend);
    for (int i = 0; i < 3; ++i) {
        quotient -= (quotient + bend * quotient.cube() - 1) / (1 + 3 * bend * quotient.square());
    }
    return points * quotient.matrix().asDiagonal();
}

/** Mean squared distance from the best line. */
double deviation(const Points& points) {
    const Eigen::Vector2d mean = points.rowwise().mean();
    const Points centered = points.colwise() - mean;
    const Eigen::Matrix2d scatter = centered * centered.transpose() / double(points.cols());
    return std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>()
                             .computeDirect(scatter, Eigen::EigenvaluesOnly)
                             .eigenvalues()
                             .x());
}

/** Mean squared deviation (px²) from a line for each coefficient tried. */
LensCheck::Curve deviationsOf(const EdgePoints& edge, const CameraModel& camera) {
    const Points points = normalized(edge, camera);
    LensCheck::Curve deviations;
    for (int i = 0; i < LensCheck::tried; ++i) {
        deviations[i] = deviation(undistorted(points, triedK1(i)));
    }
    return deviations * camera.pixelsPerSteradian();
}

/** Which of the bins an edge lies in, by its direction and its distance from the principal point:
 *  frames of a camera at rest show the same edges again and again, which are no new evidence. */
std::size_t binOf(const EdgePoints& edge, const CameraModel& camera) {
    const Eigen::Vector3d a = camera.unproject(edge.front().x, edge.front().y, 1),
                          b = camera.unproject(edge.back().x, edge.back().y, 1);
    Eigen::Vector3d line = a.cross(b);
    if (line.y() < 0) line = -line;
    const double direction = std::atan2(line.y(), line.x()) / M_PI;
    const double offset =
        line.z() / line.head<2>().norm() / (0.5 * camera.width / camera.pixelsPerRadian().x());
    const int row = std::min(directions - 1, int(direction * directions));
    const int column = std::clamp(int((offset + 1) / 2 * offsets), 0, offsets - 1);
    return static_cast<std::size_t>(row * offsets + column);
}

/** The lowest cost's coefficient, between those tried. */
double bestK1(const LensCheck::Curve& costs) {
    Eigen::Index i = 0;
    costs.minCoeff(&i);
    i = std::clamp<Eigen::Index>(i, 1, costs.size() - 2);
    const double curvature = costs[i - 1] - 2 * costs[i] + costs[i + 1];
    const double offset = curvature > 0 ? 0.5 * (costs[i - 1] - costs[i + 1]) / curvature : 0;
    return triedK1(static_cast<int>(i)) + LensCheck::step * std::clamp(offset, -1.0, 1.0);
}

/** Standard deviation of bestK1() of the sum of all costs, by leaving out each (jackknife). */
double sigmaOf(const std::vector<LensCheck::Curve>& costs, const LensCheck::Curve& all) {
    Eigen::ArrayXd without(costs.size());
    for (std::size_t i = 0; i < costs.size(); ++i) without[i] = bestK1(all - costs[i]);
    const double n = double(costs.size());
    return std::sqrt((n - 1) / n * (without - without.mean()).square().sum());
}

}  // namespace

std::string toText(const LensDistortion& found) {
    return formatted(
        "straight edges bend as through a lens with k1 = %.2f (+- %.2f) that the calibration "
        "leaves out: %.0f px at the left and right border",
        found.k1, found.k1_sigma, std::abs(found.border_px));
}

LensCheck::LensCheck(const CameraModel& camera)
    : camera_(camera), bins_(std::size_t{directions} * offsets) {}

void LensCheck::add(const cv::Mat& color) {
    const bool fits = color.cols == camera_.width && color.rows == camera_.height;
    if (!fits || isFisheye(camera_)) return;
    cv::Mat gray = color;
    if (color.channels() == 3) cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
    for (const EdgePoints& edge : straightEdges(gray, shortest_share * gray.cols)) {
        Bin& bin = bins_[binOf(edge, camera_)];
        const double length_px = cv::norm(edge.back() - edge.front());
        const Curve deviations = deviationsOf(edge, camera_);
        bin.costs += length_px * (1 + deviations / usual_deviation_px2).log();
        bin.straight += length_px * (deviations < most_deviation_px2).cast<double>();
        bin.length_px += length_px;
    }
    ++frames_;
}

std::vector<LensCheck::Curve> LensCheck::votes() const {
    std::vector<Curve> votes;
    for (const Bin& bin : bins_) {
        if (bin.length_px > 0) votes.push_back(bin.costs / std::sqrt(bin.length_px));
    }
    return votes;
}

double LensCheck::straightShare(double k1) const {
    const int nearest = std::clamp(int(std::lround((k1 + reach) / step)), 0, tried - 1);
    double straight = 0, all = 0;
    for (const Bin& bin : bins_) {
        if (bin.length_px == 0) continue;
        straight += bin.straight[nearest] / std::sqrt(bin.length_px);
        all += std::sqrt(bin.length_px);
    }
    return all > 0 ? straight / all : 0;
}

std::optional<LensDistortion> LensCheck::estimate() const {
    const auto votes = this->votes();
    if (votes.size() < 2) return std::nullopt;
    const Curve all = std::accumulate(votes.begin(), votes.end(), Curve(Curve::Zero()));
    LensDistortion found;
    found.k1 = bestK1(all);
    found.k1_sigma = sigmaOf(votes, all);
    const double border = 0.5 * camera_.width / camera_.pixelsPerRadian().x();
    found.border_px = found.k1 * std::pow(border, 3) * camera_.pixelsPerRadian().x();
    return found;
}

std::optional<LensDistortion> LensCheck::finding() const {
    if (frames_ < fewest_frames || votes().size() < fewest_bins) return std::nullopt;
    const auto found = estimate();
    const bool is_large = std::abs(found->border_px) > smallest_share * camera_.width &&
                          std::abs(found->k1) > smallest_k1;
    const bool is_clear = std::abs(found->k1) > least_sigmas * found->k1_sigma;
    // Curves of the scene may bend about the center, too, but no lens makes lines of them.
    const double straight = straightShare(found->k1);
    const bool makes_lines = straight > least_straight && straight > straightShare(0);
    if (!is_large || !is_clear || !makes_lines) return std::nullopt;
    return found;
}

}  // namespace rgbd_graphslam
