/** Films a scenario and writes it as a folder in the layout of the TUM RGB-D benchmark. */
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {

/** Cameras of films: a pinhole with depth, the same with a lens of a model, or two pinholes side by
 *  side without depth. */
enum class FilmCamera { Rgbd, Rational, Fisheye, Stereo };

/** What to film, and with which camera. */
struct FilmOptions {
    int frames = 0;  // 0: the scenario's own number
    std::uint64_t seed = 1;
    /** false: exact depth, no color noise, no blur, color and depth at the same instants. */
    bool noise = true;
    int width = 640, height = 480;
    FilmCamera camera = FilmCamera::Rgbd;
    /** Of a stereo camera, m. */
    double baseline_m = 0.12;
    /** Depth pictures are shifted by this along x, as by a wrong calibration. */
    double registration_error_px = 0;
    /** Rolling shutter: from the reading of the first row to that of the last, the middle row at
     * the frame's stamp; 0 = global shutter. */
    double readout_s = 0;
    int session = 1;
    /** Only every so many frames are filmed: a slower camera on the same way. */
    int every = 1;
    /** Another camera of the same rig: where it sits on the scenario's, whose axes are x forward, y
     *  left, z up. [x y z yaw pitch roll] in m and degrees. */
    std::array<double, 6> mount{};
    /** false: the same film without what deceives a camera, see withoutMovers(). */
    bool movers = true;
    /** Times [from, to) at which the camera is covered, besides the scenario's. */
    std::vector<std::pair<double, double>> blackouts;
    /** Added to the scenario's: the biases' random walk and warming up, saturation, time offset. */
    InertialModel inertial{0, 0, 0, 0};
    /** See WheelModel::radius_error. */
    double wheel_radius_error = 0;
    /** Writes scans.txt of a laser scanner on a planar robot, see ScannerModel. */
    bool scanner = false;
    /** Writes label/ and labels.ini: the class of each pixel. */
    bool labels = false;
};

/** The camera of a sequence: 525 pixels of focal length at 640 x 480, scaled to other widths; with
 *  eight coefficients of a color camera on the market (rational), or 400 pixels a radian and 115
 *  degrees across the diagonal (fisheye). */
Camera synthCamera(int width, int height, FilmCamera kind = FilmCamera::Rgbd);

/** Times of frame i in a sequence of 30 Hz, seconds; they begin at 1000 s, to the microsecond.
 *  Depth lags or leads by up to 16 ms when there is noise. */
double colorStamp(const FilmOptions& options, int frame);
double depthStamp(const FilmOptions& options, int frame);

/** How long and how fast a film is, without the times at which the camera is covered. */
struct FilmSummary {
    int frames = 0;
    double duration_s = 0;
    double path_m = 0;
    double max_speed = 0;      // m/s
    double max_turn_rate = 0;  // rad/s
};

/** Known without filming. */
FilmSummary summary(const World& world, int frames);

/** Renders all frames and writes rgb/, depth/, rgb.txt, depth.txt (of a stereo camera left/,
 * right/, left.txt, right.txt), groundtruth.txt, accelerometer.txt, gyroscope.txt, odometry.txt and
 *  scans.txt (planar robots only), slips.csv (where wheels slip for a while), camera.ini,
 * surface.ply, and what is known of each color picture under its name: movers/ (255 where it shows
 * what moves by itself or belongs to lens or carrier) and, if asked for, label/ (classes, named in
 * labels.ini);
 * movers.csv tells where the movers were. The bytes depend on scenario and options alone. Memory
 * does not grow with the frames. \throws Error when the folder holds frames already or cannot be
 * written */
FilmSummary film(const Scenario& scenario, const FilmOptions& options, const std::string& folder);

}  // namespace rgbd_graphslam::synth
