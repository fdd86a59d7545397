#include "straight_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace rgbd_graphslam {
namespace {

constexpr double canny_low = 60, canny_high = 150;  // of Sobel's gradient, gray levels
constexpr double bend_px = 1.5, bend_share = 0.035;
constexpr std::size_t fewest_points = 20;

using Chain = std::vector<cv::Point>;

/** Neighbors straight ahead come first, so that a crossing is passed without a turn. */
std::optional<cv::Point> nextOf(const cv::Mat1b& edges, cv::Point at, cv::Point direction) {
    std::optional<cv::Point> next;
    int best = -3;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const cv::Point p(at.x + dx, at.y + dy);
            const int ahead = dx * direction.x + dy * direction.y;
            if (ahead > best && edges(p)) best = ahead, next = p;
        }
    }
    return next;
}

/** Follows an edge to its end and takes its pixels out of the image. */
void follow(cv::Mat1b& edges, cv::Point at, Chain& chain) {
    cv::Point direction(0, 0);
    while (const auto next = nextOf(edges, at, direction)) {
        direction = *next - at;
        at = *next;
        edges(at) = 0;
        chain.push_back(at);
    }
}

/** All edges, each pixel in one of them. \param edges with an empty border; emptied */
std::vector<Chain> chainsOf(cv::Mat1b& edges) {
    std::vector<Chain> chains;
    for (int y = 1; y + 1 < edges.rows; ++y) {
        for (int x = 1; x + 1 < edges.cols; ++x) {
            if (!edges(y, x)) continue;
            edges(y, x) = 0;
            Chain chain;
            follow(edges, {x, y}, chain);
            std::reverse(chain.begin(), chain.end());
            chain.emplace_back(x, y);
            follow(edges, {x, y}, chain);
            if (chain.size() >= fewest_points) chains.push_back(std::move(chain));
        }
    }
    return chains;
}

/** The steepest place beside a pixel, across the edge; nothing where it is not within a pixel. */
std::optional<cv::Point2f> refined(const cv::Mat1f& steepness, cv::Point p, bool is_upright) {
    const cv::Point across = is_upright ? cv::Point(1, 0) : cv::Point(0, 1);
    const float before = steepness(p - across), here = steepness(p), after = steepness(p + across);
    const float curvature = before - 2 * here + after;
    if (curvature >= 0) return std::nullopt;
    const float offset = 0.5F * (before - after) / curvature;
    if (std::abs(offset) > 1) return std::nullopt;
    return cv::Point2f(p) + offset * cv::Point2f(across);
}

/** Pieces of a chain that hardly bend: it is cut where it lies farthest from its chord. */
void cut(const EdgePoints& points, std::size_t from, std::size_t to, double shortest_px,
         std::vector<EdgePoints>& pieces) {
    if (to - from < std::max(fewest_points, static_cast<std::size_t>(shortest_px / 2))) return;
    const cv::Point2f chord = points[to - 1] - points[from];
    const double length = cv::norm(chord);
    std::size_t farthest = from;
    double distance = 0;
    for (std::size_t i = from; i < to; ++i) {
        const cv::Point2f d = points[i] - points[from];
        const double off = std::abs(chord.cross(d)) / std::max(length, 1e-9);
        if (off > distance) distance = off, farthest = i;
    }
    if (length >= shortest_px && distance <= std::max(bend_px, bend_share * length)) {
        pieces.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(from),
                            points.begin() + static_cast<std::ptrdiff_t>(to));
    } else if (distance > 0) {
        cut(points, from, farthest, shortest_px, pieces);
        cut(points, farthest + 1, to, shortest_px, pieces);
    }
}

}  // namespace

std::vector<EdgePoints> straightEdges(const cv::Mat& gray, double shortest_px) {
    cv::Mat smooth, dx, dy;
    cv::GaussianBlur(gray, smooth, {}, 1.0);
    cv::Sobel(smooth, dx, CV_16S, 1, 0);
    cv::Sobel(smooth, dy, CV_16S, 0, 1);
    cv::Mat1b edges;
    cv::Canny(dx, dy, edges, canny_low, canny_high, true);
    cv::rectangle(edges, {0, 0}, {edges.cols - 1, edges.rows - 1}, 0);
    cv::Mat1f fx, fy, steepness;
    dx.convertTo(fx, CV_32F);
    dy.convertTo(fy, CV_32F);
    cv::magnitude(fx, fy, steepness);

    std::vector<EdgePoints> pieces;
    for (const Chain& chain : chainsOf(edges)) {
        EdgePoints points;
        for (const cv::Point& p : chain) {
            const bool is_upright = std::abs(fx(p)) >= std::abs(fy(p));
            if (const auto place = refined(steepness, p, is_upright)) points.push_back(*place);
        }
        cut(points, 0, points.size(), shortest_px, pieces);
    }
    return pieces;
}

}  // namespace rgbd_graphslam
