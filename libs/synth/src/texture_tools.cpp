#include "texture_tools.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam::synth {

namespace {
/** Smooth noise that continues over the borders. */
cv::Mat valueNoise(cv::Size size, cv::Size cells, Random& random) {
    const int margin = 2;
    cv::Mat grid(cells, CV_32FC1);
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x)
            grid.at<float>(y, x) = static_cast<float>(random.uniform(-1, 1));
    cv::copyMakeBorder(grid, grid, margin, margin, margin, margin, cv::BORDER_WRAP);
    const double scale_x = static_cast<double>(size.width) / cells.width;
    const double scale_y = static_cast<double>(size.height) / cells.height;
    const cv::Mat affine =
        (cv::Mat_<double>(2, 3) << 1 / scale_x, 0, margin, 0, 1 / scale_y, margin);
    // Smooth interpolation shows where cells are large only.
    const int how = scale_x > 12 ? cv::INTER_CUBIC : cv::INTER_LINEAR;
    cv::Mat noise;
    cv::warpAffine(grid, noise, affine, size, how | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    return noise;
}

void drawGlyph(cv::Mat& picture, const cv::Rect& box, const Bgr& ink, int thickness,
               Random& random) {
    const auto corner = [&] {
        const cv::Point at = anyPixel({3, 3}, random);
        return cv::Point(box.x + at.x * box.width / 2, box.y + at.y * box.height / 2);
    };
    const int strokes = 2 + random.below(2);
    for (int i = 0; i < strokes; ++i) {
        const cv::Point begin = corner(), end = corner();
        cv::line(picture, end, begin, ink, thickness, cv::LINE_AA);
    }
    if (random.chance(0.4))
        cv::ellipse(picture, cv::Point(box.x + box.width / 2, box.y + box.height / 2),
                    cv::Size(box.width / 2, box.height / 2), 0, 360 * random.uniform(), 360, ink,
                    thickness, cv::LINE_AA);
}

void drawShape(cv::Mat& picture, const cv::Rect& box, Random& random) {
    const Bgr color = vividColor(random);
    const int reach =
        std::max(3, static_cast<int>(std::min(box.width, box.height) * random.uniform(0.04, 0.22)));
    const cv::Point at = box.tl() + anyPixel(box.size(), random);
    switch (random.below(4)) {
        case 0:
            cv::circle(picture, at, reach, color, cv::FILLED, cv::LINE_AA);
            break;
        case 1:
            cv::circle(picture, at, reach, color, std::max(1, reach / 4), cv::LINE_AA);
            break;
        case 2:
            cv::rectangle(picture, cv::Rect(at.x, at.y, 2 * reach, reach), color, cv::FILLED);
            break;
        default: {
            std::vector<cv::Point> corners;
            corners.reserve(5);
            const cv::Point first = at - cv::Point(reach, reach);
            int wanted = 3 + random.below(3);  // asked anew after each corner
            while (static_cast<int>(corners.size()) < wanted) {
                corners.push_back(first + anyPixel({2 * reach, 2 * reach}, random));
                wanted = 3 + random.below(3);
            }
            cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{corners}, color, cv::LINE_AA);
        }
    }
}
}  // namespace

cv::Point anyPixel(cv::Size size, Random& random) {
    const int y = random.below(size.height), x = random.below(size.width);
    return {x, y};
}

cv::Mat canvas(cv::Size size, const Bgr& color) {
    return cv::Mat(size, CV_8UC3, color);
}

Bgr scaled(const Bgr& color, double factor) {
    return {color[0] * factor, color[1] * factor, color[2] * factor};
}

Bgr vividColor(Random& random) {
    const double red = random.uniform(150, 240), green = random.uniform(40, 160);
    Bgr color{random.uniform(10, 90), green, red};
    for (int i = 2; i > 0; --i) std::swap(color[i], color[random.below(i + 1)]);
    const double gray = (color[0] + color[1] + color[2]) / 3, fading = random.uniform(0.15, 0.6);
    for (int i = 0; i < 3; ++i) color[i] += fading * (gray - color[i]);
    return random.chance(0.2) ? scaled(color, 0.35) : color;
}

