#include <filesystem>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/export/mcap_writer.h"
#include "rgbd_graphslam/export/ros2_messages.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "ros_grid.h"
#include "run_points.h"
#include "run_trajectory.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_points = 2000000;
constexpr const char* map_frame = "map";
constexpr const char* camera_frame = "camera_optical_frame";

std::uint16_t addTopic(McapWriter& bag, const std::string& topic, const std::string& type_name) {
    const Ros2Type type = ros2Type(type_name);
    return bag.addChannel(topic, type.name, type.definition);
}

class Ros2BagExporter : public Exporter {
  public:
    const char* name() const override { return "ros2"; }
    const char* about() const override {
        return "ROS 2 bag (MCAP) of poses, path, points and grid";
    }
    const char* fileName() const override { return "run.mcap"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const Content content = read(run_folder);
        writeAtomically(path, [&](const std::string& temporary) {
            McapWriter bag(temporary, "ros2");
            fill(bag, content);
            return bag.close();
        });
        if (content.points.empty()) return poseCount(content.trajectory);
        return poseCount(content.trajectory) + ", " + std::to_string(content.points.size()) +
               " points, grid of " + std::to_string(content.grid.cells.cols) + " x " +
               std::to_string(content.grid.cells.rows) + " cells";
    }

  private:
    struct Content {
        Trajectory trajectory;
        PointMap points;
        GridMap grid;
    };

    /** Poses are worth a bag without maps, too. */
    static Content read(const std::string& run_folder) {
        Content content;
        content.trajectory = readRunTrajectory(run_folder);
        const auto localized = readLocalizedRun(run_folder);
        const std::string maps = localized ? localized->map_folder : run_folder;
        const fs::path folder(maps);
        if (fs::exists(folder / "points.ply") && fs::exists(folder / "grid.yaml")) {
            content.points = readRunPoints(maps, most_points);
            content.grid = readRosGrid((folder / "grid").string());
        } else {
            sayWarning("'" + maps +
                       "' has no maps, so the bag has poses only; make the maps with: rgbd-map " +
                       maps);
        }
        return content;
    }

    static void fill(McapWriter& bag, const Content& content) {
        const auto tf = addTopic(bag, "/tf", "tf2_msgs/msg/TFMessage");
        const auto pose_topic = addTopic(bag, "/pose", "geometry_msgs/msg/PoseStamped");
        const auto path = addTopic(bag, "/path", "nav_msgs/msg/Path");
        const double start_s = content.trajectory.front().stamp_s;
        const auto start = static_cast<std::uint64_t>(rosNanoseconds(start_s));
        if (content.points.empty()) {
            bag.write(path, start, pathMessage(content.trajectory, map_frame));
        } else {
            const auto points = addTopic(bag, "/points", "sensor_msgs/msg/PointCloud2");
            const auto grid = addTopic(bag, "/map", "nav_msgs/msg/OccupancyGrid");
            bag.write(path, start, pathMessage(content.trajectory, map_frame));
            bag.write(points, start, pointCloudMessage(content.points, start_s, map_frame));
            bag.write(grid, start, gridMessage(content.grid, start_s, map_frame));
        }
        for (const StampedPose& pose : content.trajectory) {
            const auto stamp = static_cast<std::uint64_t>(rosNanoseconds(pose.stamp_s));
            bag.write(tf, stamp, tfMessage(pose, map_frame, camera_frame));
            bag.write(pose_topic, stamp, poseMessage(pose, map_frame));
        }
    }
};

}  // namespace

std::unique_ptr<const Exporter> ros2BagExporter() {
    return std::make_unique<Ros2BagExporter>();
}

}  // namespace rgbd_graphslam
