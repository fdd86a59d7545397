#include "rgbd_graphslam/calibration/board.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr int fewest_corners = 6;
/** Half side of the window in which a corner is refined: at most this, and less than half of the
 *  way to the next corner. */
constexpr int largest_window_px = 8, smallest_window_px = 2;
constexpr double window_share = 0.35;

using Points = std::vector<cv::Point2f>;

cv::Ptr<cv::aruco::Dictionary> dictionaryNamed(const std::string& name) {
    using namespace cv::aruco;
    static const std::map<std::string, PREDEFINED_DICTIONARY_NAME> names{
        {"4X4_50", DICT_4X4_50},
        {"4X4_100", DICT_4X4_100},
        {"4X4_250", DICT_4X4_250},
        {"5X5_50", DICT_5X5_50},
        {"5X5_100", DICT_5X5_100},
        {"5X5_250", DICT_5X5_250},
        {"5X5_1000", DICT_5X5_1000},
        {"6X6_50", DICT_6X6_50},
        {"6X6_250", DICT_6X6_250},
        {"ARUCO_ORIGINAL", DICT_ARUCO_ORIGINAL},
        {"APRILTAG_16h5", DICT_APRILTAG_16h5},
        {"APRILTAG_25h9", DICT_APRILTAG_25h9},
        {"APRILTAG_36h11", DICT_APRILTAG_36h11}};
    const auto found = names.find(name);
    if (found != names.end()) return getPredefinedDictionary(found->second);
    std::string all;
    for (const auto& [known, id] : names) all += (all.empty() ? "" : ", ") + known;
    throw Error("no dictionary of markers '" + name + "'", "choose one of " + all);
}

BoardOptions checked(BoardOptions board) {
    const bool is_chessboard = board.kind == BoardOptions::Kind::Chessboard;
    const bool is_grid = board.kind == BoardOptions::Kind::AprilTags;
    const int fewest = is_grid ? 1 : 3;
    if (board.columns < fewest || board.rows < fewest) {
        throw Error("the board has too few columns or rows", "count the squares, or the tags");
    }
    const bool fits =
        is_chessboard || (board.marker_m > 0 && (is_grid || board.marker_m < board.side_m));
    if (!(board.side_m > 0) || !fits) {
        throw Error("the sizes on the board cannot be right",
                    "give the side of a square (or tag) and of a marker (or gap) in meters");
    }
    if (board.dictionary.empty()) board.dictionary = is_grid ? "APRILTAG_36h11" : "4X4_50";
    return board;
}

/** A window for cornerSubPix() that no other corner gets into. */
cv::Size windowFor(const Points& corners) {
    float nearest = 1e9f;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            nearest = std::min(nearest, static_cast<float>(cv::norm(corners[i] - corners[j])));
        }
    }
    const int half =
        std::clamp(static_cast<int>(window_share * nearest), smallest_window_px, largest_window_px);
    return {half, half};
}

void refine(const cv::Mat& gray, Points& corners) {
    constexpr int most_iterations = 60;
    constexpr double enough_px = 1e-3;
    cv::cornerSubPix(gray, corners, windowFor(corners), {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, most_iterations, enough_px});
}

void add(const cv::Point2f& pixel, double x_m, double y_m, BoardView& view) {
    view.pixel.emplace_back(pixel.x, pixel.y);
    view.board_m.emplace_back(x_m, y_m);
}

/** Whether all points of the board lie in a row. */
bool isLine(const BoardView& view) {
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& p : view.board_m) mean += p / static_cast<double>(view.board_m.size());
    for (const auto& p : view.board_m) spread += (p - mean) * (p - mean).transpose();
    return spread.determinant() < 1e-3 * spread.trace() * spread.trace();
}

}  // namespace

struct BoardDetector::Implementation {
    BoardOptions board;
    cv::Ptr<cv::aruco::Dictionary> dictionary;
    cv::Ptr<cv::aruco::CharucoBoard> charuco;

    BoardView findChessboard(const cv::Mat& gray) const {
        const cv::Size inner(board.columns - 1, board.rows - 1);
        Points corners;
        constexpr int flags =
            cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
        BoardView view;
        if (!cv::findChessboardCorners(gray, inner, corners, flags)) return view;
        refine(gray, corners);
        for (int i = 0; i < inner.area(); ++i) {
            add(corners[i], board.side_m * (i % inner.width), board.side_m * (i / inner.width),
                view);
        }
        return view;
    }

    void findMarkers(const cv::Mat& gray, std::vector<Points>& corners,
                     std::vector<int>& ids) const {
        cv::aruco::detectMarkers(gray, dictionary, corners, ids);
    }

    BoardView findCharuco(const cv::Mat& gray) const {
        std::vector<Points> markers;
        std::vector<int> ids, corner_ids;
        Points corners;
        findMarkers(gray, markers, ids);
        BoardView view;
        if (ids.empty()) return view;
        cv::aruco::interpolateCornersCharuco(markers, ids, gray, charuco, corners, corner_ids);
        if (corners.empty()) return view;
        refine(gray, corners);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const int column = corner_ids[i] % (board.columns - 1);
            const int row = corner_ids[i] / (board.columns - 1);
            add(corners[i], board.side_m * column, board.side_m * row, view);
        }
        return view;
    }

    /** Corners of tags in OpenCV's order: clockwise from the top left. */
    BoardView findTags(const cv::Mat& gray) const {
        std::vector<Points> markers;
        std::vector<int> ids;
        findMarkers(gray, markers, ids);
        BoardView view;
        const double step_m = board.side_m + board.marker_m;
        for (std::size_t i = 0; i < ids.size(); ++i) {
            if (ids[i] >= board.columns * board.rows) continue;
            refine(gray, markers[i]);
            const double x = step_m * (ids[i] % board.columns);
            const double y = step_m * (ids[i] / board.columns);
            add(markers[i][0], x, y, view);
            add(markers[i][1], x + board.side_m, y, view);
            add(markers[i][2], x + board.side_m, y + board.side_m, view);
            add(markers[i][3], x, y + board.side_m, view);
        }
        return view;
    }
};

BoardDetector::BoardDetector(const BoardOptions& options)
    : impl_(std::make_unique<Implementation>()) {
    impl_->board = checked(options);
    const BoardOptions& board = impl_->board;
    if (board.kind == BoardOptions::Kind::Chessboard) return;
    impl_->dictionary = dictionaryNamed(board.dictionary);
    if (board.kind != BoardOptions::Kind::Charuco) return;
    impl_->charuco =
        cv::aruco::CharucoBoard::create(board.columns, board.rows, static_cast<float>(board.side_m),
                                        static_cast<float>(board.marker_m), impl_->dictionary);
}

BoardDetector::~BoardDetector() = default;

BoardView BoardDetector::find(const cv::Mat& gray) const {
    BoardView view;
    switch (impl_->board.kind) {
        case BoardOptions::Kind::Chessboard:
            view = impl_->findChessboard(gray);
            break;
        case BoardOptions::Kind::Charuco:
            view = impl_->findCharuco(gray);
            break;
        case BoardOptions::Kind::AprilTags:
            view = impl_->findTags(gray);
            break;
    }
    const bool enough = view.pixel.size() >= fewest_corners && !isLine(view);
    return enough ? view : BoardView();
}

int BoardDetector::corners() const {
    const BoardOptions& board = impl_->board;
    const bool is_grid = board.kind == BoardOptions::Kind::AprilTags;
    return is_grid ? 4 * board.columns * board.rows : (board.columns - 1) * (board.rows - 1);
}

}  // namespace rgbd_graphslam
