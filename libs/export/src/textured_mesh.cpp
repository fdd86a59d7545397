#include "rgbd_graphslam/export/textured_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <unordered_map>

namespace rgbd_graphslam {
namespace {

/** Around each chart, so that neither interpolation nor JPEG mix it with its neighbors. */
constexpr int padding_px = 2;
/** The block that JPEG compresses at a time. */
constexpr int swatch_px = 8;
/** Of the colors of swatches, so that a few hundred serve all triangles. */
constexpr int swatch_step = 8;

Eigen::Vector2f pixelOf(const Eigen::Vector3f& vertex, const Camera& camera,
                        const SE3& T_cam_world) {
    return camera.project(T_cam_world * vertex.cast<double>()).cast<float>();
}

/** To texture coordinates; 0 is the left or upper edge of the first pixel. */
Eigen::Vector2f toUv(const Eigen::Vector2f& pixel, const cv::Size& size) {
    return {(pixel.x() + 0.5f) / static_cast<float>(size.width),
            (pixel.y() + 0.5f) / static_cast<float>(size.height)};
}

Eigen::Array2f asArray(const cv::Point& point) {
    return {static_cast<float>(point.x), static_cast<float>(point.y)};
}

Eigen::Array2f asArray(const cv::Size& size) {
    return asArray(cv::Point(size.width, size.height));
}

/** The part of an image, with what is beyond its border repeated. */
cv::Mat3b cutOut(const cv::Mat3b& image, const cv::Rect& rect) {
    const cv::Rect inside = rect & cv::Rect(0, 0, image.cols, image.rows);
    cv::Mat3b result;
    cv::copyMakeBorder(image(inside), result, inside.y - rect.y, rect.br().y - inside.br().y,
                       inside.x - rect.x, rect.br().x - inside.br().x, cv::BORDER_REPLICATE);
    return result;
}

cv::Vec3b roundedColor(const PlyModel& mesh, const std::array<std::uint32_t, 3>& triangle) {
    cv::Vec3b bgr;
    for (int channel = 0; channel < 3; ++channel) {
        int sum = 0;
        for (const std::uint32_t vertex : triangle)
            sum += mesh.colors[vertex][static_cast<std::size_t>(2 - channel)];
        const int value = swatch_step * ((sum / 3 + swatch_step / 2) / swatch_step);
        bgr[channel] = static_cast<std::uint8_t>(std::min(255, value));
    }
    return bgr;
}

}  // namespace

TextureBuilder::TextureBuilder(const PlyModel& mesh, int most_px)
    : mesh_(mesh), most_px_(most_px), selection_(mesh) {}

void TextureBuilder::addView(int view, const Camera& camera, const SE3& T_world_cam,
                             const cv::Mat1w& depth, double depth_unit_m) {
    views_.push_back({view, camera, T_world_cam});
    selection_.add(view, camera, T_world_cam, depth, depth_unit_m);
}

double TextureBuilder::coveredShare() const {
    if (view_of_triangle_.empty()) return 0;
    return 1 - static_cast<double>(swatch_of_triangle_.size()) /
                   static_cast<double>(view_of_triangle_.size());
}

const TextureBuilder::View& TextureBuilder::viewOf(int number) const {
    return *std::lower_bound(views_.begin(), views_.end(), number,
                             [](const View& view, int n) { return view.number < n; });
}

void TextureBuilder::plan() {
    collectCharts();
    measureCharts();
    collectSwatches();
    std::vector<cv::Size> sizes;
    for (const Chart& chart : charts_) sizes.push_back(chart.in_image.size());
    sizes.resize(sizes.size() + swatches_.size(), {swatch_px, swatch_px});
    layout_ = packAtlas(sizes, most_px_);
    result_.texture = cv::Mat3b::zeros(layout_.size);
    placeCharts();
    placeSwatches();
}

void TextureBuilder::collectCharts() {
    const TriangleNeighbors neighbors = neighborsOf(mesh_.triangles);
    view_of_triangle_ = selection_.views(neighbors);
    std::vector<bool> taken(mesh_.triangles.size());
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        if (taken[i] || view_of_triangle_[i] == ViewSelection::no_view) continue;
        charts_.push_back(chartFrom(i, neighbors, taken));
    }
}

