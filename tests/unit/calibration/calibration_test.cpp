/** Boards, cameras and depth whose truth is known. */
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "../../support/problem_of.h"
#include "rgbd_graphslam/calibration/board.h"
#include "rgbd_graphslam/calibration/camera_calibration.h"
#include "rgbd_graphslam/calibration/depth_calibration.h"

namespace rgbd_graphslam {
namespace {

using ::testing::HasSubstr;

constexpr int width = 640, height = 480;

Intrinsics cameraWith(const Lens& lens) {
    return {width, height, 520, 523, 322.4, 236.1, lens};
}

/** The board 0.2 m about its middle, seen from many sides and filling the picture. */
SE3 pose(int i) {
    const double a = 0.7 * i, b = 1.3 * i;
    const SE3 turned(rotationExp({0.5 * std::sin(a), 0.5 * std::cos(b), 0.4 * std::sin(b)}),
                     {0.12 * std::sin(2.1 * i), 0.09 * std::cos(1.7 * i), 0.4 + 0.02 * (i % 9)});
    return turned * SE3(Eigen::Matrix3d::Identity(), {-0.12, -0.09, 0});
}

/** Corners of a board of 9 x 7, those that are in the picture. */
BoardView viewOf(const Intrinsics& camera, const SE3& T_cam_board, double noise_px,
                 std::mt19937& random) {
    std::normal_distribution<double> noise(0, 1);
    const CameraModel model(camera);
    BoardView view;
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 9; ++x) {
            const Eigen::Vector2d on_board(0.03 * x, 0.03 * y);
            const Eigen::Vector3d p = T_cam_board * Eigen::Vector3d(on_board.x(), on_board.y(), 0);
            const Eigen::Vector2d seen = model.project(p);
            if (!model.isValid(p) || !model.contains(seen)) continue;
            view.board_m.push_back(on_board);
            view.pixel.emplace_back(seen.x() + noise_px * noise(random),
                                    seen.y() + noise_px * noise(random));
        }
    }
    return view;
}

std::vector<BoardView> viewsOf(const Intrinsics& camera, double noise_px, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::vector<BoardView> views;
    for (int i = 0; i < 40; ++i) views.push_back(viewOf(camera, pose(i), noise_px, random));
    return views;
}

std::vector<Lens> lenses() {
    return {BrownLens{}, BrownLens{{0.1, -0.2, 0.001, -0.0015, 0.05}},
            BrownLens{{0.43, -2.6, 0.0006, -0.0002, 1.5, 0.31, -2.4, 1.43}},
            KannalaBrandtLens{{-0.012, 0.004, -0.002, 0.0003}}};
}

TEST(CalibrateCamera, findsEveryLensModel) {
    for (const Lens& lens : lenses()) {
        const Intrinsics truth = cameraWith(lens);
        const auto found = calibrateCamera(viewsOf(truth, 0.05), width, height, lensModel(lens));
        EXPECT_LT(found.rms_px, 0.09) << lensModel(lens);
        EXPECT_NEAR(found.camera.fx, truth.fx, 1e-3 * truth.fx) << lensModel(lens);
        EXPECT_NEAR(found.camera.fy, truth.fy, 1e-3 * truth.fy) << lensModel(lens);
        EXPECT_LT(difference(found.camera, truth).rms_px, 0.1) << lensModel(lens);
    }
}

TEST(CalibrateCamera, tellsHowSureItIs) {
    const Intrinsics truth = cameraWith(BrownLens{});
    std::vector<double> errors;
    Eigen::Vector4d sigma = Eigen::Vector4d::Zero();
    constexpr int runs = 12;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        const auto found = calibrateCamera(viewsOf(truth, 0.3, seed), width, height, "none");
        errors.push_back(found.camera.fx - truth.fx);
        sigma += found.sigma / runs;
    }
    double squares = 0;
    for (const double e : errors) squares += e * e;
    const double spread = std::sqrt(squares / runs);
    EXPECT_LT(spread, 2 * sigma[0]);
    EXPECT_GT(spread, 0.4 * sigma[0]);
}

