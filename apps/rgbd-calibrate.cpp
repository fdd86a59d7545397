/** rgbd-calibrate: the calibration of a camera from a recording of a board. */
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/calibration/calibration_job.h"

using namespace rgbd_graphslam;

namespace {

constexpr int disagrees = 2;

void declareBoard(CLI::App& app, BoardOptions& board) {
    declareChoice(app, "--board", board.kind,
                  {{"chessboard", BoardOptions::Kind::Chessboard},
                   {"charuco", BoardOptions::Kind::Charuco},
                   {"apriltags", BoardOptions::Kind::AprilTags}},
                  "Kind of board");
    declareNumber(app, "--columns", board.columns, "Squares, or tags, in a row", positive());
    declareNumber(app, "--rows", board.rows, "Squares, or tags, in a column", positive());
    declareNumber(app, "--side", board.side_m, "Side of a square, or of a tag, m", positive());
    declareNumber(app, "--marker", board.marker_m,
                  "Side of a marker of a ChArUco board, or the gap between two tags, m",
                  positive());
    app.add_option("--dictionary", board.dictionary,
                   "Of the markers, by OpenCV's name; default: 4X4_50, or APRILTAG_36h11");
}

}  // namespace

int main(int argc, char** argv) {
    CalibrationJob job;
    CLI::App app(
        "Calibrates an RGB-D camera from a recording of a board: intrinsics, depth scale, pose of "
        "the depth camera, delay of depth.",
        "rgbd-calibrate");
    app.add_option("RAWLOG", job.rawlog,
                   "Recording in which the board is moved about, or the camera")
        ->required();
    app.add_option("-o,--out", job.out_folder,
                   "Folder for camera.ini, report.txt and residuals.png");
    declareBoard(app, job.board);
    app.add_option("--lens", job.lens, "Lens model")
        ->check(CLI::IsMember({"none", "plumb_bob", "rational", "kannala_brandt"}))
        ->capture_default_str();
    app.add_option("--check", job.check,
                   "Compare this camera.ini with the recording; exit code 2 if it does not agree");
    app.add_option("--sensor", job.sensor_label, "Label of the camera; default: the first");
    declareExamples(app,
                    {"rgbd-calibrate board.rawlog -o calibration --columns 10 --rows 7 --side 0.03",
                     "rgbd-calibrate board.rawlog --check camera.ini --board charuco"});
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] {
        const CalibrationReport report = runCalibration(job);
        std::fputs(toText(report).c_str(), stdout);
        return report.check && !report.check->agrees ? disagrees : 0;
    });
}
