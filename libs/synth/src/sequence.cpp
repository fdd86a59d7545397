#include "rgbd_graphslam/synth/sequence.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "background_jobs.h"
#include "lens_warp.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/synth/renderer.h"
#include "rgbd_graphslam/synth/sensor_model.h"
#include "sequence_files.h"

namespace rgbd_graphslam::synth {

namespace {
enum Purpose : std::uint64_t {
    kColorNoise = 10,
    kDepthNoise = 11,
    kStampJitter = 12,
    kRightNoise = 13
};

double toMicroseconds(double stamp_s) {
    return std::round(stamp_s * 1e6) / 1e6;
}

void writePicture(const std::string& path, const cv::Mat& picture) {
    if (!cv::imwrite(path, picture, {cv::IMWRITE_PNG_COMPRESSION, 1}))
        throw Error("cannot write " + path, "check free space and permissions");
}

bool isCovered(const World& world, double t) {
    const auto within = [t](const auto& span) { return t >= span.first && t < span.second; };
    return std::any_of(world.covered.begin(), world.covered.end(), within) ||
           std::any_of(world.blackouts.begin(), world.blackouts.end(), within);
}

/** Films one session frame by frame: renders here, spoils and writes in the background. */
class Film {
  public:
    Film(const World& world, const Scene& scene, const FilmOptions& options,
         const std::string& folder)
        : world_(world),
          options_(options),
          folder_(folder),
          camera_(synthCamera(options.width, options.height, options.camera)),
          warp_(camera_),
          renderer_(scene, warp_.pinhole()) {}

    void shoot(int frame) {
        const double stamp = colorStamp(options_, frame);
        if (options_.camera == FilmCamera::Stereo) {
            shootColor(frame, stamp, "left", {}, kColorNoise);
            shootColor(frame, stamp, "right",
                       {Eigen::Matrix3d::Identity(), {options_.baseline_m, 0, 0}}, kRightNoise);
        } else {
            shootColor(frame, stamp, "rgb", {}, kColorNoise);
            shootDepth(frame, depthStamp(options_, frame));
        }
        shootLabels(stamp);
    }
    void finish() { jobs_.finish(); }

  private:
    void placeMovers(double t, Mover::SeenBy camera) {
        for (std::size_t i = 0; i < world_.movers.size(); ++i) {
            const Mover& mover = world_.movers[i];
            const bool seen = mover.seen_by == Mover::SeenBy::Both || mover.seen_by == camera;
            renderer_.placeFigure(static_cast<int>(i), seen ? mover.pose(t) : outOfSight());
        }
    }

    /** Pixels that the picture of a point 1.5 m ahead travels between two times. */
    double blur_px(double from, double to) const {
        const SE3 moved = world_.motion.T_world_cam(from).inverse() * world_.motion.T_world_cam(to);
        return camera_.pixelsPerRadian().x() * (moved.angle() + moved.t.norm() / 1.5);
    }

    /** Mean of pictures over the shutter time, each shifted by another part of a pixel: motion
     *  blur and anti-aliasing in one. \return CV_32FC3 */
    cv::Mat exposed(double t, double shutter_s, const SE3& T_first_cam) {
        const double begin = t - shutter_s / 2;
        const int count = std::min(
            16, std::max(4, static_cast<int>(std::ceil(blur_px(begin, begin + shutter_s)))));
        const Camera& pinhole = warp_.pinhole();
        cv::Mat sum = cv::Mat::zeros(pinhole.height, pinhole.width, CV_32FC3);
        for (int i = 0; i < count; ++i) {
            const double at = begin + shutter_s * (i + 0.5) / count;
            placeMovers(at, Mover::SeenBy::Color);
            // A rank-1 lattice spreads the shifts evenly over the pixel.
            const Eigen::Vector2d shift((i + 0.5) / count - 0.5,
                                        std::fmod(0.618034 * (i + 0.5), 1.0) - 0.5);
            cv::accumulate(renderer_.color(world_.motion.T_world_cam(at) * T_first_cam, shift),
                           sum);
        }
        cv::Mat picture = warp_.smooth(sum * (1.0 / count));
        if (world_.lens) {
            world_.lens->spoil(picture, world_.motion.T_world_cam(t) * T_first_cam, camera_);
        }
        return picture;
    }

    /** A picture whose rows are of different moments, if the shutter rolls: put together of bands
     *  over which the picture moves by half a pixel. \param shoot the whole picture at a time */
    template <class Shoot>
    cv::Mat rolled(double t, Shoot shoot) {
        if (options_.readout_s <= 0) return shoot(t);
        const double moved = blur_px(t - options_.readout_s / 2, t + options_.readout_s / 2);
        const int bands = std::clamp(static_cast<int>(std::ceil(2 * moved)), 4, 40);
        cv::Mat picture;
        for (int i = 0; i < bands; ++i) {
            const cv::Mat whole = shoot(t + options_.readout_s * ((i + 0.5) / bands - 0.5));
            if (i == 0) picture = cv::Mat(whole.size(), whole.type());
            const cv::Range rows(i * whole.rows / bands, (i + 1) * whole.rows / bands);
            whole.rowRange(rows).copyTo(picture.rowRange(rows));
        }
        return picture;
    }

