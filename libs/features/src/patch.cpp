#include "rgbd_graphslam/features/patch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "vector_clones.h"

namespace rgbd_graphslam {
namespace {

constexpr int side = 8;           // of the window that is compared, px
constexpr int framed = side + 2;  // with a border for gradients
constexpr int pixels = side * side;
constexpr int iterations = 4;
constexpr float enough_px = 0.05f;
constexpr float farthest_px = 2;
/** Of the squared trace of the structure tensor: below, an edge hides where along it one is. */
constexpr float least_determinant = 1e-3f;
constexpr float least_gradient = 100;
/** Variance of the difference that is bearable, as a share of the patch's own and in gray levels:
 *  sensors are noisy. */
constexpr float most_unexplained = 0.3f, noise_variance = 50;

/** Turns and scales that displace the window's corner by a pixel at most, opposite corners in
 *  opposite directions: on average over the window that is nothing. */
constexpr float negligible_turn = 0.15f;

typedef std::uint8_t Bytes __attribute__((vector_size(side)));
typedef std::int32_t Ints __attribute__((vector_size(side * 4)));
typedef float Row __attribute__((vector_size(side * 4)));

#define RGBD_INLINE static inline __attribute__((always_inline))

/** In pairs, whichever registers there are. */
RGBD_INLINE float sumOf(const Row& row) {
    return ((row[0] + row[4]) + (row[2] + row[6])) + ((row[1] + row[5]) + (row[3] + row[7]));
}

RGBD_INLINE float sumOf(const Row (&rows)[side]) {
    return sumOf(((rows[0] + rows[4]) + (rows[2] + rows[6])) +
                 ((rows[1] + rows[5]) + (rows[3] + rows[7])));
}

RGBD_INLINE float dot(const Row (&a)[side], const Row (&b)[side]) {
    Row sum = a[0] * b[0];
    for (int y = 1; y < side; ++y) sum += a[y] * b[y];
    return sumOf(sum);
}

RGBD_INLINE void removeMean(Row (&rows)[side]) {
    const float mean = sumOf(rows) / pixels;
    for (Row& row : rows) row -= mean;
}

RGBD_INLINE void loadRow(const std::uint8_t* from, Row& row) {
    Bytes bytes;
    std::memcpy(&bytes, from, side);
    row = __builtin_convertvector(__builtin_convertvector(bytes, Ints), Row);
}

/** \param right share of the pixels one further right */
RGBD_INLINE void loadBetween(const std::uint8_t* from, float right, Row& row) {
    Row next;
    loadRow(from, row);
    loadRow(from + 1, next);
    row += right * (next - row);
}

/** Bilinear; (x, y) from the top left pixel of the patch. */
RGBD_INLINE float grayAt(const Patch& patch, float x, float y) {
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
    const std::uint8_t* p = &patch.gray[Patch::side * row + column];
    const float upper = p[0] + right * static_cast<float>(p[1] - p[0]);
    const float lower =
        p[Patch::side] + right * static_cast<float>(p[Patch::side + 1] - p[Patch::side]);
    return upper + down * (lower - upper);
}

/** The reference as the other camera should see it. */
struct Template {
    Row gray[side], gradient_x[side], gradient_y[side];
    float xx, xy, yy, determinant, variance;
};

/** A window of the template with the border that gradients need; rows are as long as two Rows. */
struct FramedWindow {
    float gray[framed][2 * side];
};

/** Any similarity, pixel by pixel. */
RGBD_INLINE void sampleTurned(const Patch& reference, float c, float s, FramedWindow& window) {
    constexpr float half = 0.5f * (framed - 1);
    const float x0 = Patch::center + reference.corner.x - half * (c + s);
    const float y0 = Patch::center + reference.corner.y - half * (c - s);
    for (int y = 0; y < framed; ++y) {
        for (int x = 0; x < framed; ++x) {
            const auto i = static_cast<float>(x), j = static_cast<float>(y);
            window.gray[y][x] = grayAt(reference, x0 + c * i + s * j, y0 - s * i + c * j);
        }
    }
}

/** A shift alone, row by row. */
RGBD_INLINE void sampleUpright(const Patch& reference, FramedWindow& window) {
    const float left = Patch::center + reference.corner.x - 0.5f * (framed - 1);
    const float top = Patch::center + reference.corner.y - 0.5f * (framed - 1);
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const float right = left - static_cast<float>(column), down = top - static_cast<float>(row);
    for (const int x : {0, framed - side}) {
        Row above{};
        for (int y = 0; y <= framed; ++y) {
            Row here;
            loadBetween(&reference.gray[Patch::side * (row + y) + column + x], right, here);
            if (y > 0) {
                const Row between = above + down * (here - above);
                std::memcpy(&window.gray[y - 1][x], &between, sizeof(Row));
            }
            above = here;
        }
    }
}

/** \return whether the template can be made from the patch, and tells a place */
RGBD_INLINE bool makeTemplate(const Patch& reference, const PatchMotion& motion, Template& t) {
    float c = motion.scale * std::cos(motion.roll_rad);
    float s = motion.scale * std::sin(motion.roll_rad);
    const bool upright = std::abs(c - 1) < negligible_turn && std::abs(s) < negligible_turn;
    if (upright) {
        c = 1;
        s = 0;
    }
    const float reach = 0.5f * (framed - 1) * (std::abs(c) + std::abs(s)) +
                        std::max(std::abs(reference.corner.x), std::abs(reference.corner.y));
    if (!(reach < Patch::center - 1)) return false;
    FramedWindow window;
    if (upright) {
        sampleUpright(reference, window);
    } else {
        sampleTurned(reference, c, s, window);
    }
    for (int y = 0; y < side; ++y) {
        Row left, right, above, below;
        std::memcpy(&t.gray[y], &window.gray[y + 1][1], sizeof(Row));
        std::memcpy(&left, &window.gray[y + 1][0], sizeof(Row));
        std::memcpy(&right, &window.gray[y + 1][2], sizeof(Row));
        std::memcpy(&above, &window.gray[y][1], sizeof(Row));
        std::memcpy(&below, &window.gray[y + 2][1], sizeof(Row));
        t.gradient_x[y] = 0.5f * (right - left);
        t.gradient_y[y] = 0.5f * (below - above);
    }
    removeMean(t.gray);
    removeMean(t.gradient_x);
    removeMean(t.gradient_y);
    t.xx = dot(t.gradient_x, t.gradient_x);
    t.xy = dot(t.gradient_x, t.gradient_y);
    t.yy = dot(t.gradient_y, t.gradient_y);
    t.determinant = t.xx * t.yy - t.xy * t.xy;
    t.variance = dot(t.gray, t.gray) / pixels;
    const float trace = t.xx + t.yy;
    return trace > least_gradient && t.determinant > least_determinant * trace * trace;
}

/** What `patch` shows around (x, y) less the template.
 *  \return whether the window lies in the patch */
RGBD_INLINE bool compare(const Template& t, const Patch& patch, float x, float y,
                         Row (&difference)[side]) {
    const float left = x - 0.5f * (side - 1), top = y - 0.5f * (side - 1);
    if (!(left >= 0 && top >= 0 && left < Patch::side - side && top < Patch::side - side)) {
        return false;
    }
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const float right = left - static_cast<float>(column), down = top - static_cast<float>(row);
    Row above{};
    for (int j = 0; j <= side; ++j) {
        Row here;
        loadBetween(&patch.gray[Patch::side * (row + j) + column], right, here);
        if (j > 0) difference[j - 1] = above + down * (here - above) - t.gray[j - 1];
        above = here;
    }
    return true;
}

RGBD_VECTOR_CLONES
bool align(const Patch& reference, const PatchMotion& motion, const Patch& patch,
           cv::Point2f& offset) {
    Template t;
    if (!makeTemplate(reference, motion, t)) return false;
    Row difference[side];
    for (int i = 0; i < iterations; ++i) {
        if (!compare(t, patch, Patch::center + patch.corner.x + offset.x,
                     Patch::center + patch.corner.y + offset.y, difference)) {
            return false;
        }
        const float bx = dot(t.gradient_x, difference), by = dot(t.gradient_y, difference);
        const cv::Point2f step((t.yy * bx - t.xy * by) / t.determinant,
                               (t.xx * by - t.xy * bx) / t.determinant);
        offset -= step;
        if (step.dot(step) < enough_px * enough_px) break;
    }
    removeMean(difference);  // to which the steps, made of gradients without mean, are blind
    const float variance = dot(difference, difference) / pixels;
    return offset.dot(offset) < farthest_px * farthest_px &&
           variance < noise_variance + most_unexplained * t.variance;
}

}  // namespace

std::optional<cv::Point2f> alignPatch(const Patch& reference, const PatchMotion& motion,
                                      const Patch& patch) {
    cv::Point2f offset(0, 0);
    if (!align(reference, motion, patch, offset)) return std::nullopt;
    return offset;
}

}  // namespace rgbd_graphslam
