/** import rgbd_graphslam */
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <opencv2/core/utility.hpp>

#include "arrays.h"
#include "mapping_slam.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/options.h"
#include "rgbd_graphslam/geometry/lens.h"
#include "rgbd_graphslam/job/slam_job.h"

namespace rgbd_graphslam {
namespace py = pybind11;
using namespace pybind11::literals;
namespace {

/** Waits for its threads, which may give arrays back to Python, without holding the interpreter. */
struct Deleter {
    void operator()(MappingSlam* slam) const {
        const py::gil_scoped_release released;
        delete slam;
    }
};

struct PythonSlam {
    std::unique_ptr<MappingSlam, Deleter> slam;
    double depth_units;
};

Intrinsics makeCamera(int width, int height, double fx, double fy, double cx, double cy,
                      const std::vector<double>& distortion, const std::string& model) {
    return {width, height, fx, fy, cx, cy, makeLens(model, distortion)};
}

SlamOptions slamOptions(const std::string& config) {
    SlamOptions options;
    if (!config.empty()) IniFile::fromFile(config).loadKnown(options.all());
    return options;
}

PythonSlam makeSlam(const Intrinsics& camera, double depth_units, const std::string& config) {
    if (!(depth_units > 0)) throw py::value_error("depth_units must be positive");
    const SlamOptions options = slamOptions(config);
    return {std::unique_ptr<MappingSlam, Deleter>(new MappingSlam(options, camera)), depth_units};
}

TrackedFrame track(PythonSlam& self, double stamp_s, const py::array& color,
                   const py::array& depth) {
    const RgbdImage image = toImage(stamp_s, color, depth, self.depth_units);
    const py::gil_scoped_release released;
    return self.slam->track(image);
}

py::tuple trajectory(const PythonSlam& self) {
    std::vector<double> stamps;
    std::vector<SE3> poses;
    for (const TrackedFrame& frame : self.slam->slam().frames()) {
        if (frame.origin == FrameOrigin::Lost) continue;
        stamps.push_back(frame.stamp_s);
        poses.push_back(frame.T_world_cam);
    }
    return py::make_tuple(py::array_t<double>(py::cast(stamps)), toMatrices(poses));
}

py::array_t<double> landmarks(const PythonSlam& self) {
    const std::vector<LandmarkView> all = self.slam->slam().landmarks();
    py::array_t<double> xyz({all.size(), std::size_t{3}});
    for (std::size_t i = 0; i < all.size(); ++i) {
        Eigen::Map<Eigen::Vector3d>(xyz.mutable_data() + 3 * i) = all[i].position;
    }
    return xyz;
}

py::tuple points(const PythonSlam& self, double voxel_m) {
    MapOptions options;
    options.point_voxel_m = voxel_m;
    return toArrays([&] {
        const py::gil_scoped_release released;
        return self.slam->points(options);
    }());
}

py::tuple grid(const PythonSlam& self, double resolution_m) {
    MapOptions options;
    options.octree_resolution_m = options.grid_resolution_m = resolution_m;
    return toArrays([&] {
        const py::gil_scoped_release released;
        return self.slam->grid(options);
    }());
}

void runRawlog(const std::string& rawlog, const std::string& out, const std::string& config,
               const std::string& map, bool localize) {
    SlamJob job;
    job.rawlog = rawlog;
    job.out_folder = out;
    job.map_folder = map;
    job.map_use = localize ? MapUse::Localize : MapUse::Extend;
    if (!config.empty()) IniFile::fromFile(config).load(job.options.all());
    const py::gil_scoped_release released;
    runSlamJob(job);
}

void defineTypes(py::module_& m) {
    py::class_<Intrinsics>(m, "Camera",
                           "Calibration of a camera whose depth is registered to color.")
        .def(py::init(&makeCamera), "width"_a, "height"_a, "fx"_a, "fy"_a, "cx"_a, "cy"_a,
             "distortion"_a = std::vector<double>(), "model"_a = "plumb_bob",
             "Sizes and focal lengths in pixels. model: plumb_bob (k1 k2 p1 p2 k3), rational (8 "
             "coefficients) or kannala_brandt (4).")
        .def_readonly("width", &Intrinsics::width)
        .def_readonly("height", &Intrinsics::height);
    py::class_<TrackedFrame>(m, "Frame", "The answer to one frame.")
        .def_readonly("stamp", &TrackedFrame::stamp_s, "s")
        .def_property_readonly(
            "state", [](const TrackedFrame& f) { return toString(f.origin); },
            "tracked, recovered, dead_reckoned, uncertain or lost")
        .def_property_readonly(
            "pose", [](const TrackedFrame& f) { return toMatrix(f.T_world_cam); },
            "(4, 4): the camera's optical frame (x right, y down, z forward) in the world, which "
            "is "
            "that of the first keyframe")
        .def_property_readonly(
            "covariance", [](const TrackedFrame& f) { return f.covariance; },
            "(6, 6) of position (m) and rotation (rad) in the optical frame; None when lost")
        .def_readonly("inliers", &TrackedFrame::inliers)
        .def_readonly("keyframe", &TrackedFrame::keyframe, "its number, None for other frames");
}

void defineSlam(py::module_& m) {
    py::class_<PythonSlam>(m, "Slam",
                           "Tracks a camera and maps what it sees. Use it from one thread.")
        .def(py::init(&makeSlam), "camera"_a, "depth_units"_a = 1000.0, "config"_a = "",
             "depth_units: per meter, of uint16 depth. config: an ini file as rgbd-slam reads it.")
        .def("track", &track, "stamp"_a, "color"_a, "depth"_a,
             "The Frame of the next images. color: uint8 (height, width, 3) BGR, or gray; depth: "
             "uint16, or float32 in m; 0 and nan are no reading. The arrays are not copied: do not "
             "write into them afterwards. Stamps, in s, must rise.")
        .def(
            "finish", [](PythonSlam& self) { self.slam->finish(); },
            py::call_guard<py::gil_scoped_release>(), "Refines the whole map once more.")
        .def("trajectory", &trajectory,
             "Stamps (n) and poses (n, 4, 4) of all frames that have one, as the map knows them "
             "now.")
        .def("landmarks", &landmarks, "(n, 3), m, world")
        .def(
            "T_up_world", [](const PythonSlam& self) { return toMatrix(self.slam->T_up_world()); },
            "(4, 4): from the world to the one of the maps, which has z up and the floor at z = 0.")
        .def("points", &points, "voxel"_a = 0.01,
             "Dense map: xyz float32 (n, 3) in m and rgb uint8 (n, 3), z up.")
        .def("grid", &grid, "resolution"_a = 0.05,
             "Floor plan: probability that a cell is occupied (rows along y, columns along x), its "
             "origin (x, y) and resolution in m.");
}

}  // namespace

PYBIND11_MODULE(rgbd_graphslam, m) {
    m.doc() = "RGB-D SLAM: poses, point clouds and floor plans from color and depth images.";
    m.attr("__version__") = RGBD_VERSION;
    setVerbosity(Verbosity::Quiet);
    cv::setNumThreads(1);
    py::register_exception<Error>(m, "Error", PyExc_RuntimeError);
    defineTypes(m);
    defineSlam(m);
    m.def(
        "run", &runRawlog, "rawlog"_a, "out"_a, "config"_a = "", "map"_a = "", "localize"_a = true,
        "What `rgbd-slam RAWLOG -o OUT` does. map: an earlier output folder, to localize in or to "
        "extend.");
}

}  // namespace rgbd_graphslam
