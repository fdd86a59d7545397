/** Pictures that are fitted to a face: print, screens, spines, doors, windows. */
#include <opencv2/imgproc.hpp>

#include "texture_tools.h"

namespace rgbd_graphslam::synth {

namespace {
const Bgr kInk(35, 32, 30);

cv::Rect inset(const cv::Mat& picture, int margin) {
    return {margin, margin, picture.cols - 2 * margin, picture.rows - 2 * margin};
}

void drawKeyRow(cv::Mat& picture, int y, int height, Random& random) {
    for (int x = 14; x + 30 < picture.cols - 14;) {
        const int width = random.chance(0.12) ? 78 : 46;
        const cv::Rect key(x, y, std::min(width, picture.cols - 18 - x), height);
        cv::rectangle(picture, key, Bgr(52, 50, 50), cv::FILLED);
        cv::rectangle(picture, key, Bgr(22, 22, 22), 2);
        writeText(picture, cv::Rect(key.x + 8, key.y + 7, 18, 26), 24, Bgr(225, 225, 225), random);
        x += width + 4;
    }
}

void drawDesktopWindow(cv::Mat& picture, const cv::Rect& box, Random& random) {
    const bool dark = random.chance(0.5);
    cv::rectangle(picture, box, dark ? Bgr(45, 38, 34) : Bgr(240, 240, 240), cv::FILLED);
    cv::rectangle(picture, cv::Rect(box.x, box.y, box.width, 26), vividColor(random), cv::FILLED);
    const cv::Rect inside(box.x + 14, box.y + 40, box.width - 28, box.height - 54);
    if (random.chance(0.35))
        drawPicture(picture, inside, random);
    else
        writeText(picture, inside, 20, dark ? Bgr(190, 220, 180) : kInk, random);
}

void drawSpine(cv::Mat& picture, const cv::Rect& box, Random& random) {
    const Bgr color = random.chance(0.6) ? vividColor(random) : quietColor(random);
    cv::rectangle(picture, box, color, cv::FILLED);
    const Bgr ink = cv::norm(color) > 230 ? kInk : Bgr(225, 235, 240);
    int bands = 1 + random.below(3);  // asked anew after each band
    for (int band = 0; band < bands; ++band) {
        const Bgr shade = vividColor(random);
        const int height = 6 + random.below(18), y = box.y + random.below(box.height - 24);
        cv::rectangle(picture, cv::Rect(box.x, y, box.width, height), shade, cv::FILLED);
        bands = 1 + random.below(3);
    }
    cv::Mat title = canvas({box.height * 6 / 10, box.width * 7 / 10}, color);
    writeText(title, inset(title, 3), title.rows - 6, ink, random);
    cv::rotate(title, title, cv::ROTATE_90_CLOCKWISE);
    title.copyTo(picture(cv::Rect(box.x + (box.width - title.cols) / 2, box.y + box.height / 6,
                                  title.cols, title.rows)));
    cv::rectangle(picture, box, scaled(color, 0.4), 2);
}

void drawHouses(cv::Mat& picture, int horizon, Random& random) {
    for (int x = 0; x < picture.cols;) {
        const int width = 60 + random.below(120), top = horizon - 40 - random.below(180);
        const Bgr wall = quietColor(random);
        cv::rectangle(picture, cv::Point(x, top), cv::Point(x + width, picture.rows), wall,
                      cv::FILLED);
        for (int wy = top + 14; wy < picture.rows - 20; wy += 34)
            for (int wx = x + 10; wx < x + width - 14; wx += 28)
                cv::rectangle(picture, cv::Rect(wx, wy, 13, 20),
                              scaled(wall, random.uniform(0.3, 1.4)), cv::FILLED);
        x += width;
    }
}
}  // namespace

cv::Mat paintPoster(Random& random) {
    cv::Mat picture = canvas(
        {640, 900}, random.chance(0.5) ? Bgr(235, 240, 240) : scaled(vividColor(random), 0.8));
    addRelief(picture, fractalNoise(picture.size(), {3, 4}, 3, 0.6, random), 12);
    writeText(picture, {40, 40, 560, 90}, 84, vividColor(random), random);
    const int top = 150 + random.below(60);
    drawPicture(picture, {40, top, 560, 300}, random);
    drawShapes(picture, {40, top, 560, 320}, 6 + random.below(8), random);
    writeText(picture, {40, top + 330, 270, 330}, 22, kInk, random);
    if (random.chance(0.5))
        drawChart(picture, {340, top + 340, 260, 220}, random);
    else
        writeText(picture, {340, top + 330, 260, 330}, 30, kInk, random);
    cv::rectangle(picture, cv::Rect(cv::Point(), picture.size()), Bgr(60, 60, 60), 8);
    return picture;
}

cv::Mat paintArt(Random& random) {
    cv::Mat picture = canvas({800, 600}, quietColor(random));
    if (random.chance(0.5)) drawPicture(picture, inset(picture, 10), random);
    drawShapes(picture, inset(picture, 20), 45, random);
    addRelief(picture, fractalNoise(picture.size(), {30, 30}, 4, 0.8, random), 30);
    cv::rectangle(picture, cv::Rect(cv::Point(), picture.size()), Bgr(30, 45, 70), 40);
    cv::rectangle(picture, inset(picture, 20), Bgr(70, 110, 150), 4);
    return picture;
}

cv::Mat paintPaper(Random& random) {
    cv::Mat picture = canvas({420, 594}, Bgr(238, 240, 240));
    writeText(picture, {40, 40, 340, 40}, 34, kInk, random);
    writeText(picture, {40, 95, 340, 200}, 18, scaled(kInk, 1.6), random);
    if (random.chance(0.5))
        drawChart(picture, {60, 310, 300, 180}, random);
    else
        drawPicture(picture, {60, 310, 300, 180}, random);
    writeText(picture, {40, 505, 340, 70}, 18, scaled(kInk, 1.6), random);
    return picture;
}

cv::Mat paintScreen(Random& random) {
    cv::Mat picture = canvas({1024, 640}, scaled(vividColor(random), 0.45));
    addRelief(picture, fractalNoise(picture.size(), {4, 3}, 4, 0.6, random), 40);
    for (int i = 0; i < 4; ++i)
        drawDesktopWindow(picture,
                          {30 + random.below(480), 30 + random.below(240), 340 + random.below(120),
                           240 + random.below(90)},
                          random);
    cv::rectangle(picture, cv::Rect(0, 606, 1024, 34), Bgr(40, 36, 34), cv::FILLED);
    drawShapes(picture, {10, 608, 500, 28}, 14, random);
    cv::rectangle(picture, cv::Rect(cv::Point(), picture.size()), Bgr(18, 18, 18), 26);
    return picture;
}

cv::Mat paintKeyboard(Random& random) {
    cv::Mat picture = canvas({900, 300}, Bgr(28, 28, 28));
    for (int row = 0; row < 6; ++row) drawKeyRow(picture, 10 + row * 47, 42, random);
    return picture;
}

cv::Mat paintCardboard(Random& random) {
    cv::Mat picture = canvas({640, 480}, Bgr(95, 140, 175));
    addRelief(picture, fractalNoise(picture.size(), {6, 90}, 3, 0.8, random), 22);
    cv::rectangle(picture, cv::Rect(0, 215, 640, 46), Bgr(120, 170, 200), cv::FILLED);
    const cv::Rect label(60 + random.below(220), 60, 240, 130);
    cv::rectangle(picture, label, Bgr(235, 235, 235), cv::FILLED);
    writeText(picture, {label.x + 12, label.y + 12, 210, 60}, 26, kInk, random);
    for (int x = label.x + 12; x < label.x + 220; x += 4 + random.below(7))
        cv::rectangle(picture, cv::Rect(x, label.y + 80, 1 + random.below(4), 40), kInk,
                      cv::FILLED);
    writeText(picture, {330, 300, 260, 120}, 60, Bgr(45, 60, 80), random);
    drawShapes(picture, {40, 290, 200, 150}, 5, random);
    return picture;
}

cv::Mat paintDoor(const Bgr& color, Random& random) {
    cv::Mat picture = canvas({512, 1024}, color);
    addRelief(picture, fractalNoise(picture.size(), {20, 3}, 5, 0.8, random), 26);
    for (const cv::Rect& panel : {cv::Rect(80, 80, 350, 360), cv::Rect(80, 520, 350, 420)}) {
        cv::rectangle(picture, panel, scaled(color, 0.6), 8);
        cv::rectangle(picture, panel - cv::Point(4, 4), scaled(color, 1.25), 3);
    }
    cv::circle(picture, {460, 500}, 20, Bgr(70, 90, 100), cv::FILLED, cv::LINE_AA);
    cv::rectangle(picture, cv::Rect(400, 492, 62, 16), Bgr(160, 175, 180), cv::FILLED);
    cv::rectangle(picture, cv::Rect(170, 150, 170, 50), Bgr(225, 225, 215), cv::FILLED);
    writeText(picture, {182, 160, 150, 34}, 32, kInk, random);
    cv::rectangle(picture, cv::Rect(cv::Point(), picture.size()), scaled(color, 0.5), 24);
    return picture;
}

cv::Mat paintWindow(Random& random) {
    cv::Mat picture(800, 900, CV_8UC3);
    for (int y = 0; y < picture.rows; ++y)
        picture.row(y).setTo(Bgr(250, 215 + y / 25.0, 180 + y / 12.0));
    addRelief(picture, fractalNoise(picture.size(), {4, 3}, 5, 0.6, random), 22);
    drawHouses(picture, 560, random);
    for (int i = 0; i < 260; ++i) {
        const int red = 40 + random.below(40), green = 60 + random.below(90);
        const int reach = 6 + random.below(22);
        const cv::Point at{random.below(900), 690 + random.below(110)};
        cv::circle(picture, at, reach, Bgr(40, green, red), cv::FILLED, cv::LINE_AA);
    }
    for (int x : {0, 438, 876})
        cv::rectangle(picture, cv::Rect(x, 0, 24, 800), Bgr(215, 220, 220), cv::FILLED);
    for (int y : {0, 250, 776})
        cv::rectangle(picture, cv::Rect(0, y, 900, 24), Bgr(205, 212, 212), cv::FILLED);
    return picture;
}

cv::Mat paintRug(Random& random) {
    const Bgr ground = scaled(vividColor(random), 0.7);
    cv::Mat picture = canvas({1024, 720}, ground);
    for (int ring = 0; ring < 6; ++ring) {
        const Bgr color = random.chance(0.5) ? vividColor(random) : quietColor(random);
        cv::rectangle(picture, inset(picture, 18 + ring * 26), color, 6 + random.below(14));
    }
    for (int y = 210; y < 520; y += 52)
        for (int x = 210; x < 820; x += 52) {
            const Bgr color = vividColor(random);
            const int reach = 8 + random.below(16);
            const std::vector<cv::Point> diamond{
                {x - reach, y}, {x, y - reach}, {x + reach, y}, {x, y + reach}};
            cv::fillConvexPoly(picture, diamond, color, cv::LINE_AA);
        }
    addRelief(picture, fractalNoise(picture.size(), {180, 128}, 2, 0.9, random), 36);
    return picture;
}

cv::Mat paintLeaves(Random& random) {
    cv::Mat picture = canvas({512, 512}, Bgr(20, 45, 25));
    for (int i = 0; i < 240; ++i) {
        const int red = 30 + random.below(60), green = 90 + random.below(110);
        const Bgr color(30 + random.below(40), green, red);
        const cv::Point at = anyPixel(picture.size(), random);
        const double angle = 180 * random.uniform();
        const int length = 18 + random.below(30);
        cv::ellipse(picture, at, cv::Size(length, length / 3), angle, 0, 360, color, cv::FILLED,
                    cv::LINE_AA);
        cv::ellipse(picture, at, cv::Size(length, 1), angle, 0, 360, scaled(color, 0.6), 1,
                    cv::LINE_AA);
    }
    return picture;
}

cv::Mat paintPackage(Random& random) {
    const Bgr color = vividColor(random);
    cv::Mat picture = canvas({400, 400}, color);
    addRelief(picture, fractalNoise(picture.size(), {3, 3}, 5, 0.7, random), 25);
    drawShapes(picture, inset(picture, 20), 9, random);
    cv::rectangle(picture, cv::Rect(30, 130, 340, 110), Bgr(240, 240, 235), cv::FILLED);
    writeText(picture, {45, 145, 310, 80}, 78, scaled(color, 0.5), random);
    writeText(picture, {40, 290, 320, 90}, 20, Bgr(240, 240, 240), random);
    return picture;
}

cv::Mat paintWhiteboard(Random& random) {
    cv::Mat picture = canvas({1200, 760}, Bgr(236, 238, 236));
    addRelief(picture, fractalNoise(picture.size(), {5, 4}, 4, 0.6, random), 6);
    for (int i = 0; i < 3; ++i)
        writeText(picture, {70 + i * 370, 70, 320, 200}, 46, scaled(vividColor(random), 0.7),
                  random);
    drawChart(picture, {90, 330, 420, 320}, random);
    writeText(picture, {580, 340, 540, 330}, 36, scaled(vividColor(random), 0.7), random);
    cv::rectangle(picture, cv::Rect(cv::Point(), picture.size()), Bgr(150, 152, 155), 28);
    return picture;
}

cv::Mat paintClock() {
    cv::Mat picture = canvas({256, 256}, Bgr(40, 40, 40));
    const cv::Point center(128, 128);
    cv::circle(picture, center, 118, Bgr(240, 240, 240), cv::FILLED, cv::LINE_AA);
    for (int hour = 0; hour < 12; ++hour)
        cv::ellipse(picture, center, cv::Size(104, 104), 0, hour * 30 - 2, hour * 30 + 2, kInk, 10,
                    cv::LINE_AA);
    cv::line(picture, center, {176, 92}, kInk, 9, cv::LINE_AA);
    cv::line(picture, center, {120, 40}, kInk, 6, cv::LINE_AA);
    return picture;
}

cv::Mat paintBookSpines(int count, Random& random) {
    const int width = 52;
    cv::Mat picture = canvas({width * count, 420}, Bgr(0, 0, 0));
    for (int i = 0; i < count; ++i) drawSpine(picture, {i * width, 0, width, 420}, random);
    addRelief(picture, fractalNoise(picture.size(), {count * 2, 16}, 4, 0.8, random), 16);
    return picture;
}

cv::Mat paintFace(Random& random) {
    const int red = 190 + random.below(40), green = 140 + random.below(50);
    const Bgr skin(110 + random.below(60), green, red);
    cv::Mat picture = canvas({512, 256}, skin);
    addRelief(picture, fractalNoise(picture.size(), {8, 4}, 5, 0.7, random), 12);
    const Bgr hair = scaled(quietColor(random), 0.35);
    cv::rectangle(picture, cv::Rect(0, 0, 512, 70), hair, cv::FILLED);
    cv::rectangle(picture, cv::Rect(190, 60, 322, 130), hair, cv::FILLED);
    for (int x : {60, 130}) cv::circle(picture, {x, 120}, 12, Bgr(30, 30, 30), cv::FILLED);
    cv::line(picture, {95, 125}, {90, 165}, scaled(skin, 0.7), 5, cv::LINE_AA);
    cv::line(picture, {65, 200}, {125, 200}, Bgr(70, 60, 150), 8, cv::LINE_AA);
    addRelief(picture, fractalNoise(picture.size(), {90, 16}, 2, 0.9, random), 14);
    return picture;
}

}  // namespace rgbd_graphslam::synth
