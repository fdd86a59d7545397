#include "rgbd_graphslam/features/orb_extractor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "fast_detector.h"
#include "orb_pattern.h"
#include "patch_orientation.h"
#include "smoothing.h"

namespace rgbd_graphslam {
namespace {

constexpr int border_px = orb_patch_radius + smoothing_radius;
constexpr float pi = 3.14159265f;

/** A pyramid level and its smoothed copy. All levels have the row step of the first, so that one
 *  table of pixel offsets serves every level. */
struct Level {
    cv::Mat sharp, smooth;
};

/** Buffers that a thread keeps from image to image. */
struct Scratch {
    cv::Mat sharp_buffer, smooth_buffer;
    std::vector<Level> levels;
    std::size_t offsets_step = 0;
    std::vector<int> offsets;
    std::vector<FastCorner> corners;
    std::vector<std::vector<FastCorner>> cells;
};

void buildPyramid(const cv::Mat& gray, const std::vector<float>& scale, Scratch& scratch) {
    const int needed = 2 * border_px + 8;
    scratch.levels.resize(scale.size());
    const int rows = static_cast<int>(scale.size()) * gray.rows;
    scratch.sharp_buffer.create(rows, gray.cols, CV_8UC1);
    scratch.smooth_buffer.create(rows, gray.cols, CV_8UC1);
    for (std::size_t l = 0; l < scale.size(); ++l) {
        const cv::Size size(static_cast<int>(std::lround(gray.cols / scale[l])),
                            static_cast<int>(std::lround(gray.rows / scale[l])));
        if (size.width < needed || size.height < needed) {
            scratch.levels.resize(l);
            return;
        }
        const cv::Rect place(0, static_cast<int>(l) * gray.rows, size.width, size.height);
        Level& level = scratch.levels[l];
        level.sharp = scratch.sharp_buffer(place);
        level.smooth = scratch.smooth_buffer(place);
        if (l == 0) {
            gray.copyTo(level.sharp);
        } else {
            cv::resize(scratch.levels[l - 1].sharp, level.sharp, size, 0, 0, cv::INTER_LINEAR);
        }
        smooth(level.sharp, level.smooth);
    }
}

void updateOffsets(Scratch& scratch) {
    const std::size_t step = scratch.smooth_buffer.step;
    if (scratch.offsets_step == step) return;
    scratch.offsets_step = step;
    scratch.offsets.clear();
    for (const auto& orientation : orbPattern()) {
        for (const OrbPoint p : orientation) {
            scratch.offsets.push_back(p.y * static_cast<int>(step) + p.x);
        }
    }
}

/** Strongest first; the place decides between equals. */
constexpr auto stronger = [](const FastCorner& a, const FastCorner& b) {
    if (a.score != b.score) return a.score > b.score;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
};

/** The cells that corners of a level are spread over. */
struct CellGrid {
    cv::Rect inner;
    int columns, rows;

    CellGrid(const cv::Mat& image, int cell_px)
        : inner(border_px, border_px, image.cols - 2 * border_px, image.rows - 2 * border_px),
          columns(std::max(1, inner.width / cell_px)),
          rows(std::max(1, inner.height / cell_px)) {}