    /** \param folder of the picture \param T_first_cam the camera on the first one */
    void shootColor(int frame, double stamp, const char* folder, const SE3& T_first_cam,
                    Purpose purpose) {
        const double t = stamp - kFirstStamp_s;
        const Exposure exposure = world_.exposure(t);
        cv::Mat seen;
        if (isCovered(world_, t))
            seen = cv::Mat(camera_.height, camera_.width, CV_32FC3, cv::Scalar(4, 3, 5));
        else
            seen = rolled(t, [&](double at) {
                return exposed(at, options_.noise ? exposure.shutter_s : 0, T_first_cam);
            });
        jobs_.add([=, options = options_, path = folder_ + "/" + pictureName(folder, stamp)] {
            const ColorSensorModel model =
                options.noise ? ColorSensorModel{} : ColorSensorModel{0, 0};
            writePicture(path, senseColor(seen, exposure.brightness, exposure.gain, model,
                                          Random::of(options.seed, purpose, frame)));
        });
    }

    void shootDepth(int frame, double stamp) {
        const double t = stamp - kFirstStamp_s;
        cv::Mat seen;
        if (isCovered(world_, t))
            seen = cv::Mat::zeros(camera_.height, camera_.width, CV_32FC1);
        else
            seen = rolled(t, [&](double at) {
                placeMovers(at, Mover::SeenBy::Depth);
                return warp_.depth(renderer_.depth(world_.motion.T_world_cam(at),
                                                   {options_.registration_error_px, 0}));
            });
        jobs_.add([=, options = options_, camera = camera_,
                   path = folder_ + "/" + pictureName("depth", stamp)] {
            const Random random = Random::of(options.seed, kDepthNoise, frame);
            const cv::Mat readings =
                options.noise ? senseDepth(seen, camera, DepthSensorModel{}, random) : seen;
            writePicture(path, toDepthUnits(readings));
        });
    }

    /** Label and mask of a time as channels of one picture. */
    cv::Mat labeled(double t) {
        const SE3 T_world_cam = world_.motion.T_world_cam(t);
        placeMovers(t, Mover::SeenBy::Depth);
        LabelPicture picture = renderer_.labels(T_world_cam);
        for (cv::Mat* each : {&picture.label, &picture.mask}) *each = warp_.nearest(*each);
        if (world_.lens) world_.lens->mark(picture.mask, T_world_cam, camera_);
        cv::Mat both;
        cv::merge(std::vector<cv::Mat>{picture.label, picture.mask}, both);
        return both;
    }

    void shootLabels(double stamp) {
        const double t = stamp - kFirstStamp_s;
        const cv::Mat seen = isCovered(world_, t)
                                 ? cv::Mat(camera_.height, camera_.width, CV_8UC2, {0, 255})
                                 : rolled(t, [&](double at) { return labeled(at); });
        jobs_.add([=, folder = folder_, with_labels = options_.labels] {
            std::vector<cv::Mat> channels;
            cv::split(seen, channels);
            if (with_labels) writePicture(folder + "/" + pictureName("label", stamp), channels[0]);
            writePicture(folder + "/" + pictureName("movers", stamp), channels[1]);
        });
    }

