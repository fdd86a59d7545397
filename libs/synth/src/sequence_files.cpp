#include "sequence_files.h"

#include <cmath>
#include <cstdio>
#include <fstream>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/synth/laser_scanner.h"
#include "rgbd_graphslam/synth/robot_sensors.h"

namespace rgbd_graphslam::synth {

namespace {
template <class... Values>
std::string formatted(const char* format, Values... values) {
    char line[400];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

/** Streams a text file, so that a long one needs no memory. */
void writeStream(const std::string& path, const std::function<void(std::ostream&)>& write) {
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        write(out);
        return static_cast<bool>(out.flush());
    });
}

/** Times of a sensor of the given rate that cover all frames with a margin. */
void forEachReading(double hertz, int frames, const std::function<void(double t, long i)>& read) {
    const long count = std::lround((frames / 30.0 + 0.2) * hertz);
    for (long i = 0; i <= count; ++i) read(i / hertz - 0.1, i);
}

void writeList(const std::string& path, const char* title, const char* kind, int frames, int every,
               const std::function<double(int)>& stamp) {
    writeStream(path, [&](std::ostream& out) {
        out << "# " << title << "\n# timestamp filename\n";
        for (int i = 0; i < frames; i += every)
            out << formatted("%.6f ", stamp(i)) << pictureName(kind, stamp(i)) << '\n';
    });
}

void writeTruth(const std::string& path, const Motion& motion, int frames) {
    writeStream(path, [&](std::ostream& out) {
        out << "# true poses of the color camera's optical frame, world z up, floor at z = 0\n"
               "# timestamp tx ty tz qx qy qz qw\n";
        forEachReading(100, frames, [&](double t, long) {
            const SE3 pose = motion.T_world_cam(t);
            const Eigen::Quaterniond q = pose.quaternion();
            out << formatted("%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", kFirstStamp_s + t,
                             pose.t.x(), pose.t.y(), pose.t.z(), q.x(), q.y(), q.z(), q.w());
        });
    });
}

void writeVectors(const std::string& path, const char* header, int frames,
                  const std::function<Eigen::Vector3d(double t, long i)>& read) {
    writeStream(path, [&](std::ostream& out) {
        out << header;
        forEachReading(200, frames, [&](double t, long i) {
            const Eigen::Vector3d value = read(t, i);
            out << formatted("%.6f %.6f %.6f %.6f\n", kFirstStamp_s + t, value.x(), value.y(),
                             value.z());
        });
    });
}

void writeOdometry(const std::string& path, std::uint64_t seed, const World& world, int frames) {
    Odometer odometer(world.motion, world.wheels, seed, world.slips);
    writeStream(path, [&](std::ostream& out) {
        out << "# wheel odometry of the planar robot's base\n# timestamp x y theta\n";
        forEachReading(20, frames, [&](double t, long) {
            const Eigen::Vector3d pose = odometer.advance(t);
            out << formatted("%.6f %.6f %.6f %.6f\n", kFirstStamp_s + t, pose.x(), pose.y(),
                             pose.z());
        });
    });
}

void writeSlips(const std::string& path, const std::vector<SlipEpisode>& slips) {
    writeStream(path, [&](std::ostream& out) {
        out << "from_s,to_s,way_factor,turn_rad_s\n";
        for (const SlipEpisode& slip : slips)
            out << formatted("%.6f,%.6f,%.3f,%.3f\n", kFirstStamp_s + slip.from_s,
                             kFirstStamp_s + slip.to_s, slip.way_factor, slip.turn_rad_s);
    });
}

std::string scanHeader(const ScannerModel& model) {
    const Eigen::Vector3d at = robotScanner().t;
    return formatted(
        "# laser scans: ranges in m from right to left, 0 = none\n"
        "# aperture_deg = %g\n# max_range_m = %g\n"
        "# sensor_pose = [%g %g %g 0 0 0]\n# timestamp ranges...\n",
        model.field_deg, model.max_range_m, at.x(), at.y(), at.z());
}

/** A body's extent in its own axes. */
Eigen::AlignedBox3d extentOf(const MovingBody& body) {
    Eigen::AlignedBox3d box;
    for (const Quad& quad : body.quads)
        for (const Eigen::Vector3d& corner : quad.corners) box.extend(corner);
    return box;
}

std::string moverLine(double stamp_s, const Mover& mover, const Eigen::AlignedBox3d& box) {
    const double t = stamp_s - kFirstStamp_s, step = 0.01;
    const SE3 pose = mover.pose(t);
    const Eigen::Vector3d center = pose * box.center(), size = box.sizes();
    const Eigen::Vector3d moved =
        mover.pose(t + step) * box.center() - mover.pose(t - step) * box.center();
    const Eigen::Quaterniond q = pose.quaternion();
    return formatted("%.6f,%s,%d,%.4f,%.4f,%.4f,%.4f,%.6f,%.6f,%.6f,%.6f,%.4f,%.4f,%.4f\n", stamp_s,
                     mover.name.c_str(), mover.carried ? 1 : 0, moved.norm() / (2 * step),
                     center.x(), center.y(), center.z(), q.x(), q.y(), q.z(), q.w(), size.x(),
                     size.y(), size.z());
}

std::string cameraText(const char* section, const Intrinsics& camera) {
    std::string text = formatted(
        "[%s]\n"
        "resolution = [%d %d]\n"
        "cx = %.6f\ncy = %.6f\nfx = %.6f\nfy = %.6f\n",
        section, camera.width, camera.height, camera.cx, camera.cy, camera.fx, camera.fy);
    if (lensModel(camera.lens) == "kannala_brandt") text += "distortion_model = kannala_brandt\n";
    text += "dist = [";
    for (const double k : lensCoefficients(camera.lens)) text += formatted("%g ", k);
    text.back() = ']';
    return text + "\n";
}

template <class Value>
void put(std::ostream& out, Value value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
}
}  // namespace