TEST(CalibrateCamera, asksForMoreViews) {
    auto views = viewsOf(cameraWith(BrownLens{}), 0);
    views.resize(2);
    EXPECT_THAT(problemOf([&] { calibrateCamera(views, width, height, "none"); }),
                HasSubstr("too few"));
}

TEST(CameraDifference, isThatOfRaysNotOfNumbers) {
    const Intrinsics a = cameraWith(BrownLens{});
    Intrinsics b = a;
    EXPECT_LT(difference(a, b).largest_px, 1e-9);
    b.fx *= 1.01;
    // 1 % of 320 px at the left and right border, less what a rotation takes.
    EXPECT_NEAR(difference(a, b).largest_px, 3.2, 0.2);
}

/** A picture of a flat board through a pinhole. \param picture of the board \param px_per_m */
cv::Mat filmed(const cv::Mat& picture, double px_per_m, const SE3& T_cam_board,
               const Intrinsics& camera) {
    Eigen::Matrix3d K;
    K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
    Eigen::Matrix3d plane;
    plane << T_cam_board.R.col(0), T_cam_board.R.col(1), T_cam_board.t;
    Eigen::Matrix3d to_board;  // the middle of the first pixel is half a pixel from the edge
    to_board << 1 / px_per_m, 0, 0.5 / px_per_m, 0, 1 / px_per_m, 0.5 / px_per_m, 0, 0, 1;
    const Eigen::Matrix3d H = K * plane * to_board;
    cv::Mat1d h(3, 3);
    for (int i = 0; i < 9; ++i) h(i / 3, i % 3) = H(i / 3, i % 3);
    cv::Mat seen;
    cv::warpPerspective(picture, seen, h, {width, height}, cv::INTER_AREA, cv::BORDER_CONSTANT,
                        cv::Scalar::all(200));
    cv::GaussianBlur(seen, seen, {3, 3}, 0.7);
    return seen;
}

double worstError(const BoardView& view, const SE3& T_cam_board, const Eigen::Vector2d& offset_m,
                  const Intrinsics& camera) {
    const CameraModel model(camera);
    double worst = 0;
    for (std::size_t i = 0; i < view.pixel.size(); ++i) {
        const Eigen::Vector2d at = view.board_m[i] + offset_m;
        const Eigen::Vector2d expected =
            model.project(T_cam_board * Eigen::Vector3d(at.x(), at.y(), 0));
        worst = std::max(worst, (view.pixel[i] - expected).norm());
    }
    return worst;
}

class Boards : public ::testing::Test {
  protected:
    const Intrinsics camera_ = cameraWith(BrownLens{});
    const SE3 T_cam_board_{rotationExp({0.25, -0.3, 0.1}), {-0.14, -0.12, 0.55}};
};

TEST_F(Boards, cornersOfAChessboard) {
    constexpr int px = 60;
    cv::Mat1b picture(9 * px, 12 * px, std::uint8_t(230));
    for (int row = 0; row < 7; ++row) {
        for (int column = 0; column < 10; ++column) {
            if ((row + column) % 2 == 0)
                picture(cv::Rect((column + 1) * px, (row + 1) * px, px, px)) = std::uint8_t(30);
        }
    }
    BoardOptions board;
    const BoardView view =
        BoardDetector(board).find(filmed(picture, px / board.side_m, T_cam_board_, camera_));
    ASSERT_EQ(view.pixel.size(), 54u);
    // Two squares from the picture's edge; detectors may begin at the other end.
    const double begin = worstError(view, T_cam_board_, {0.06, 0.06}, camera_);
    BoardView turned = view;
    std::reverse(turned.pixel.begin(), turned.pixel.end());
    EXPECT_LT(std::min(begin, worstError(turned, T_cam_board_, {0.06, 0.06}, camera_)), 0.15);
}

