/** Localizes a recording in the map of an earlier run and prints where the robot is in its grid.
 *  Usage: example_localize MAP_FOLDER RAWLOG */
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <rgbd_graphslam/core/error.h>
#include <rgbd_graphslam/dataset/rawlog_reader.h>
#include <rgbd_graphslam/dataset/rgbd_observation.h>
#include <rgbd_graphslam/graphslam/graph_slam_session.h>
#include <rgbd_graphslam/job/sparse_map_file.h>
#include <rgbd_graphslam/mapping/map_files.h>

#include <cmath>
#include <cstdio>
#include <optional>

using namespace rgbd_graphslam;
using mrpt::obs::CObservation3DRangeScan;

int main(int argc, char** argv) try {
    if (argc < 3) throw Error("usage: example_localize MAP_FOLDER RAWLOG");
    const std::string folder = argv[1];
    SlamOptions options;
    IniFile::fromFile(folder + "/config.ini").loadKnown(options.all());
    SparseMap map = readSparseMap(folder + "/" + sparse_map_name);
    const SE3 T_grid_world = map.T_up_world;  // the grid has z up, the floor at z = 0
    const auto grid = loadGridMap(folder + "/grid.gridmap.gz");

    RawlogReader rawlog(argv[2]);
    std::optional<GraphSlamSession> session;
    while (const auto entry = rawlog.next()) {
        const auto frame = std::dynamic_pointer_cast<CObservation3DRangeScan>(entry);
        if (!frame) continue;
        if (!session) {
            session.emplace(options, Rig{{rigCameraOf(*frame)}}, std::move(map.snapshot),
                            MapUse::Localize);
        }
        const TrackedFrame tracked = session->step(frame);
        const bool located = tracked.origin != FrameOrigin::Lost && tracked.submap == 0;
        if (!located) {
            std::printf("%.3f not located\n", tracked.stamp_s);
            continue;
        }
        const SE3 T_grid_robot =
            T_grid_world * tracked.T_world_cam * session->T_base_cam().inverse();
        const float x = static_cast<float>(T_grid_robot.t.x()),
                    y = static_cast<float>(T_grid_robot.t.y());
        std::printf("%.3f x %.2f m y %.2f m heading %.1f deg, cell %d %d free with %.2f\n",
                    tracked.stamp_s, x, y,
                    std::atan2(T_grid_robot.R(1, 0), T_grid_robot.R(0, 0)) * 180 / M_PI,
                    grid.x2idx(x), grid.y2idx(y), grid.getPos(x, y));
    }
} catch (const Error& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
}
