#include "fast_detector.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "vector_clones.h"

namespace rgbd_graphslam {
namespace {

constexpr int lanes = 32;
constexpr int circle_size = 16;
constexpr int arc_length = 9;

/** Compiles to the widest registers that the clone at hand may use. */
typedef std::uint8_t Bytes __attribute__((vector_size(lanes)));
typedef std::uint64_t Words __attribute__((vector_size(lanes)));

#define RGBD_INLINE static inline __attribute__((always_inline))

RGBD_INLINE void load(const std::uint8_t* from, Bytes& to) {
    std::memcpy(&to, from, lanes);
}
RGBD_INLINE void keepLess(Bytes& a, const Bytes& b) {
    a = a < b ? a : b;
}
RGBD_INLINE void keepGreater(Bytes& a, const Bytes& b) {
    a = a > b ? a : b;
}

RGBD_INLINE bool anySet(const Bytes& bytes) {
    const Words words = reinterpret_cast<const Words&>(bytes);
    return (words[0] | words[1] | words[2] | words[3]) != 0;
}

/** Greatest over all arcs of the least difference within the arc. `difference` holds one entry a
 *  pixel of the circle, clamped at 0 from below. Two arcs of nine share eight pixels, and halving
 *  those shares most of their minima. */
RGBD_INLINE void bestArc(const Bytes (&difference)[circle_size], Bytes& best) {
    constexpr int eights = circle_size / 2;
    Bytes two[eights], four[eights];
    for (int i = 0; i < eights; ++i) {
        two[i] = difference[2 * i + 1];
        keepLess(two[i], difference[(2 * i + 2) % circle_size]);
    }
    for (int i = 0; i < eights; ++i) {
        four[i] = two[i];
        keepLess(four[i], two[(i + 1) % eights]);
    }
    for (int i = 0; i < eights; ++i) {
        Bytes nine = difference[2 * i];
        keepGreater(nine, difference[(2 * i + arc_length) % circle_size]);
        keepLess(nine, four[i]);
        keepLess(nine, four[(i + 2) % eights]);
        keepGreater(best, nine);
    }
}

/** Every arc of nine holds two neighboring compass points: a quick test that most pixels fail. */
RGBD_INLINE void compassBound(const Bytes& north, const Bytes& east, const Bytes& south,
                              const Bytes& west, Bytes& bound) {
    Bytes a = north > south ? north : south;
    const Bytes b = east > west ? east : west;
    keepLess(a, b);
    keepGreater(bound, a);
}

/** Pixel offsets of Bresenham's circle of radius 3, clockwise from the top. */
std::array<int, circle_size> circleOffsets(int step) {
    constexpr int x[circle_size] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
    constexpr int y[circle_size] = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
    std::array<int, circle_size> offsets{};
    for (int i = 0; i < circle_size; ++i) offsets[i] = y[i] * step + x[i];
    return offsets;
}

/** Scores of `lanes` pixels from `center` on; 0 where below the threshold. */
RGBD_INLINE void scoreBlock(const std::uint8_t* center, const std::array<int, circle_size>& offsets,
                            const Bytes& below, std::uint8_t* scores) {
    Bytes c, brighter[circle_size], darker[circle_size];
    load(center, c);
    const auto compare = [&](int i) __attribute__((always_inline)) {
        Bytes p;
        load(center + offsets[i], p);
        brighter[i] = (p > c ? p : c) - c;
        darker[i] = c - (p < c ? p : c);
    };
    for (int i = 0; i < circle_size; i += 4) compare(i);
    Bytes score{};
    compassBound(brighter[0], brighter[4], brighter[8], brighter[12], score);
    compassBound(darker[0], darker[4], darker[8], darker[12], score);
    Bytes possible = score > below;
    if (!anySet(possible)) {
        std::memset(scores, 0, lanes);
        return;
    }
    for (int i = 0; i < circle_size; ++i) {
        if (i % 4) compare(i);
    }
    score = Bytes{};
    bestArc(brighter, score);
    bestArc(darker, score);
    score &= score > below;
    std::memcpy(scores, &score, lanes);
}

RGBD_VECTOR_CLONES
void scoreRow(const std::uint8_t* row, const std::array<int, circle_size>& offsets, int x_begin,
              int x_end, int threshold, std::uint8_t* scores) {
    Bytes below{};
    below += static_cast<std::uint8_t>(threshold - 1);
    int x = x_begin;
    for (; x + lanes <= x_end; x += lanes) scoreBlock(row + x, offsets, below, scores + x);
    if (x == x_end) return;
    // The last block overlaps the one before; narrower areas than a block go through a buffer.
    if (x_end - lanes >= x_begin) {
        scoreBlock(row + x_end - lanes, offsets, below, scores + x_end - lanes);
    } else {
        std::uint8_t block[lanes];
        scoreBlock(row + x, offsets, below, block);
        std::memcpy(scores + x, block, x_end - x);
    }
}

/** Sets the lanes whose score `s` beats all eight neighbors; ties go to the first in reading
 *  order. */
RGBD_INLINE void peaksOf(const Bytes& s, const std::uint8_t* above, const std::uint8_t* row,
                         const std::uint8_t* under, Bytes& peaks) {
    Bytes earlier, later, n;
    load(above - 1, earlier);
    load(above, n);
    keepGreater(earlier, n);
    load(above + 1, n);
    keepGreater(earlier, n);
    load(row - 1, n);
    keepGreater(earlier, n);
    load(row + 1, later);
    load(under - 1, n);
    keepGreater(later, n);
    load(under, n);
    keepGreater(later, n);
    load(under + 1, n);
    keepGreater(later, n);
    peaks = (s > earlier) & (s >= later);
}

/** Reads up to `lanes` bytes beyond x_end. */
RGBD_VECTOR_CLONES
void collectPeaks(const std::uint8_t* above, const std::uint8_t* row, const std::uint8_t* under,
                  int x_begin, int x_end, int y, std::vector<FastCorner>& corners) {
    for (int x = x_begin; x < x_end; x += lanes) {
        Bytes scores, peaks;
        load(row + x, scores);
        if (!anySet(scores)) continue;
        peaksOf(scores, above + x, row + x, under + x, peaks);
        for (int word = 0; word < lanes / 8; ++word) {
            std::uint64_t set = reinterpret_cast<const Words&>(peaks)[word];
            while (set) {
                const int byte = __builtin_ctzll(set) / 8;
                const int at = x + 8 * word + byte;
                if (at < x_end) corners.push_back({at, y, row[at]});
                set &= ~(0xffull << (8 * byte));
            }
        }
    }
}

}  // namespace

void detectFast(const cv::Mat& image, const cv::Rect& area, int threshold,
                std::vector<FastCorner>& corners) {
    if (area.width <= 0 || area.height <= 0) return;
    const auto offsets = circleOffsets(static_cast<int>(image.step));
    const int x_begin = area.x, x_end = area.x + area.width;
    // Three rows of scores, with zeros all around the area.
    const int width = image.cols + 2 * lanes;
    static thread_local std::vector<std::uint8_t> buffer;
    buffer.assign(3 * static_cast<std::size_t>(width), 0);
    std::uint8_t* rows[3];
    for (int i = 0; i < 3; ++i) rows[i] = buffer.data() + i * width;
    for (int y = area.y; y <= area.y + area.height; ++y) {
        std::uint8_t* const newest = rows[(y - area.y + 2) % 3];
        if (y < area.y + area.height) {
            scoreRow(image.ptr<std::uint8_t>(y), offsets, x_begin, x_end, threshold, newest);
        } else {
            std::fill(newest, newest + width, std::uint8_t{0});
        }
        if (y == area.y) continue;
        collectPeaks(rows[(y - area.y) % 3], rows[(y - area.y + 1) % 3], newest, x_begin, x_end,
                     y - 1, corners);
    }
}

}  // namespace rgbd_graphslam