TEST_F(Boards, cornersOfACharucoBoardThatIsHalfHidden) {
    BoardOptions board;
    board.kind = BoardOptions::Kind::Charuco;
    const auto printed = cv::aruco::CharucoBoard::create(
        10, 7, 0.03f, 0.022f, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50));
    cv::Mat picture;
    printed->draw({1000, 700}, picture);
    cv::Mat image = filmed(picture, 100 / 0.03, T_cam_board_, camera_);
    const BoardDetector detector(board);
    const BoardView whole = detector.find(image);
    EXPECT_EQ(static_cast<int>(whole.pixel.size()), detector.corners());
    image.colRange(0, 320) = 128;
    const BoardView half = detector.find(image);
    EXPECT_GT(half.pixel.size(), 10u);
    EXPECT_LT(half.pixel.size(), whole.pixel.size());
    EXPECT_LT(worstError(whole, T_cam_board_, {0.03, 0.03}, camera_), 0.2);
}

TEST_F(Boards, cornersOfAGridOfTags) {
    BoardOptions board;
    board.kind = BoardOptions::Kind::AprilTags;
    board.columns = 5;
    board.rows = 4;
    board.side_m = 0.05;
    board.marker_m = 0.015;
    const auto printed = cv::aruco::GridBoard::create(
        5, 4, 0.05f, 0.015f, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11));
    cv::Mat picture;
    constexpr double px_per_m = 4000;
    printed->draw({static_cast<int>(0.31 * px_per_m), static_cast<int>(0.245 * px_per_m)}, picture,
                  0);
    cv::Mat framed;
    cv::copyMakeBorder(picture, framed, 80, 80, 80, 80, cv::BORDER_CONSTANT, cv::Scalar(255));
    const BoardView view =
        BoardDetector(board).find(filmed(framed, px_per_m, T_cam_board_, camera_));
    ASSERT_EQ(view.pixel.size(), 80u);
    EXPECT_LT(worstError(view, T_cam_board_, {0.02, 0.02}, camera_), 0.3);
}

TEST_F(Boards, areNotSeenWhereThereIsNone) {
    const cv::Mat gray(height, width, CV_8UC1, cv::Scalar(90));
    for (const auto kind : {BoardOptions::Kind::Chessboard, BoardOptions::Kind::Charuco,
                            BoardOptions::Kind::AprilTags}) {
        BoardOptions board;
        board.kind = kind;
        EXPECT_TRUE(BoardDetector(board).find(gray).empty());
    }
}

TEST_F(Boards, thatCannotBeAreRefused) {
    BoardOptions board;
    board.rows = 2;
    EXPECT_THAT(problemOf([&] { BoardDetector{board}; }), HasSubstr("too few"));
    board = {};
    board.kind = BoardOptions::Kind::Charuco;
    board.marker_m = 0.05;
    EXPECT_THAT(problemOf([&] { BoardDetector{board}; }), HasSubstr("sizes"));
    board.marker_m = 0.02;
    board.dictionary = "7X7";
    EXPECT_THAT(problemOf([&] { BoardDetector{board}; }), HasSubstr("APRILTAG_36h11"));
}

/** A film of a board by a depth camera with errors. */
struct DepthFilm {
    double scale = 1, delay_s = 0, noise = 0;
    SE3 T_color_depth;
    Intrinsics depth_camera = cameraWith(BrownLens{});

    /** The board swings before the camera. */
    static SE3 poseAt(double t) {
        return {rotationExp({0.4 * std::sin(2 * t), 0.4 * std::cos(1.7 * t), 0.2 * t}),
                {0.1 * std::sin(t), 0.1 * std::cos(1.3 * t), 0.8 + 0.3 * std::sin(1.1 * t)}};
    }

