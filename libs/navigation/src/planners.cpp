#include "rgbd_graphslam/navigation/planners.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/nav/planners/PlannerRRT_SE2_TPS.h>
#include <mrpt/nav/planners/PlannerSimple2D.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/random/RandomGenerators.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr float surely_free = 0.6f;
constexpr double around_leg_m = 1.5;  // the tree may leave the box of a leg's ends by so much
constexpr double leg_end_m = 0.15;    // how near a leg has to come to its end
constexpr unsigned seed = 1;
constexpr double surroundings_m = 0.8;

std::string text(const TPoint2D& p) {
    char buffer[64];
    std::snprintf(buffer, sizeof(buffer), "(%.2f, %.2f)", p.x, p.y);
    return buffer;
}

/** The widest level, larger by the margin: the RRT knows one outline. */
mrpt::math::TPolygon2D planningOutline(const RobotBody& body, double margin_m) {
    const BodyLevel* widest = &body.front();
    for (const BodyLevel& level : body) {
        if (circumscribedRadius({level}) > circumscribedRadius({*widest})) widest = &level;
    }
    mrpt::math::TPolygon2D outline;
    for (const Eigen::Vector2d& corner : widest->outline) {
        const Eigen::Vector2d p = corner + margin_m * corner.normalized();
        outline.push_back({p.x(), p.y()});
    }
    return outline;
}

std::vector<TPoint2D> legEnds(const TPose2D& start, const Route& route, double leg_m) {
    std::vector<TPoint2D> ends;
    TPoint2D from(start.x, start.y);
    for (std::size_t i = 0; i + 1 < route.size(); ++i) {
        if ((route[i] - from).norm() < leg_m) continue;
        ends.push_back(route[i]);
        from = route[i];
    }
    ends.push_back(route.back());
    return ends;
}

/** One solver for all legs: its tables take longer than a leg. */
class LegPlanner {
  public:
    LegPlanner(const NavigationMap& map, const RobotBody& body, const DriveOptions& options,
               const mrpt::config::CConfigFileBase& config, const std::string& cache_folder) {
        planner_.loadConfig(config);
        // PlannerSimple2D adds a cell on its own.
        const double margin_m = options.planning_margin_m + map.grid.getResolution();
        planner_.params.robot_shape = planningOutline(body, margin_m);
        planner_.params.robot_shape_circular_radius = circumscribedRadius(body) + margin_m;
        planner_.params.ptg_cache_files_directory = cache_folder;
        planner_.params.ptg_verbose = false;
        planner_.params.goalBias = 0.3;
        planner_.end_criteria.acceptedDistToTarget = leg_end_m;
        planner_.end_criteria.maxComputationTime = options.rrt_limit_s;
        planner_.getProfiler().disable();
        planner_.initialize();
        for (const TPoint2D& p : map.borders) input_.obstacles_points.insertPoint(p.x, p.y, 0);
    }

    /** \return the poses after `from`; nothing when no motion was found */
    std::optional<std::vector<TPose2D>> plan(const TPose2D& from, const TPoint2D& to) {
        input_.start_pose = from;
        input_.goal_pose = TPose2D(to.x, to.y, std::atan2(to.y - from.y, to.x - from.x));
        input_.world_bbox_min = TPose2D(std::min(from.x, to.x) - around_leg_m,
                                        std::min(from.y, to.y) - around_leg_m, -M_PI);
        input_.world_bbox_max = TPose2D(std::max(from.x, to.x) + around_leg_m,
                                        std::max(from.y, to.y) + around_leg_m, M_PI);
        // Anew for each leg: how many numbers one takes that is given up depends on the clock.
        mrpt::random::getRandomGenerator().randomize(seed);
        mrpt::nav::PlannerRRT_SE2_TPS::TPlannerResult result;
        planner_.solve(input_, result);
        if (!result.success) return std::nullopt;
        mrpt::nav::TMoveTreeSE2_TP::path_t path;
        result.move_tree.backtrackPath(result.best_goal_node_id, path);
        path.pop_front();
        std::vector<TPose2D> poses;
        for (const auto& node : path) poses.push_back(node.state);
        return poses;
    }

  private:
    mrpt::nav::PlannerRRT_SE2_TPS planner_;
    mrpt::nav::PlannerRRT_SE2_TPS::TPlannerInput input_;
};

Error noMotion(const TPose2D& from, const TPoint2D& to) {
    return Error(
        "PlannerRRT_SE2_TPS found no motion from " + text({from.x, from.y}) + " to " + text(to),
        "raise [DriveOptions] rrt_limit_s or lower planning_margin_m");
}

}  // namespace

Route planRoute(const COccupancyGridMap2D& grid, const TPoint2D& start, const TPoint2D& goal,
                double radius_m) {
    mrpt::nav::PlannerSimple2D planner;
    planner.robotRadius = static_cast<float>(radius_m);
    planner.occupancyThreshold = surely_free;
    std::deque<TPoint2D> path;
    bool not_found = false;
    planner.computePath(grid, mrpt::poses::CPose2D(start.x, start.y, 0),
                        mrpt::poses::CPose2D(goal.x, goal.y, 0), path, not_found);
    if (not_found || path.empty()) {
        throw Error("PlannerSimple2D found no way from " + text(start) + " to " + text(goal),
                    "map what lies between them or use a narrower robot");
    }
    Route route(path.begin(), path.end());
    route.push_back(goal);
    return route;
}

double firstHeading(const TPose2D& start, const Route& route) {
    const auto ahead = std::find_if(route.begin(), route.end() - 1, [&](const TPoint2D& p) {
        return std::hypot(p.x - start.x, p.y - start.y) > surroundings_m;
    });
    return std::atan2(ahead->y - start.y, ahead->x - start.x);
}

std::vector<TPose2D> planMotion(const NavigationMap& map, const TPose2D& start, const Route& route,
                                const RobotBody& body, const DriveOptions& options,
                                const mrpt::config::CConfigFileBase& config,
                                const std::string& cache_folder) {
    LegPlanner planner(map, body, options, config, cache_folder);
    std::vector<TPose2D> poses{start};
    std::vector<std::size_t> leg_starts;
    for (const TPoint2D& end : legEnds(start, route, options.leg_m)) {
        auto leg = planner.plan(TPose2D(poses.back()), end);
        // Where the leg before has ended too near to a wall to turn, the two are planned as one.
        while (!leg && !leg_starts.empty()) {
            poses.resize(leg_starts.back());
            leg_starts.pop_back();
            leg = planner.plan(TPose2D(poses.back()), end);
        }
        if (!leg) throw noMotion(poses.back(), end);
        leg_starts.push_back(poses.size());
        poses.insert(poses.end(), leg->begin(), leg->end());
    }
    return poses;
}

}  // namespace rgbd_graphslam
