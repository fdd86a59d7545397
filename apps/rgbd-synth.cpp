/** rgbd-synth: renders synthetic RGB-D sequences with exact ground truth. */
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/synth/contact_sheet.h"
#include "rgbd_graphslam/synth/sequence.h"

using namespace rgbd_graphslam;

namespace {
std::string inFigures(const synth::FilmSummary& film) {
    char text[120];
    std::snprintf(text, sizeof text, "%d frames, %.0f s, %.1f m, at most %.2f m/s and %.0f deg/s",
                  film.frames, film.duration_s, film.path_m, film.max_speed,
                  film.max_turn_rate * 180 / std::acos(-1.0));
    return text;
}

void list() {
    for (const synth::Scenario& scenario : synth::scenarios())
        for (int session = 1; session <= scenario.sessions; ++session) {
            const std::string which =
                scenario.sessions > 1 ? " --session " + std::to_string(session) : "";
            const synth::World world = scenario.build(session, 1);
            std::printf("%s%s\n    %s\n    %s\n", scenario.name.c_str(), which.c_str(),
                        scenario.about.c_str(),
                        inFigures(synth::summary(world, scenario.frames)).c_str());
        }
}

void makeSheet(const std::vector<std::string>& picture_and_folders) {
    if (picture_and_folders.size() < 2)
        throw Error("--contact-sheet names no sequence", "write --contact-sheet PICTURE DIR...");
    synth::writeContactSheet({picture_and_folders.begin() + 1, picture_and_folders.end()},
                             picture_and_folders.front());
}

void setSize(const std::string& text, synth::FilmOptions& options) {
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &rest) != 2 ||
        options.width < 64 || options.height < 48 || options.width > 4096 || options.height > 4096)
        throw Error("--size " + text + " is not a size from 64x48 to 4096x4096",
                    "write e.g. 640x480");
}

void setBlackouts(const std::vector<double>& from_and_length, synth::FilmOptions& options) {
    if (from_and_length.size() % 2 != 0)
        throw Error("--blackout has a start without a length", "write --blackout FROM SECONDS");
    for (std::size_t i = 0; i < from_and_length.size(); i += 2)
        options.blackouts.emplace_back(from_and_length[i],
                                       from_and_length[i] + from_and_length[i + 1]);
}

/** Of inertial sensors and wheels. */
void declareSensorErrors(CLI::App& app, synth::FilmOptions& options) {
    synth::InertialModel& imu = options.inertial;
    const auto pair = [&](const char* name, const char* what, double& force, double& rate) {
        app.add_option_function<std::vector<double>>(
               name, [&force, &rate](const std::vector<double>& v) { force = v[0], rate = v[1]; },
               what)
            ->expected(2)
            ->type_name("FORCE RATE");
    };
    pair("--imu-walk", "Random walk of the IMU biases [m/s^2, rad/s per square root of 1 s]",
         imu.force_walk, imu.rate_walk);
    pair("--imu-warming", "Change of the IMU biases as it warms up from 5 s on [m/s^2, rad/s]",
         imu.force_warming, imu.rate_warming);
    pair("--imu-limit", "Saturation of the IMU [m/s^2, rad/s]", imu.largest_force,
         imu.largest_rate);
    app.add_option_function<double>(
           "--imu-offset", [&imu](double ms) { imu.time_offset_s = 1e-3 * ms; },
           "Delay of the IMU stamps [ms]")
        ->type_name("MS");
    app.add_option("--wheel-radius-error", options.wheel_radius_error,
                   "Relative error of the wheel radius that the odometry assumes");
}

/** What is wrong with the camera, or another place for it. */
void declareCameraErrors(CLI::App& app, synth::FilmOptions& options, double& readout_ms,
                         std::vector<double>& mount) {
    app.add_option("--registration-error", options.registration_error_px,
                   "Shift of depth relative to color [px]")
        ->check(finite());
    app.add_option("--readout", readout_ms,
                   "Rolling shutter: time between reading the first and the last row [ms]")
        ->check(notNegative())
        ->type_name("MS");
    app.add_option(
           "--mount", mount,
           "Render another camera of the same rig, at this pose relative to the first: x y z "
           "[m] yaw pitch roll [deg], x forward")
        ->expected(6)
        ->check(finite())
        ->type_name("X Y Z YAW PITCH ROLL");
}