    std::vector<BoardDepth> film(int frames, unsigned seed = 1) const {
        std::mt19937 random(seed);
        std::normal_distribution<double> gaussian(0, 1);
        const CameraModel camera(depth_camera);
        std::vector<BoardDepth> all;
        for (int i = 0; i < frames; ++i) {
            const double t = i / 30.0;
            const SE3 T_depth_board = T_color_depth.inverse() * poseAt(t + delay_s);
            const Eigen::Vector3d n = T_depth_board.R.col(2);
            cv::Mat1w depth(height, width, std::uint16_t(0));
            for (int v = 0; v < height; v += 3) {
                for (int u = 0; u < width; u += 3) {
                    const Eigen::Vector3d ray = camera.unproject(u, v, 1);
                    const double z = n.dot(T_depth_board.t) / n.dot(ray);
                    const Eigen::Vector3d on = T_depth_board.inverse() * (z * ray);
                    if (on.head<2>().cwiseAbs().maxCoeff() > 0.3) continue;
                    const double measured = z / scale + noise * z * z * gaussian(random);
                    depth(v, u) = static_cast<std::uint16_t>(std::lround(5000 * measured));
                }
            }
            all.push_back(
                {t, t, poseAt(t), {{-0.25, -0.2}, {0.25, -0.2}, {0.25, 0.2}, {-0.25, 0.2}}, depth});
        }
        return all;
    }

    DepthCameraOptions options(bool registered) const {
        return {1 / 5000.0, depth_camera, {}, registered};
    }
};

TEST(CalibrateDepth, findsTheScale) {
    for (const double scale : {1.0, 1.035, 0.97}) {
        DepthFilm film;
        film.scale = scale;
        film.noise = 0.003;
        const DepthCalibration found =
            calibrateDepth(film.film(60), film.depth_camera, film.options(true));
        EXPECT_NEAR(found.scale, scale, 5e-4) << scale;
        EXPECT_LT(found.rms_m, 0.004);
        ASSERT_FALSE(found.errors.empty());
        for (const DepthErrorBin& bin : found.errors) {
            EXPECT_NEAR(bin.sigma_m, 0.003 * bin.depth_m * bin.depth_m, 0.001);
            EXPECT_LT(std::abs(bin.bias_m), 0.001);
        }
    }
}

TEST(CalibrateDepth, findsTheDelay) {
    for (const double delay_s : {0.0, 0.012, -0.02}) {
        DepthFilm film;
        film.delay_s = delay_s;
        film.noise = 0.002;
        const DepthCalibration found =
            calibrateDepth(film.film(90), film.depth_camera, film.options(true));
        ASSERT_TRUE(found.delay_s);
        EXPECT_NEAR(*found.delay_s, delay_s, 1e-3);
        EXPECT_NEAR(found.scale, 1, 1e-3);
    }
}

TEST(CalibrateDepth, findsWhereTheDepthCameraIs) {
    DepthFilm film;
    film.scale = 1.01;
    film.noise = 0.002;
    film.T_color_depth = {rotationExp({0.01, -0.006, 0.004}), {0.025, -0.002, 0.004}};
    film.depth_camera.fx = film.depth_camera.fy = 385;
    const DepthCalibration found =
        calibrateDepth(film.film(90), cameraWith(BrownLens{}), film.options(false));
    const SE3 error = found.T_color_depth.inverse() * film.T_color_depth;
    EXPECT_LT(error.t.norm(), 1e-3);
    EXPECT_LT(error.angle() * 180 / M_PI, 0.05);
    EXPECT_NEAR(found.scale, 1.01, 1e-3);
}

TEST(CalibrateDepth, saysWhenNoDepthLiesOnTheBoard) {
    auto views = DepthFilm().film(5);
    for (BoardDepth& view : views) view.depth.setTo(0);
    EXPECT_THAT(problemOf([&] {
                    calibrateDepth(views, cameraWith(BrownLens{}), DepthFilm().options(true));
                }),
                HasSubstr("0 depth readings"));
}

}  // namespace
}  // namespace rgbd_graphslam