    const World& world_;
    const FilmOptions options_;
    const std::string folder_;
    const Camera camera_;
    const LensWarp warp_;
    Renderer renderer_;
    BackgroundJobs jobs_;
};

/** From the optical frame of a mounted camera to that of the scenario's. */
SE3 mountedAt(const std::array<double, 6>& mount) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    const double rad = M_PI / 180;
    const Eigen::Matrix3d R = (AngleAxisd(mount[3] * rad, Vector3d::UnitZ()) *
                               AngleAxisd(mount[4] * rad, Vector3d::UnitY()) *
                               AngleAxisd(mount[5] * rad, Vector3d::UnitX()))
                                  .toRotationMatrix();
    const SE3 T_sensor_mount(R, Vector3d(mount[0], mount[1], mount[2]));
    const SE3 T_sensor_optical(robotCamera().R, Vector3d::Zero());
    return T_sensor_optical.inverse() * T_sensor_mount * T_sensor_optical;
}

/** The same world on the way of another camera of the rig. */
World seenFrom(const std::array<double, 6>& mount, World world) {
    world.motion.T_world_cam = [first = world.motion.T_world_cam, T = mountedAt(mount)](double t) {
        return first(t) * T;
    };
    return world;
}

bool isMounted(const std::array<double, 6>& mount) {
    return mount != std::array<double, 6>{};
}

/** What the options add to the errors of the scenario's sensors. */
void spoil(const FilmOptions& options, World& world) {
    InertialModel& imu = world.inertial;
    const InertialModel& more = options.inertial;
    if (!options.noise) imu.force_bias = imu.force_noise = imu.rate_bias = imu.rate_noise = 0;
    imu.force_walk += more.force_walk;
    imu.rate_walk += more.rate_walk;
    imu.force_warming += more.force_warming;
    imu.rate_warming += more.rate_warming;
    if (more.largest_force > 0) imu.largest_force = more.largest_force;
    if (more.largest_rate > 0) imu.largest_rate = more.largest_rate;
    imu.time_offset_s += more.time_offset_s;
    if (!options.noise) world.wheels = {0, 0, 0, 0, 0};
    world.wheels.radius_error += options.wheel_radius_error;
}

World worldOf(const Scenario& scenario, const FilmOptions& options) {
    World world = scenario.build(options.session, options.seed);
    if (isMounted(options.mount)) world = seenFrom(options.mount, std::move(world));
    world.blackouts.insert(world.blackouts.end(), options.blackouts.begin(),
                           options.blackouts.end());
    spoil(options, world);
    return options.movers ? world : withoutMovers(world);
}

std::vector<const char*> folders(const FilmOptions& options) {
    std::vector<const char*> names = {"rgb", "depth", "movers"};
    if (options.camera == FilmCamera::Stereo) names = {"left", "right", "movers"};
    if (options.labels) names.push_back("label");
    return names;
}

void makeEmptyFolder(const std::string& folder) {
    makeWritableFolder(folder);
    if (!std::filesystem::is_empty(folder))
        throw Error(folder + " is not empty", "remove what is in it or name a new folder");
}
}  // namespace

Camera synthCamera(int width, int height, FilmCamera kind) {
    Intrinsics camera;
    const double scale = width / 640.0;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 525 * scale;
    camera.cx = (width - 1) / 2.0;
    camera.cy = (height - 1) / 2.0;
    if (kind == FilmCamera::Rational) {
        camera.lens = BrownLens{{0.43, -2.6, 0.0006, -0.0002, 1.5, 0.31, -2.4, 1.43}};
    } else if (kind == FilmCamera::Fisheye) {
        camera.fx = camera.fy = 400 * scale;
        camera.lens = KannalaBrandtLens{{-0.012, 0.004, -0.002, 0.0003}};
    }
    return camera;
}

double colorStamp(const FilmOptions& options, int frame) {
    const double jitter =
        options.noise ? Random::of(options.seed, kStampJitter, frame).uniform(0, 2e-3) : 0;
    return toMicroseconds(kFirstStamp_s + frame / 30.0 + jitter);
}

double depthStamp(const FilmOptions& options, int frame) {
    const double lag = options.noise ? 0.0155 * std::sin(2 * std::acos(-1.0) * frame / 170.0) : 0;
    return toMicroseconds(colorStamp(options, frame) + lag);
}

FilmSummary summary(const World& world, int frames) {
    FilmSummary result;
    result.frames = frames;
    result.duration_s = frames / 30.0;
    for (int i = 1; i < frames; ++i) {
        const double before = (i - 1) / 30.0, now = i / 30.0;
        if (isCovered(world, before) || isCovered(world, now)) continue;
        const SE3 moved =
            world.motion.T_world_cam(before).inverse() * world.motion.T_world_cam(now);
        result.path_m += moved.t.norm();
        result.max_speed = std::max(result.max_speed, 30 * moved.t.norm());
        result.max_turn_rate = std::max(result.max_turn_rate, 30 * moved.angle());
    }
    return result;
}

FilmSummary film(const Scenario& scenario, const FilmOptions& options, const std::string& folder) {
    if (options.session < 1 || options.session > scenario.sessions)
        throw Error(
            "scenario '" + scenario.name + "' has no session " + std::to_string(options.session),
            "it has " + std::to_string(scenario.sessions));
    const int frames = options.frames > 0 ? options.frames : scenario.frames;
    makeEmptyFolder(folder);
    for (const char* kind : folders(options)) makeWritableFolder(folder + "/" + kind);
    const World world = worldOf(scenario, options);
    const Scene scene = world.scene();
    writeSurface(folder + "/surface.ply", scene);
    writeCameraIni(folder, options, static_cast<bool>(world.motion.T_world_base));
    writeMotionFiles(folder, options.seed, world, frames);
    writeScans(folder + "/scans.txt", options, world, scene, frames);
    if (options.labels) writeLabelsIni(folder + "/labels.ini");
    writeMovers(folder + "/movers.csv", options, world.movers, scene.figures, frames);

    Film shooting(world, scene, options, folder);
    Progress progress("filming " + scenario.name, frames);
    for (int frame = 0; frame < frames; frame += options.every) {
        shooting.shoot(frame);
        progress.update(std::min(frames, frame + options.every));
    }
    shooting.finish();
    writePictureLists(folder, options, frames);
    return summary(world, frames);
}

}  // namespace rgbd_graphslam::synth
