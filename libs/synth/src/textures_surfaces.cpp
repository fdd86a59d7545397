/** Surfaces that repeat: walls, floors, wood, cloth. */
#include <opencv2/imgproc.hpp>

#include "texture_tools.h"

namespace rgbd_graphslam::synth {

namespace {
const cv::Size kTile(1024, 1024);
const cv::Size kSmallTile(512, 512);

/** One plank, tile or brick with a tone, a grain and a blemish of its own. */
void drawPiece(cv::Mat& picture, const cv::Rect& box, const Bgr& color, double grain,
               cv::Size cells, Random& random) {
    cv::Mat part = picture(box & cv::Rect(cv::Point(), picture.size()));
    part.setTo(color);
    addRelief(part, fractalNoise(part.size(), cells, 4, 0.8, random), grain);
}
}  // namespace

cv::Mat paintPlaster(const Bgr& color, double contrast, Random& random) {
    cv::Mat picture = canvas(kTile, color);
    addRelief(picture, fractalNoise(kTile, {4, 4}, 4, 0.6, random), contrast);
    addRelief(picture, fractalNoise(kTile, {128, 128}, 3, 0.8, random), contrast * 0.7);
    for (int i = 0; i < 14; ++i) {
        const cv::Point at = anyPixel(kTile, random);
        const double angle = 180 * random.uniform();
        const int height = 1 + random.below(3), width = 2 + random.below(9);
        cv::ellipse(picture, at, cv::Size(width, height), angle, 0, 360,
                    scaled(color, 1 - contrast * 0.012), cv::FILLED, cv::LINE_AA);
    }
    return picture;
}

cv::Mat paintCarpet(const Bgr& color, Random& random) {
    cv::Mat picture = canvas(kTile, color);
    addRelief(picture, fractalNoise(kTile, {6, 6}, 4, 0.7, random), 14);
    addRelief(picture, fractalNoise(kTile, {256, 256}, 2, 0.9, random), 42);
    for (int i = 0; i < 1600; ++i) {
        const cv::Point at = anyPixel(kTile, random);
        const Bgr tuft = scaled(color, random.chance(0.5) ? 0.5 : 1.6);
        cv::circle(picture, at, 1 + random.below(3), tuft, cv::FILLED, cv::LINE_AA);
    }
    return picture;
}

cv::Mat paintParquet(Random& random) {
    cv::Mat picture = canvas(kTile * 2, Bgr(30, 45, 60));
    const int rows = 16, plank_h = picture.rows / rows;
    for (int row = 0; row < rows; ++row) {
        for (int x = -random.below(400); x < picture.cols;) {
            const int length = 380 + random.below(420);
            const double tone = random.uniform(0.75, 1.15);
            const cv::Rect plank(x + 2, row * plank_h + 2, length - 4, plank_h - 4);
            if ((plank & cv::Rect(cv::Point(), picture.size())).area() > 0)
                drawPiece(picture, plank, Bgr(78 * tone, 122 * tone, 168 * tone), 48, {3, 20},
                          random);
            x += length;
        }
    }
    return picture;
}

cv::Mat paintTiles(const Bgr& color, Random& random) {
    cv::Mat picture = canvas(kTile, Bgr(95, 95, 92));
    const int count = 4, side = kTile.width / count;
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
            drawPiece(picture, cv::Rect(x * side + 4, y * side + 4, side - 8, side - 8),
                      scaled(color, random.uniform(0.86, 1.1)), 34, {5, 5}, random);
    return picture;
}

cv::Mat paintBricks(Random& random) {
    cv::Mat picture = canvas(kTile, Bgr(150, 160, 165));
    const int rows = 14, height = kTile.height / rows, width = kTile.width / 4;
    for (int row = 0; row < rows; ++row)
        for (int column = -1; column < 4; ++column) {
            const int x = column * width + (row % 2) * width / 2;
            const cv::Rect brick(x + 5, row * height + 5, width - 10, height - 10);
            if ((brick & cv::Rect(cv::Point(), kTile)).area() == 0) continue;
            const double tone = random.uniform(0.7, 1.2);
            drawPiece(picture, brick, Bgr(60 * tone, 78 * tone, 150 * tone), 45, {8, 4}, random);
        }
    return picture;
}

cv::Mat paintWood(const Bgr& color, Random& random) {
    cv::Mat picture = canvas(kTile, color);
    addRelief(picture, fractalNoise(kTile, {2, 14}, 5, 0.8, random), 55);
    addRelief(picture, fractalNoise(kTile, {24, 256}, 2, 0.8, random), 22);
    for (int i = 0; i < 5; ++i) {
        const cv::Point at = anyPixel(kTile, random);
        for (int ring = 3; ring > 0; --ring)
            cv::ellipse(picture, at, cv::Size(9 * ring, 4 * ring), 0, 0, 360,
                        scaled(color, ring % 2 ? 0.55 : 0.8), 2, cv::LINE_AA);
    }
    return picture;
}

cv::Mat paintCeiling(Random& random) {
    cv::Mat picture = canvas(kTile, Bgr(225, 228, 228));
    addRelief(picture, fractalNoise(kTile, {64, 64}, 3, 0.8, random), 5);
    for (int i = 0; i < 900; ++i) {
        const int reach = 1 + random.below(3);
        cv::circle(picture, anyPixel(kTile, random), reach, Bgr(180, 184, 184), cv::FILLED,
                   cv::LINE_AA);
    }
    cv::rectangle(picture, cv::Rect(cv::Point(), kTile), Bgr(150, 152, 152), 14);
    cv::rectangle(picture, cv::Rect(14, 14, kTile.width - 28, kTile.height - 28),
                  Bgr(245, 246, 246), 3);
    return picture;
}

cv::Mat paintFabric(const Bgr& color, Random& random) {
    cv::Mat picture = canvas(kSmallTile, color);
    const Bgr stripe = random.chance(0.5) ? vividColor(random) : scaled(color, 0.6);
    const int period = 32 << random.below(3);
    for (int at = 0; at < kSmallTile.width; at += period) {
        cv::line(picture, {at, 0}, {at, kSmallTile.height}, stripe, 2 + random.below(period / 5));
        cv::line(picture, {0, at}, {kSmallTile.width, at}, scaled(stripe, 0.7),
                 1 + random.below(period / 6));
    }
    addRelief(picture, fractalNoise(kSmallTile, {8, 8}, 6, 0.85, random), 50);
    return picture;
}

cv::Mat paintMetal(const Bgr& color, Random& random) {
    cv::Mat picture = canvas(kSmallTile, color);
    addRelief(picture, fractalNoise(kSmallTile, {3, 3}, 4, 0.6, random), 12);
    addRelief(picture, fractalNoise(kSmallTile, {4, 256}, 1, 1, random), 7);
    return picture;
}

}  // namespace rgbd_graphslam::synth