TextureBuilder::Chart TextureBuilder::chartFrom(std::uint32_t seed,
                                                const TriangleNeighbors& neighbors,
                                                std::vector<bool>& taken) const {
    Chart chart;
    chart.view = view_of_triangle_[seed];
    chart.triangles.push_back(seed);
    taken[seed] = true;
    for (std::size_t next = 0; next < chart.triangles.size(); ++next) {
        for (const std::int32_t neighbor : neighbors[chart.triangles[next]]) {
            if (neighbor < 0 || taken[neighbor] || view_of_triangle_[neighbor] != chart.view)
                continue;
            taken[neighbor] = true;
            chart.triangles.push_back(static_cast<std::uint32_t>(neighbor));
        }
    }
    return chart;
}

void TextureBuilder::measureCharts() {
    for (Chart& chart : charts_) {
        const View& view = viewOf(chart.view);
        const SE3 T_cam_world = view.T_world_cam.inverse();
        Eigen::Array2f low(1e9f, 1e9f), high(-1e9f, -1e9f);
        for (const std::uint32_t triangle : chart.triangles) {
            for (const std::uint32_t vertex : mesh_.triangles[triangle]) {
                const Eigen::Array2f pixel =
                    pixelOf(mesh_.vertices[vertex], view.camera, T_cam_world);
                low = low.min(pixel);
                high = high.max(pixel);
            }
        }
        const Eigen::Array2i first = low.floor().cast<int>() - padding_px,
                             last = high.ceil().cast<int>() + padding_px;
        chart.in_image = {cv::Point(first.x(), first.y()), cv::Point(last.x() + 1, last.y() + 1)};
    }
}

void TextureBuilder::collectSwatches() {
    std::map<std::array<std::uint8_t, 3>, std::size_t> known;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        if (view_of_triangle_[i] != ViewSelection::no_view) continue;
        const cv::Vec3b color = roundedColor(mesh_, mesh_.triangles[i]);
        const auto [entry, is_new] =
            known.try_emplace({color[0], color[1], color[2]}, swatches_.size());
        if (is_new) swatches_.push_back(color);
        swatch_of_triangle_.emplace_back(i, entry->second);
    }
}

void TextureBuilder::placeCharts() {
    for (std::size_t c = 0; c < charts_.size(); ++c) {
        Chart& chart = charts_[c];
        chart.first_vertex = result_.vertices.size();
        placeChart(chart, layout_.corners[c]);
        chart.last_vertex = result_.vertices.size();
    }
}

void TextureBuilder::placeChart(const Chart& chart, const cv::Point& corner) {
    const View& view = viewOf(chart.view);
    const SE3 T_cam_world = view.T_world_cam.inverse();
    const cv::Size size = scaled(chart.in_image.size(), layout_.scale);
    const Eigen::Array2f from = asArray(chart.in_image.tl()), to = asArray(corner),
                         stretch = asArray(size) / asArray(chart.in_image.size());
    std::unordered_map<std::uint32_t, std::uint32_t> number;  // of the mesh's vertices
    const auto numberOf = [&](std::uint32_t vertex) {
        const auto next = static_cast<std::uint32_t>(result_.vertices.size());
        const auto [entry, is_new] = number.try_emplace(vertex, next);
        if (!is_new) return entry->second;
        const Eigen::Array2f pixel = pixelOf(mesh_.vertices[vertex], view.camera, T_cam_world);
        addVertex(vertex, to + (pixel - from + 0.5f) * stretch - 0.5f);
        return next;
    };
    for (const std::uint32_t triangle : chart.triangles) {
        const auto& [a, b, c] = mesh_.triangles[triangle];
        const std::uint32_t first = numberOf(a), second = numberOf(b);
        result_.triangles.push_back({first, second, numberOf(c)});
    }
}

