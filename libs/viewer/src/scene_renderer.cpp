#include "scene_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/viewer/keyframe_view.h"

namespace rgbd_graphslam {
namespace {

constexpr float widest_spacing_m = 0.02f;
constexpr double fewest_points = 15000, fewest_sharp_points = 50000, most_points = 2e7;

/** Of points that lie on surfaces, estimated from chunks as if each were a disc. */
float spacingOf(const std::vector<PointChunk>& chunks) {
    if (chunks.empty()) return widest_spacing_m;
    std::vector<double> spacings;
    spacings.reserve(chunks.size());
    for (const PointChunk& chunk : chunks) {
        spacings.push_back(chunk.radius_m * std::sqrt(M_PI / static_cast<double>(chunk.count)));
    }
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return std::min(static_cast<float>(*middle), widest_spacing_m);
}

}  // namespace

void SceneRenderer::setPoints(ChunkedPoints cloud) {
    map_.spacing_m = spacingOf(cloud.chunks);
    map_.buffer.set(cloud.points);
    map_.chunks = std::move(cloud.chunks);
}

void SceneRenderer::setKeyframePoints(std::size_t keyframe, const Vertices& points) {
    auto& chunks = keyframe_clouds_.chunks;
    const std::size_t first = keyframe * points_a_keyframe;
    if (chunks.size() <= keyframe) chunks.resize(keyframe + 1);
    chunks[keyframe] = chunkOf(points, first);
    keyframe_clouds_.buffer.write(first, points);
}

void SceneRenderer::begin(Picture& picture, int reduction) {
    drawn_ = &picture;
    picture.reduction = reduction;
    size_px_ = (view_.size_px / reduction).cwiseMax(1);
    picture.target.resize(size_px_);
    chooseCloud();
    drawn_share_ = 0;
}

void SceneRenderer::draw(const SceneView& view) {
    view_ = view;
    begin(moving_, coarse_ ? 2 : 1);
    shown_ = &moving_;
    const double total = std::max(static_cast<double>(useful_total_), 1.0);
    const double share = std::min(1.0, points_a_frame_ / total);
    const auto start = std::chrono::steady_clock::now();
    drawSlice(share, share, true);
    glFinish();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (share < 1 || taken.count() > view_.time_s) learnSpeed(taken.count());
    const bool is_finished = share >= 1 && moving_.reduction == 1 && view_.of(Part::Mesh) == 0;
    if (!is_finished) begin(resting_, 1);
}

bool SceneRenderer::refine() {
    if (complete()) return false;
    const double step = points_a_frame_ / std::max(static_cast<double>(useful_total_), 1.0);
    const double share = std::min(1.0, drawn_share_ + step);
    drawSlice(share, 1, share >= 1);
    glFinish();
    if (complete()) shown_ = &resting_;
    return !complete();
}

void SceneRenderer::copyToWindow() const {
    shown_->target.copyToWindow(cv::Rect(0, 0, view_.size_px.x(), view_.size_px.y()),
                                view_.size_px);
}

cv::Mat1f SceneRenderer::depthsAround(const Eigen::Vector2i& pixel, int radius_px) const {
    const int reduction = shown_->reduction, reduced_radius = radius_px / reduction + 1;
    const Eigen::Vector2i center = pixel / reduction;
    cv::Mat1f depths = shown_->target.depthsAround(center, reduced_radius);
    cv::resize(depths, depths, {}, reduction, reduction, cv::INTER_NEAREST);
    const Eigen::Vector2i corner =
        pixel.array() - radius_px - reduction * (center.array() - reduced_radius);
    return depths(cv::Rect(corner.x(), corner.y(), 2 * radius_px + 1, 2 * radius_px + 1)).clone();
}

void SceneRenderer::chooseCloud() {
    cloud_ = view_.keyframe_clouds > 0 ? &keyframe_clouds_ : &map_;
    useful_.clear();
    if (view_.points) useful_ = usefulPoints(cloud_->chunks, view_.camera, size_px_);
    if (view_.keyframe_clouds > 0) useful_.resize(std::min(useful_.size(), view_.keyframe_clouds));
    useful_total_ = std::accumulate(useful_.begin(), useful_.end(), std::size_t{0});
}

Vertices SceneRenderer::shownPoints() const {
    Vertices shown;
    for (std::size_t c = 0; c < useful_.size(); ++c) {
        const PointChunk& chunk = cloud_->chunks[c];
        for (const Vertex& point : cloud_->buffer.read(chunk.first, chunk.count)) {
            if (point.position.z() <= view_.highest_m) shown.push_back(point);
        }
    }
    return shown;
}

void SceneRenderer::learnSpeed(double seconds) {
    const double change = std::clamp(view_.time_s / seconds, 0.7, 1.4);
    points_a_frame_ = std::clamp(change * points_a_frame_, fewest_points, most_points);
    // The gap between the two bounds keeps it from changing to and fro.
    if (points_a_frame_ < fewest_sharp_points) coarse_ = true;
    if (points_a_frame_ > 4 * fewest_sharp_points) coarse_ = false;
}

/** Adds the points up to a share of the useful ones to the picture that is bound. */
void SceneRenderer::drawSlice(double to_share, double density, bool is_last) {
    const Canvas canvas{view_, size_px_, drawn_->reduction, drawn_ == &moving_};
    drawn_->target.bind();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    if (drawn_share_ == 0) {
        geometry_.drawFirst(canvas);
        points_drawn_ = 0;
    }
    if (useful_total_ > 0) drawPoints(canvas, to_share, density);
    if (is_last) geometry_.drawLast(canvas);
    drawn_share_ = to_share;
    glBindVertexArray(0);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void SceneRenderer::drawPoints(const Canvas& canvas, double to_share, double density) {
    const auto ranges = slice(cloud_->chunks, useful_, drawn_share_, to_share);
    for (const DrawRange& range : ranges) points_drawn_ += range.count;
    geometry_.drawPoints(canvas, cloud_->buffer, ranges, cloud_->spacing_m, density);
}

}  // namespace rgbd_graphslam
