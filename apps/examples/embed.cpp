/** Tracks images of your own and prints the camera's poses. The camera here is simulated: it slides
 *  along a painted wall, 15 mm per frame to its right. */
#include <rgbd_graphslam/core/error.h>
#include <rgbd_graphslam/dataset/rgbd_observation.h>
#include <rgbd_graphslam/graphslam/graph_slam_session.h>

#include <cstdio>
#include <opencv2/imgproc.hpp>

using namespace rgbd_graphslam;

struct Images {
    cv::Mat color;  // CV_8UC3, BGR
    cv::Mat depth;  // CV_16UC1, registered to color; 0 = no reading
};

/** Put your camera's driver here. */
Images grab(int frame) {
    static cv::Mat wall;
    if (wall.empty()) {
        cv::Mat tiles(40, 80, CV_8UC3);
        cv::randu(tiles, 0, 256);
        cv::resize(tiles, wall, {1280, 640}, 0, 0, cv::INTER_NEAREST);
    }
    const int shift_px = 4 * frame, distance_mm = 1968;
    return {wall(cv::Rect(shift_px, 0, 640, 480)).clone(),
            cv::Mat(480, 640, CV_16UC1, distance_mm)};
}

int main() {
    CameraSetup setup;
    setup.camera = {640, 480, 525, 525, 319.5, 239.5, {}};  // size, fx, fy, cx, cy, lens
    setup.depth_units = 1000;                               // per meter

    try {
        GraphSlamSession session(SlamOptions(), *makeRgbdObservation(setup, 0));
        for (int i = 0; i < 60; ++i) {
            const Images images = grab(i);
            const double stamp_s = i / 30.0;
            const TrackedFrame frame =
                session.step(makeRgbdObservation(setup, stamp_s, images.color, images.depth));
            const Eigen::Vector3d& p = frame.T_world_cam.t;  // x right, y down, z forward
            std::printf("%.3f s %-9s x %.3f y %.3f z %.3f m\n", frame.stamp_s,
                        toString(frame.origin), p.x(), p.y(), p.z());
        }
        session.finish();
        std::printf("%zu keyframes\n", session.slam().keyframes().size());
    } catch (const Error& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}
