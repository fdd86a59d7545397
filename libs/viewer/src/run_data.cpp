#include "rgbd_graphslam/viewer/run_data.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <octomap/ColorOcTree.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"
#include "rgbd_graphslam/mapping/run_folder.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** A map that cannot be read is no reason not to show the others. */
void ifThere(const fs::path& path, const std::function<void(const std::string&)>& read) {
    if (!fs::exists(path)) return;
    try {
        read(path.string());
    } catch (const std::exception& e) {
        sayWarning(std::string(e.what()) + "; it is not shown");
    }
}

constexpr std::array<std::uint8_t, 3> free_rgb = {90, 190, 120};

OctreeCells cellsOf(const octomap::ColorOcTree& tree) {
    OctreeCells cells;
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
        const auto p = leaf.getCoordinate();
        const auto color = leaf->getColor();
        const OctreeCell cell{
            {p.x(), p.y(), p.z()}, static_cast<float>(leaf.getSize()), {color.r, color.g, color.b}};
        if (tree.isNodeOccupied(*leaf)) {
            cells.occupied.push_back(cell);
        } else {
            cells.free.push_back({cell.center, cell.size_m, free_rgb});
        }
    }
    return cells;
}

GridMap readGrid(const std::string& path) {
    const mrpt::maps::COccupancyGridMap2D map = loadGridMap(path);
    GridMap grid;
    grid.width = static_cast<int>(map.getSizeX());
    grid.height = static_cast<int>(map.getSizeY());
    grid.resolution_m = map.getResolution();
    grid.x_min_m = map.getXMin();
    grid.y_min_m = map.getYMin();
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x) grid.free.push_back(map.getCell(x, y));
    }
    return grid;
}

/** Rows of a comma-separated file without its heading. */
std::vector<std::vector<std::string>> csvRows(const std::string& path) {
    std::ifstream in(path);
    std::vector<std::vector<std::string>> rows;
    std::string line, cell;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) rows.back().push_back(cell);
    }
    return rows;
}

std::vector<FrameNote> readFrames(const std::string& path) {
    std::vector<FrameNote> frames;
    for (const auto& row : csvRows(path)) {
        frames.push_back({std::stod(row.at(0)), row.at(1) == "lost", std::stoi(row.at(2))});
    }
    return frames;
}

std::vector<float> readFrameTimes(const std::string& path) {
    std::vector<float> times_ms;
    for (const auto& row : csvRows(path)) times_ms.push_back(std::stof(row.at(1)));
    return times_ms;
}

std::vector<KeyframeEdge> readCovisibility(const std::string& path, int keyframes) {
    std::vector<KeyframeEdge> edges;
    for (const auto& row : csvRows(path)) {
        edges.push_back({std::stoi(row.at(0)), std::stoi(row.at(1))});
        if (std::max(edges.back().from, edges.back().to) >= keyframes) {
            throw Error("'" + path + "' names a keyframe that keyframes.txt does not have");
        }
    }
    return edges;
}

void sortByLater(std::vector<KeyframeEdge>& edges) {
    std::stable_sort(edges.begin(), edges.end(), [](const KeyframeEdge& a, const KeyframeEdge& b) {
        return std::max(a.from, a.to) < std::max(b.from, b.to);
    });
}

/** Poses and, where it still exists, the recording they come from. */
MapInputs readInputs(const std::string& folder) {
    try {
        return readRunFolder(folder, "");
    } catch (const Error& e) {
        MapInputs inputs = readRunFolder(folder, "gone");  // throws when more is wrong than that
        inputs.rawlog.clear();
        sayWarning(std::string(e.what()) + "; shown without images");
        return inputs;
    }
}

void readNotes(const fs::path& folder, RunData& run) {
    ifThere(folder / "frames.csv", [&](const std::string& path) { run.frames = readFrames(path); });
    ifThere(folder / "frame_times.csv",
            [&](const std::string& path) { run.frame_times_ms = readFrameTimes(path); });
}

void readPoses(const fs::path& folder, RunData& run) {
    MapInputs inputs = readInputs(folder.string());
    run.rawlog = std::move(inputs.rawlog);
    run.up_is_guessed = upIsGuessed(folder.string());
    run.sensor_label = std::move(inputs.sensor_label);
    run.entries = std::move(inputs.entries);
    run.trajectory = std::move(inputs.trajectory);
    run.unplaced_s = std::move(inputs.unplaced_s);
    run.earlier_keyframes = sessionLengths(inputs);
    run.keyframes = std::move(inputs.keyframes);
    run.keyframes_before_loops = std::move(inputs.keyframes_before_loops);
    const int count = static_cast<int>(run.keyframes.size());
    for (const MapLoopEdge& loop : inputs.loops) {
        if (loop.from < count && loop.to < count) run.loops.push_back({loop.from, loop.to});
    }
    ifThere(folder / "truth.txt", [&](const std::string& path) { run.truth = readTumPoses(path); });
    ifThere(folder / "covisibility.csv",
            [&](const std::string& path) { run.covisibility = readCovisibility(path, count); });
    sortByLater(run.loops);
    sortByLater(run.covisibility);
    readNotes(folder, run);
}

void readMaps(const fs::path& folder, RunData& run) {
    ifThere(folder / "points.ply", [&](const std::string& path) { run.points = loadPly(path); });
    ifThere(folder / "mesh.ply", [&](const std::string& path) { run.mesh = readPly(path); });
    ifThere(folder / "octree.ot",
            [&](const std::string& path) { run.octree = cellsOf(*loadColorOcTree(path)); });
    ifThere(folder / "grid.gridmap.gz",
            [&](const std::string& path) { run.grid = readGrid(path); });
}

/** A run that made a map. */
RunData loadMapped(const std::string& folder) {
    RunData run;
    run.folder = folder;
    readPoses(folder, run);
    readMaps(folder, run);
    return run;
}

/** The map of the one run with the way of the other. */
RunData loadLocalized(LocalizedRun localized, const std::string& folder) {
    RunData run = loadMapped(localized.map_folder);
    run.folder = folder;
    run.trajectory = std::move(localized.trajectory);
    run.unplaced_s = std::move(localized.unplaced_s);
    run.truth = {};
    readNotes(folder, run);
    return run;
}

}  // namespace

RunData loadRun(const std::string& path) {
    if (fs::path(path).extension() == ".ply") {
        RunData run;
        run.points = loadPly(path);
        run.mesh = readPly(path);
        return run;
    }
    if (!fs::is_directory(path)) {
        throw Error("'" + path + "' is neither a folder nor a .ply",
                    "give the output folder of rgbd-slam");
    }
    if (auto localized = readLocalizedRun(path)) return loadLocalized(std::move(*localized), path);
    return loadMapped(path);
}

}  // namespace rgbd_graphslam
