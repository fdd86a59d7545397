/** All map files of a finished run. */
#pragma once
#include <string>

#include "rgbd_graphslam/mapping/map_inputs.h"
#include "rgbd_graphslam/mapping/map_options.h"

namespace rgbd_graphslam {

/** Sizes and costs of the maps that were written. */
struct MapSummary {
    std::size_t keyframes = 0, points = 0, octree_leaves = 0, triangles = 0;
    int grid_width = 0, grid_height = 0;  // cells
    /** Of 2-D lasers, entered into the grid. */
    std::size_t scans = 0;
    double insert_ms = 0;  // CPU, a keyframe, all maps
    /** Of the maps in memory; the grid is made of the octree where their resolutions are equal. */
    double megabytes = 0, points_megabytes = 0, octree_megabytes = 0, mesh_megabytes = 0;
};

/** Writes points.ply, points.pcd, points.metricmap, octree.bt, octree.ot, grid.gridmap.gz,
 *  grid.png, grid.yaml, map.simplemap, scene.3Dscene, map.png and, if options ask for it, mesh.ply,
 *  in one pass over each rawlog. Scans of a 2-D laser beside the camera mark obstacles in the grid.
 * A rawlog of an earlier session that is gone is warned of and left out. \param inputs upright: z
 * up, floor at z = 0 \throws Error when something cannot be read or written, or would not fit in
 * memory */
MapSummary writeMaps(const MapInputs& inputs, const MapOptions& options,
                     const std::string& out_folder);

}  // namespace rgbd_graphslam
