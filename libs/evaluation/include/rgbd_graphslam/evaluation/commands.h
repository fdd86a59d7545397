/** What rgbd-eval does: a request and a function for each of its commands. The functions read and
 *  write the files that the request names and return what is to be printed. */
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/evaluation/grid_accuracy.h"
#include "rgbd_graphslam/evaluation/mask_accuracy.h"
#include "rgbd_graphslam/evaluation/plots.h"
#include "rgbd_graphslam/evaluation/point_cloud.h"
#include "rgbd_graphslam/evaluation/report.h"
#include "rgbd_graphslam/evaluation/stamped_list.h"

namespace rgbd_graphslam {

/** A trajectory in a TUM text file or, as ground truth, in a `.rawlog`.
 *  \throws Error naming the file when it cannot be read or holds no pose */
Trajectory readTrajectory(const std::string& path);

/** Common to `ate` and `rpe`; empty names of plots mean none. */
struct TrajectoryRequest {
    std::vector<std::string> files;  // estimates, then the truth: two or more
    ReportFormat format = ReportFormat::Text;
    bool per_axis = false;
    std::string errors_plot, distribution_plot;
};

/** Arguments of `rgbd-eval ate`. */
struct AteRequest : TrajectoryRequest {
    AteOptions options;
    std::string plot;
    PlotPlane plane = PlotPlane::XY;
};
std::string runAte(const AteRequest& request);

/** Arguments of `rgbd-eval rpe`. */
struct RpeRequest : TrajectoryRequest {
    RpeOptions options;
};
std::string runRpe(const RpeRequest& request);

/** Arguments of `rgbd-eval drift`; it has no plots and no errors along axes. */
struct DriftRequest : TrajectoryRequest {
    DriftOptions options;
};
std::string runDrift(const DriftRequest& request);

/** Arguments of `rgbd-eval consistency`. */
struct ConsistencyRequest {
    std::string run_folder, truth;  // the truth: TUM text file or .rawlog
    /** Standard deviations of the truth, of each component. */
    double truth_std_m = 0, truth_std_deg = 0;
    ReportFormat format = ReportFormat::Text;
};
std::string runConsistency(const ConsistencyRequest& request);

/** Arguments of `rgbd-eval associate`. */
struct AssociateRequest {
    std::string first, second;  // lists
    AssociationOptions options;
};
std::string runAssociate(const AssociateRequest& request);

/** One image of `color` and `depth`; with a trajectory all images of the lists `color` and `depth`,
 *  or of the list of pairs `pairs`. */
struct PointCloudRequest {
    std::string color, depth, pairs, trajectory;
    std::string output;
    std::string camera = "ros";  // a name or a file
    double depth_units = 0;      // a meter; 0: the camera's
    double max_difference_s = 0.02;
    std::size_t every_image = 1;
    PointCloudOptions options;
};
std::string runPointCloud(const PointCloudRequest& request);

/** Common to what is measured against a true surface. */
struct SurfaceRequest {
    std::string map, surface;
    /** With both, the map is moved as the estimate is to fit the truth. */
    std::string estimate, truth;
    /** Name or file; with it and `truth` it is told of what the camera saw, too. */
    std::string camera;
    SightOptions sight;
    ReportFormat format = ReportFormat::Text;
};
/** From the map's frame to the surface's. \throws Error as readTrajectory and evaluateAte do */
Similarity alignmentOf(const SurfaceRequest& request);
/** What the camera of a request saw of the surface on the true trajectory; nothing without a
 * camera. \throws Error as readTrajectory and SurfaceSight do */
std::optional<SurfaceSight> sightOf(const SurfaceRequest& request, const PlyModel& surface);

/** Arguments of `rgbd-eval map`. */
struct MapRequest : SurfaceRequest {
    MapAccuracyOptions options;
    std::string movers;  // a movers.csv; empty: it is not known where things moved
};
std::string runMap(const MapRequest& request);

/** The map is a grid.yaml. */
struct GridRequest : SurfaceRequest {
    GridAccuracyOptions options;
    std::string movers;  // as above
};
std::string runGrid(const GridRequest& request);

/** Folders of masks; a movers.csv beside the true folder tells the movers' speeds. */
struct MasksRequest {
    std::string estimated, truth;
    MaskAccuracyOptions options;
    ReportFormat format = ReportFormat::Text;
};
std::string runMasks(const MasksRequest& request);

}  // namespace rgbd_graphslam