void TextureBuilder::addVertex(std::uint32_t vertex, const Eigen::Vector2f& pixel) {
    result_.vertices.push_back(mesh_.vertices[vertex]);
    result_.uv.push_back(toUv(pixel, layout_.size));
    source_.push_back(vertex);
}

void TextureBuilder::placeSwatches() {
    const cv::Size size = scaled({swatch_px, swatch_px}, layout_.scale);
    const std::size_t first = charts_.size();
    for (std::size_t s = 0; s < swatches_.size(); ++s) {
        result_.texture(cv::Rect(layout_.corners[first + s], size))
            .setTo(cv::Scalar(swatches_[s][0], swatches_[s][1], swatches_[s][2]));
    }
    for (const auto& [triangle, swatch] : swatch_of_triangle_) {
        const cv::Point corner = layout_.corners[first + swatch];
        const Eigen::Vector2f middle(
            static_cast<float>(corner.x) + 0.5f * static_cast<float>(size.width - 1),
            static_cast<float>(corner.y) + 0.5f * static_cast<float>(size.height - 1));
        const auto number = static_cast<std::uint32_t>(result_.vertices.size());
        for (const std::uint32_t vertex : mesh_.triangles[triangle]) addVertex(vertex, middle);
        result_.triangles.push_back({number, number + 1, number + 2});
    }
}

cv::Mat3f TextureBuilder::correctionOf(const Chart& chart, const cv::Mat3b& color,
                                       const View& view) const {
    constexpr double smoothing_px = 15, most = 80;
    constexpr float prior = 3e-4f;  // keeps single vertices far away from deciding all
    const SE3 T_cam_world = view.T_world_cam.inverse();
    const cv::Size size = chart.in_image.size();
    cv::Mat3f difference = cv::Mat3f::zeros(size);
    cv::Mat1f weight = cv::Mat1f::zeros(size);
    for (std::size_t i = chart.first_vertex; i < chart.last_vertex; ++i) {
        const Eigen::Vector2f pixel = pixelOf(result_.vertices[i], view.camera, T_cam_world);
        const cv::Point at(std::clamp(cvRound(pixel.x()), 0, color.cols - 1),
                           std::clamp(cvRound(pixel.y()), 0, color.rows - 1));
        const auto& rgb = mesh_.colors[source_[i]];
        const cv::Point in_chart = at - chart.in_image.tl();
        difference(in_chart) += cv::Vec3f(rgb[2], rgb[1], rgb[0]) - cv::Vec3f(color(at));
        weight(in_chart) += 1;
    }
    cv::GaussianBlur(difference, difference, {}, smoothing_px, 0, cv::BORDER_CONSTANT);
    cv::GaussianBlur(weight, weight, {}, smoothing_px, 0, cv::BORDER_CONSTANT);
    cv::Mat3f divisor;
    cv::merge(std::vector<cv::Mat>(3, weight + prior), divisor);
    cv::Mat3f correction = difference / divisor;
    cv::min(correction, cv::Scalar::all(most), correction);
    cv::max(correction, cv::Scalar::all(-most), correction);
    return correction;
}

void TextureBuilder::paint(int view, const Camera& camera, const SE3& T_world_cam,
                           const cv::Mat3b& color) {
    const View as_seen{view, camera, T_world_cam};
    cv::Mat3b smooth;  // about as sharp as the mesh's colors
    cv::GaussianBlur(color, smooth, {}, 2);
    for (std::size_t c = 0; c < charts_.size(); ++c) {
        const Chart& chart = charts_[c];
        if (chart.view != view) continue;
        cv::Mat3b patch = cutOut(color, chart.in_image);
        cv::add(patch, correctionOf(chart, smooth, as_seen), patch, {}, CV_8U);
        const cv::Size size = scaled(patch.size(), layout_.scale);
        if (size != patch.size()) cv::resize(patch, patch, size, 0, 0, cv::INTER_AREA);
        patch.copyTo(result_.texture(cv::Rect(layout_.corners[c], size)));
    }
}

}  // namespace rgbd_graphslam
