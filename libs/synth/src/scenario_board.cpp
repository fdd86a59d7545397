#include "calibration_board.h"
#include "filming.h"
#include "places.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;

constexpr int columns = 10, rows = 7;
constexpr double square_m = 0.06;
/** White all around, which detectors want. */
constexpr double margin_m = square_m;
constexpr int pixels_a_square = 40;
/** Middle of the board, in the free middle of the office; it looks along +x. */
const Vector3d middle{2.4, 2.6, 1.3};

cv::Mat chessboard() {
    cv::Mat picture((rows + 2) * pixels_a_square, (columns + 2) * pixels_a_square, CV_8UC3,
                    cv::Scalar::all(235));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if ((row + column) % 2 == 1) continue;
            picture(cv::Rect((column + 1) * pixels_a_square, (row + 1) * pixels_a_square,
                             pixels_a_square, pixels_a_square)) = cv::Scalar::all(25);
        }
    }
    return picture;
}

Scene boardInOffice(std::uint64_t seed) {
    constexpr double even_light = 0.9;
    Scene scene = officeRoom(Office::Furnished, seed);
    const double width = columns * square_m + 2 * margin_m, height = rows * square_m + 2 * margin_m;
    const int material = scene.addMaterial(chessboard(), 0, even_light);
    const SE3 corner(Eigen::Matrix3d::Identity(), middle - Vector3d(0, width / 2, height / 2));
    addRectangle(scene, scene.quads, corner, width, height, {material});
    return scene;
}

/** Near and far, from all sides, with the board in every part of the picture. */
Motion aroundTheBoard(std::uint64_t seed) {
    constexpr double step_s = 1.2;
    std::vector<Vector3d> positions, targets;
    const auto add = [&](double away, double aside, double up, double look_aside, double look_up) {
        positions.push_back(middle + Vector3d(away, aside, up));
        targets.push_back(middle + Vector3d(0, look_aside, look_up));
    };
    add(0.75, 0, 0, 0, 0);
    for (const double away : {0.65, 0.8, 1.05, 1.35}) {
        const double reach = 0.5 * away, look = 0.26 * away;
        add(away, reach, 0.3 * away, -look, 0.6 * look);
        add(away, 0.8 * reach, -0.35 * away, -look, -0.6 * look);
        add(away, 0.1, 0.05, -1.2 * look, 0);
        add(away, 0.2 * away, 0.1, look, -0.7 * look);
        add(away, -0.8 * reach, -0.3 * away, look, -0.6 * look);
        add(away, -reach, 0.35 * away, look, 0.6 * look);
        add(away, 0, 0.4 * away, 0, 0.7 * look);
    }
    return handHeld(Spline(positions, step_s, true), Spline(targets, step_s, true),
                    Tremble{0.003, 0.004, 0}, seed);
}

World build(int, std::uint64_t seed) {
    World world;
    world.scene = [=] { return boardInOffice(seed); };
    world.exposure = [](double) { return Exposure{}; };
    world.motion = aroundTheBoard(seed);
    return world;
}
}  // namespace

Scenario board() {
    return {"board", "a chessboard (10 x 7 squares of 60 mm) to calibrate with", 1, 1044, build};
}

}  // namespace rgbd_graphslam::synth