/** What is filmed besides, and what is left out. */
void declareContents(CLI::App& app, synth::FilmOptions& options, std::vector<double>& blackouts) {
    app.add_flag("--labels", options.labels,
                 "label/ and labels.ini: images of the class that each pixel shows");
    app.add_flag("--scanner", options.scanner,
                 "planar robots: scans.txt of a 2-D laser scanner, 270 degrees, 40 Hz");
    app.add_flag_callback(
        "--without-movers", [&options] { options.movers = false; },
        "Render the same sequence without what deceives the camera: movers, arm, dirt, flare, "
        "blackouts");
    app.add_option("--blackout", blackouts, "Cover the camera for this long [s]; may be repeated")
        ->type_name("FROM SECONDS");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Renders synthetic RGB-D sequences with exact ground truth, in the layout of the TUM RGB-D "
        "benchmark",
        "rgbd-synth");
    synth::FilmOptions options;
    std::string scenario, folder, size = "640x480", noise = "kinect";
    std::vector<std::string> sheet;
    std::vector<double> mount, blackouts;
    double readout_ms = 0;
    bool list_only = false;
    app.add_option("SCENARIO", scenario, "Scenario to render; see --list");
    app.add_option("DIR", folder, "New folder for the sequence");
    app.add_flag("--list", list_only, "Describe the scenarios and exit");
    app.add_option("--frames", options.frames, "Render the first N frames only (default: all)")
        ->check(positive());
    app.add_option("--every", options.every, "Render every Nth frame only: a slower camera")
        ->check(positive());
    app.add_option("--seed", options.seed, "Seed of textures, camera shake and noise")
        ->capture_default_str();
    app.add_option("--noise", noise, "Sensor model")
        ->check(CLI::IsMember({"kinect", "none"}))
        ->capture_default_str();
    app.add_option("--size", size, "Image size; the field of view is the same for all")
        ->capture_default_str();
    declareChoice(app, "--camera", options.camera,
                  {{"rgbd", synth::FilmCamera::Rgbd},
                   {"rational", synth::FilmCamera::Rational},
                   {"fisheye", synth::FilmCamera::Fisheye},
                   {"stereo", synth::FilmCamera::Stereo}},
                  "pinhole with depth, the same with a lens of this model, or two pinholes");
    declareNumber(app, "--baseline", options.baseline_m, "of the stereo camera, m", positive());
    declareCameraErrors(app, options, readout_ms, mount);
    app.add_option("--contact-sheet", sheet,
                   "PICTURE DIR...: show rendered sequences in one picture and exit");
    app.add_option("--session", options.session, "Session, for scenarios with several")
        ->capture_default_str();
    declareContents(app, options, blackouts);
    declareSensorErrors(app, options);
    declareExamples(app,
                    {"rgbd-synth --list", "rgbd-synth office office --frames 100 --size 320x240"});
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] {
        if (list_only) return list(), 0;
        if (!sheet.empty()) return makeSheet(sheet), 0;
        if (scenario.empty() || folder.empty())
            throw Error("missing argument " + std::string(scenario.empty() ? "SCENARIO" : "DIR") +
                        ". Usage: rgbd-synth SCENARIO DIR");
        options.readout_s = 1e-3 * readout_ms;
        options.noise = noise == "kinect";
        std::copy(mount.begin(), mount.end(), options.mount.begin());
        setSize(size, options);
        setBlackouts(blackouts, options);
        const synth::FilmSummary film = synth::film(synth::findScenario(scenario), options, folder);
        std::printf("%s: %s\n", folder.c_str(), inFigures(film).c_str());
        return 0;
    });
}