std::string pictureName(const char* kind, double stamp_s) {
    return formatted("%s/%.6f.png", kind, stamp_s);
}

void writePictureLists(const std::string& folder, const FilmOptions& options, int frames) {
    const auto color = [&](int i) { return colorStamp(options, i); };
    if (options.camera == FilmCamera::Stereo) {
        for (const char* side : {"left", "right"}) {
            writeList(folder + "/" + side + ".txt", "images", side, frames, options.every, color);
        }
        return;
    }
    writeList(folder + "/rgb.txt", "color images", "rgb", frames, options.every, color);
    writeList(folder + "/depth.txt", "depth maps", "depth", frames, options.every,
              [&](int i) { return depthStamp(options, i); });
}

void writeMotionFiles(const std::string& folder, std::uint64_t seed, const World& world,
                      int frames) {
    writeTruth(folder + "/groundtruth.txt", world.motion, frames);
    InertialUnit unit(world.motion, world.inertial, seed);
    writeVectors(folder + "/accelerometer.txt",
                 "# specific force in the color camera's optical frame, m/s^2\n"
                 "# timestamp ax ay az\n",
                 frames, [&](double t, long i) { return unit.read(t, i).specific_force; });
    writeVectors(folder + "/gyroscope.txt",
                 "# angular rate in the color camera's optical frame, rad/s\n"
                 "# timestamp wx wy wz\n",
                 frames, [&](double t, long i) { return unit.read(t, i).angular_rate; });
    if (!world.motion.T_world_base) return;
    writeOdometry(folder + "/odometry.txt", seed, world, frames);
    if (!world.slips.empty()) writeSlips(folder + "/slips.csv", world.slips);
}

void writeScans(const std::string& path, const FilmOptions& options, const World& world,
                const Scene& scene, int frames) {
    if (!options.scanner) return;
    if (!world.motion.T_world_base) {
        throw Error("the scanner is mounted on planar robots only", "leave --scanner out");
    }
    ScannerModel model;
    if (!options.noise) model.noise_m = 0;
    const LaserScanner scanner(world, scene, model, options.seed);
    writeStream(path, [&](std::ostream& out) {
        out << scanHeader(model);
        forEachReading(model.hertz, frames, [&](double t, long i) {
            out << formatted("%.6f", kFirstStamp_s + t);
            for (const double range : scanner.scan(t, static_cast<std::uint64_t>(i))) {
                out << (range > 0 ? formatted(" %.3f", range) : " 0");
            }
            out << '\n';
        });
    });
}

void writeCameraIni(const std::string& folder, const FilmOptions& options, bool on_robot) {
    const bool stereo = options.camera == FilmCamera::Stereo;
    const Intrinsics camera =
        synthCamera(options.width, options.height, options.camera).intrinsics();
    const auto& mount = options.mount;
    std::string text = cameraText("CAMERA_PARAMS", camera);
    if (!stereo) text += "depth_units = 5000\n";
    const Eigen::Vector3d at = on_robot ? robotCamera().t : Eigen::Vector3d::Zero();
    text += formatted("sensor_pose = [%.3f %.3f %.3f %g %g %g]\n", at.x() + mount[0],
                      at.y() + mount[1], at.z() + mount[2], mount[3], mount[4], mount[5]);
    text += "imu_pose = [0 0 0 -90 0 -90]\n";  // the optical frame
    if (stereo) {
        text += cameraText("CAMERA_PARAMS_RIGHT", camera) +
                formatted("[STEREO]\nbaseline = %.6f\n", options.baseline_m);
    }
    writeTextAtomically(folder + "/camera.ini", text);
}

void writeLabelsIni(const std::string& path) {
    std::string text = "; values of label/*.png; 0: no class\n";
    for (const LabelClass& each : labelClasses())
        text += formatted("\n[%d]\nname = %s\ncolor = [%d %d %d]\n", static_cast<int>(each.label),
                          each.name.c_str(), each.color[0], each.color[1], each.color[2]);
    writeTextAtomically(path, text);
}

void writeMovers(const std::string& path, const FilmOptions& options,
                 const std::vector<Mover>& movers, const std::vector<MovingBody>& bodies,
                 int frames) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const MovingBody& body : bodies) boxes.push_back(extentOf(body));
    writeStream(path, [&](std::ostream& out) {
        out << "stamp_s,name,carried,speed_m_s,x_m,y_m,z_m,qx,qy,qz,qw,size_x_m,size_y_m,size_z_"
               "m\n";
        for (int frame = 0; frame < frames; frame += options.every)
            for (std::size_t i = 0; i < movers.size(); ++i)
                if (!movers[i].name.empty())
                    out << moverLine(colorStamp(options, frame), movers[i], boxes[i]);
    });
}

void writeSurface(const std::string& path, const Scene& scene) {
    writeStream(path, [&](std::ostream& out) {
        out << "ply\nformat binary_little_endian 1.0\ncomment true surface, meters, z up\n"
            << "element vertex " << 4 * scene.quads.size()
            << "\nproperty float x\nproperty float y\nproperty float z\n"
            << "element face " << 2 * scene.quads.size()
            << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (const Quad& quad : scene.quads)
            for (const Eigen::Vector3d& corner : quad.corners)
                for (int axis = 0; axis < 3; ++axis) put(out, static_cast<float>(corner[axis]));
        for (std::size_t i = 0; i < scene.quads.size(); ++i)
            for (const auto& triangle :
                 {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
                put(out, std::uint8_t{3});
                for (int corner : triangle) put(out, static_cast<std::int32_t>(4 * i) + corner);
            }
    });
}

}  // namespace rgbd_graphslam::synth