    int size() const { return columns * rows; }
    int cellOf(const FastCorner& c) const {
        const int column = (c.x - inner.x) * columns / inner.width;
        const int row = (c.y - inner.y) * rows / inner.height;
        return row * columns + column;
    }
    /** The pixels that cellOf() counts to a cell. */
    cv::Rect areaOf(int cell) const {
        const int column = cell % columns, row = cell / columns;
        const auto edge = [](int i, int length, int n) { return (i * length + n - 1) / n; };
        const int x0 = edge(column, inner.width, columns), y0 = edge(row, inner.height, rows);
        return {inner.x + x0, inner.y + y0, edge(column + 1, inner.width, columns) - x0,
                edge(row + 1, inner.height, rows) - y0};
    }
};

/** Corners of a level sorted into cells; faint ones are looked for only in cells without any other.
 *  \return number of cells in use */
std::size_t detectInCells(const cv::Mat& image, const FeatureOptions& options, Scratch& scratch) {
    const CellGrid grid(image, options.cell_px);
    const auto used = static_cast<std::size_t>(grid.size());
    if (scratch.cells.size() < used) scratch.cells.resize(used);
    for (std::size_t c = 0; c < used; ++c) scratch.cells[c].clear();
    scratch.corners.clear();
    detectFast(image, grid.inner, options.fast_threshold, scratch.corners);
    for (const FastCorner& corner : scratch.corners) {
        scratch.cells[grid.cellOf(corner)].push_back(corner);
    }
    const int least = std::min(options.fast_threshold_min, options.fast_threshold);
    for (std::size_t c = 0; c < used; ++c) {
        auto& cell = scratch.cells[c];
        if (cell.empty()) detectFast(image, grid.areaOf(static_cast<int>(c)), least, cell);
    }
    return used;
}

/** \return how many corners every cell may give, as far as it has them, for `quota` to suffice */
std::size_t fairShare(const std::vector<std::vector<FastCorner>>& cells, std::size_t used,
                      std::size_t quota) {
    for (std::size_t share = 0, given = 0;; ++share) {
        const auto more = std::count_if(cells.begin(), cells.begin() + used,
                                        [&](const auto& cell) { return cell.size() > share; });
        given += more;
        if (more == 0 || given > quota) return share;
    }
}

/** The `count` strongest of `corners` come first, the next of them after these. */
void bringForward(std::vector<FastCorner>& corners, std::size_t count) {
    if (count < corners.size()) {
        std::nth_element(corners.begin(), corners.begin() + count, corners.end(), stronger);
    }
}

/** Takes the best corners of every cell, as many of each: even spread first, strength within a cell
 *  and for what is left over of the quota. Reorders the cells. */
std::vector<FastCorner> selectEvenly(std::vector<std::vector<FastCorner>>& cells, std::size_t used,
                                     std::size_t quota) {
    const std::size_t share = fairShare(cells, used, quota);
    std::vector<FastCorner> selected, next_best;
    for (std::size_t c = 0; c < used; ++c) {
        bringForward(cells[c], share);
        const std::size_t taken = std::min(share, cells[c].size());
        selected.insert(selected.end(), cells[c].begin(), cells[c].begin() + taken);
        if (taken < cells[c].size()) next_best.push_back(cells[c][taken]);
    }
    const std::size_t left_over = std::min(quota - selected.size(), next_best.size());
    bringForward(next_best, left_over);
    selected.insert(selected.end(), next_best.begin(), next_best.begin() + left_over);
    return selected;
}

/** Where the structure tensor of the 5x5 neighborhood places the corner (Foerstner and Guelch,
 *  1987), as an offset from its pixel; none when that leaves the pixel. */
cv::Point2f subPixelOffset(const cv::Mat& image, int x, int y) {
    constexpr int radius = 2;
    const int step = static_cast<int>(image.step);
    float xx = 0, xy = 0, yy = 0, bx = 0, by = 0;
    for (int j = -radius; j <= radius; ++j) {
        const std::uint8_t* row = image.ptr<std::uint8_t>(y + j) + x;
        for (int i = -radius; i <= radius; ++i) {
            const float gx = static_cast<float>(row[i + 1] - row[i - 1]);
            const float gy = static_cast<float>(row[i + step] - row[i - step]);
            xx += gx * gx;
            xy += gx * gy;
            yy += gy * gy;
            bx += gx * gx * i + gx * gy * j;
            by += gx * gy * i + gy * gy * j;
        }
    }
    const float determinant = xx * yy - xy * xy;
    const float trace = xx + yy;
    if (determinant < 0.02f * trace * trace) return {0, 0};
    const cv::Point2f offset((yy * bx - xy * by) / determinant, (xx * by - xy * bx) / determinant);
    return std::abs(offset.x) <= 1.5f && std::abs(offset.y) <= 1.5f ? offset : cv::Point2f(0, 0);
}

Descriptor describeCorner(const std::uint8_t* center, const int* offsets) {
    Descriptor descriptor{};
    for (std::uint64_t& word : descriptor) {
        for (int i = 63; i >= 0; --i) {  // the sum is one add with carry; a shift by i takes longer
            word += word + (center[offsets[2 * i]] < center[offsets[2 * i + 1]]);
        }
        offsets += 2 * 64;
    }
    return descriptor;
}

Patch patchAround(const cv::Mat& image, int x, int y, const cv::Point2f& corner) {
    Patch patch;
    patch.corner = corner;
    for (int j = 0; j < Patch::side; ++j) {
        std::memcpy(&patch.gray[Patch::side * j],
                    image.ptr<std::uint8_t>(y - Patch::center + j) + x - Patch::center,
                    Patch::side);
    }
    return patch;
}

void reserve(OrbFeatures& features, std::size_t count) {
    features.corners.reserve(count);
    features.descriptors.reserve(count);
    features.patches.reserve(count);
}

int discreteOrientation(float angle) {
    const int index = static_cast<int>(std::lround(angle * orb_orientations / (2 * pi)));
    return (index + orb_orientations) % orb_orientations;
}

}  // namespace

OrbExtractor::OrbExtractor(const FeatureOptions& options) : options_(options) {
    double total = 0;
    for (int l = 0; l < options.levels; ++l) {
        scale_.push_back(static_cast<float>(std::pow(options.scale_factor, l)));
        total += 1 / scale_.back();
    }
    for (const float scale : scale_) {
        quota_.push_back(static_cast<int>(std::lround(options.count / (scale * total))));
    }
}

OrbExtractor::~OrbExtractor() = default;

OrbFeatures OrbExtractor::extract(const cv::Mat& gray) const {
    static thread_local Scratch scratch;
    buildPyramid(gray, scale_, scratch);
    updateOffsets(scratch);
    OrbFeatures features;
    reserve(features, options_.count);
    for (std::size_t l = 0; l < scratch.levels.size(); ++l) {
        const Level& level = scratch.levels[l];
        const std::size_t used = detectInCells(level.sharp, options_, scratch);
        // The true ratio: sizes are whole pixels, so it differs from the nominal one.
        const float scale_x = static_cast<float>(gray.cols) / level.sharp.cols;
        const float scale_y = static_cast<float>(gray.rows) / level.sharp.rows;
        for (const FastCorner& corner : selectEvenly(scratch.cells, used, quota_[l])) {
            const float angle = patchOrientation(level.sharp, corner.x, corner.y);
            const cv::Point2f offset = subPixelOffset(level.sharp, corner.x, corner.y);
            // Pixel centers are whole numbers on every level, so scaling is about the image corner.
            features.corners.push_back({(corner.x + offset.x + 0.5f) * scale_x - 0.5f,
                                        (corner.y + offset.y + 0.5f) * scale_y - 0.5f, angle,
                                        static_cast<int>(l)});
            features.patches.push_back(patchAround(level.sharp, corner.x, corner.y, offset));
            const int* offsets = &scratch.offsets[discreteOrientation(angle) * 2 * orb_bits];
            features.descriptors.push_back(
                describeCorner(level.smooth.ptr<std::uint8_t>(corner.y) + corner.x, offsets));
        }
    }
    return features;
}

}  // namespace rgbd_graphslam
