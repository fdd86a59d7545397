#include "rgbd_graphslam/features/orb_extractor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "fast_detector.h"
#include "orb_pattern.h"
#include "patch_orientation.h"

namespace rgbd_graphslam {
namespace {

constexpr int border_px = orb_patch_radius + 2;
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

void buildPyramid(const cv::Mat& grey, const std::vector<float>& scale, Scratch& scratch) {
    const int needed = 2 * border_px + 8;
    scratch.levels.resize(scale.size());
    const int rows = static_cast<int>(scale.size()) * grey.rows;
    scratch.sharp_buffer.create(rows, grey.cols, CV_8UC1);
    scratch.smooth_buffer.create(rows, grey.cols, CV_8UC1);
    for (std::size_t l = 0; l < scale.size(); ++l) {
        const cv::Size size(static_cast<int>(std::lround(grey.cols / scale[l])),
                            static_cast<int>(std::lround(grey.rows / scale[l])));
        if (size.width < needed || size.height < needed) {
            scratch.levels.resize(l);
            return;
        }
        const cv::Rect place(0, static_cast<int>(l) * grey.rows, size.width, size.height);
        Level& level = scratch.levels[l];
        level.sharp = scratch.sharp_buffer(place);
        level.smooth = scratch.smooth_buffer(place);
        if (l == 0) {
            grey.copyTo(level.sharp);
        } else {
            cv::resize(scratch.levels[l - 1].sharp, level.sharp, size, 0, 0, cv::INTER_LINEAR);
        }
        // reads 3 px beyond the level, where old frames are; no descriptor reaches what comes of it
        cv::GaussianBlur(level.sharp, level.smooth, cv::Size(7, 7), 2, 2, cv::BORDER_REFLECT_101);
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
bool stronger(const FastCorner& a, const FastCorner& b) {
    if (a.score != b.score) return a.score > b.score;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

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
        std::sort(cell.begin(), cell.end(), stronger);
    }
    return used;
}

/** Takes the best corner of every cell, then the second best, and so on: even spread first,
 * strength within what is left over. */
std::vector<FastCorner> selectEvenly(const std::vector<std::vector<FastCorner>>& cells,
                                     std::size_t used, std::size_t quota) {
    std::vector<FastCorner> selected;
    std::vector<FastCorner> round;
    for (std::size_t rank = 0; selected.size() < quota; ++rank) {
        round.clear();
        for (std::size_t c = 0; c < used; ++c) {
            if (rank < cells[c].size()) round.push_back(cells[c][rank]);
        }
        if (round.empty()) break;
        if (selected.size() + round.size() > quota) {
            std::sort(round.begin(), round.end(), stronger);
            round.resize(quota - selected.size());
        }
        selected.insert(selected.end(), round.begin(), round.end());
    }
    return selected;
}

/** Where the structure tensor of the 5x5 neighbourhood places the corner (Foerstner and Guelch,
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

Descriptor describeCorner(const std::uint8_t* centre, const int* offsets) {
    Descriptor descriptor{};
    for (int word = 0; word < 4; ++word) {
        std::uint64_t bits = 0;
        for (int i = 0; i < 64; ++i, offsets += 2) {
            bits |= static_cast<std::uint64_t>(centre[offsets[0]] < centre[offsets[1]]) << i;
        }
        descriptor[word] = bits;
    }
    return descriptor;
}

Patch patchAround(const cv::Mat& image, int x, int y, const cv::Point2f& corner) {
    Patch patch;
    patch.corner = corner;
    for (int j = 0; j < Patch::side; ++j) {
        std::memcpy(&patch.grey[Patch::side * j],
                    image.ptr<std::uint8_t>(y - Patch::centre + j) + x - Patch::centre,
                    Patch::side);
    }
    return patch;
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

OrbFeatures OrbExtractor::extract(const cv::Mat& grey) const {
    static thread_local Scratch scratch;
    buildPyramid(grey, scale_, scratch);
    updateOffsets(scratch);
    OrbFeatures features;
    for (std::size_t l = 0; l < scratch.levels.size(); ++l) {
        const Level& level = scratch.levels[l];
        const std::size_t used = detectInCells(level.sharp, options_, scratch);
        // The true ratio: sizes are whole pixels, so it differs from the nominal one.
        const float scale_x = static_cast<float>(grey.cols) / level.sharp.cols;
        const float scale_y = static_cast<float>(grey.rows) / level.sharp.rows;
        for (const FastCorner& corner : selectEvenly(scratch.cells, used, quota_[l])) {
            const float angle = patchOrientation(level.sharp, corner.x, corner.y);
            const cv::Point2f offset = subPixelOffset(level.sharp, corner.x, corner.y);
            // Pixel centres are whole numbers on every level, so scaling is about the image corner.
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
