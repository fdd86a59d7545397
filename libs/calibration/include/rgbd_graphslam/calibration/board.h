/** Calibration boards and their corners in images. */
#pragma once
#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A flat board as it was printed. */
struct BoardOptions {
    enum class Kind { Chessboard, Charuco, AprilTags };
    Kind kind = Kind::Chessboard;
    /** Squares of a chessboard or ChArUco board, tags of a grid of tags. */
    int columns = 10, rows = 7;
    /** Side of a square, or of a tag's black border, m. */
    double side_m = 0.03;
    /** Side of the markers in the squares of a ChArUco board, or the gap between tags, m. */
    double marker_m = 0.022;
    /** Of markers: one of OpenCV's, e.g. "4X4_50" or "APRILTAG_36h11"; empty: these two. */
    std::string dictionary;
};

/** Corners of the board that an image shows; position i of both lists is one corner. */
struct BoardView {
    /** On the board: x to the right, y down, m. */
    std::vector<Eigen::Vector2d> board_m;
    /** In the image as the sensor gave it. */
    std::vector<Eigen::Vector2d> pixel;

    bool empty() const { return pixel.empty(); }
};

/** Finds the corners of one board. */
class BoardDetector {
  public:
    /** \throws Error for a board of fewer than 3 x 3 squares, sizes that are not positive, or an
     *          unknown dictionary */
    explicit BoardDetector(const BoardOptions& board);
    ~BoardDetector();

    /** \param gray CV_8UC1 \return empty where the board is not seen, or too little of it: a
     *          chessboard must be seen whole, of others six corners not in a row */
    BoardView find(const cv::Mat& gray) const;

    /** Corners of the whole board, m. */
    int corners() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> impl_;
};

}  // namespace rgbd_graphslam