Bgr quietColor(Random& random) {
    const double gray = random.uniform(60, 190);
    return {gray + random.uniform(-25, 25), gray + random.uniform(-15, 15),
            gray + random.uniform(-25, 25)};
}

cv::Mat fractalNoise(cv::Size size, cv::Size cells, int octaves, double persistence,
                     Random& random) {
    cv::Mat sum = cv::Mat::zeros(size, CV_32FC1);
    double strength = 1, total = 0;
    for (int i = 0; i < octaves; ++i, strength *= persistence) {
        cv::scaleAdd(valueNoise(size, cells, random), strength, sum, sum);
        total += strength;
        cells = cv::Size(std::min(size.width, cells.width * 2),
                         std::min(size.height, cells.height * 2));
    }
    sum.convertTo(sum, -1, 1 / total);
    return sum;
}

void addRelief(cv::Mat& picture, const cv::Mat& field, double strength) {
    for (int y = 0; y < picture.rows; ++y) {
        const float* relief = field.ptr<float>(y);
        auto* row = picture.ptr<cv::Vec3b>(y);
        for (int x = 0; x < picture.cols; ++x)
            for (int c = 0; c < 3; ++c)
                row[x][c] =
                    cv::saturate_cast<uchar>(row[x][c] + static_cast<float>(strength) * relief[x]);
    }
}

void writeText(cv::Mat& picture, const cv::Rect& box, int line_px, const Bgr& ink, Random& random) {
    const int height = std::max(4, line_px * 6 / 10), width = std::max(3, height * 6 / 10);
    const int thickness = std::max(1, height / 8);
    for (int y = box.y; y + line_px <= box.y + box.height; y += line_px) {
        const double filled = random.chance(0.2) ? random.uniform(0.3, 0.8) : 1;
        const int end = box.x + static_cast<int>(box.width * filled);
        for (int x = box.x; x + width <= end; x += width * 4 / 3)
            if (!random.chance(0.16))
                drawGlyph(picture, cv::Rect(x, y, width, height), ink, thickness, random);
    }
}

void drawShapes(cv::Mat& picture, const cv::Rect& box, int count, Random& random) {
    cv::Mat part = picture(box);
    for (int i = 0; i < count; ++i) drawShape(part, cv::Rect(cv::Point(), box.size()), random);
}

void drawPicture(cv::Mat& picture, const cv::Rect& box, Random& random) {
    cv::Mat part = picture(box);
    const cv::Mat height = fractalNoise(box.size(), {3, 3}, 7, 0.62, random);
    const cv::Mat ridge = fractalNoise(box.size(), {9, 9}, 5, 0.7, random);
    const Bgr low = vividColor(random), middle = quietColor(random), high(235, 225, 215);
    for (int y = 0; y < part.rows; ++y)
        for (int x = 0; x < part.cols; ++x) {
            const double level = height.at<float>(y, x) * 2.2 - 0.6 * y / part.rows + 0.3;
            const Bgr& color = level < -0.12 ? low : level < 0.3 ? middle : high;
            const double shade = 1 + 0.9 * ridge.at<float>(y, x);
            for (int c = 0; c < 3; ++c)
                part.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(color[c] * shade);
        }
}

void drawChart(cv::Mat& picture, const cv::Rect& box, Random& random) {
    const Bgr ink(40, 40, 40);
    cv::rectangle(picture, box, ink, 2);
    for (int curve = 0; curve < 3; ++curve) {
        const Bgr color = vividColor(random);
        cv::Point last;
        for (int i = 0; i <= 12; ++i) {
            const cv::Point at(box.x + box.width * i / 12,
                               box.y + 4 + random.below(std::max(1, box.height - 8)));
            if (i > 0) cv::line(picture, last, at, color, 2, cv::LINE_AA);
            cv::circle(picture, at, 4, color, cv::FILLED, cv::LINE_AA);
            last = at;
        }
    }
}

}  // namespace rgbd_graphslam::synth
