#include "rgbd_graphslam/viewer/view_switches.h"

namespace rgbd_graphslam {
namespace {

using S = ViewerSettings;

/** A switch, whether there is something for it, and what to say where there is not. */
struct Need {
    bool S::*field;
    bool RunContents::*what;
    bool after_run;  // whether it comes when a running SLAM ends
    const char* why;
};

constexpr const char* no_octree = "This run has no octree. Make one with: rgbd-map OUT";
constexpr const char* no_truth =
    "The recording holds no ground truth. rgbd-import takes it from groundtruth.txt.";

const Need needs[] = {
    {&S::points, &RunContents::points, false,
     "This run has no points, and its recording is gone. Make them with: rgbd-map OUT"},
    {&S::mesh, &RunContents::mesh, true,
     "This run has no mesh. Make one with: rgbd-map OUT --mesh 0.02"},
    {&S::octree, &RunContents::octree, true, no_octree},
    {&S::free_space, &RunContents::octree, true, no_octree},
    {&S::grid, &RunContents::grid, true, "This run has no 2-D grid. Make one with: rgbd-map OUT"},
    {&S::truth, &RunContents::truth, true, no_truth},
    {&S::errors, &RunContents::truth, true, no_truth},
    {&S::trajectory, &RunContents::keyframes, false,
     "Only a map was opened. Open the output folder of rgbd-slam to see the trajectory."},
    {&S::keyframes, &RunContents::keyframes, false,
     "Only a map was opened. Open the output folder of rgbd-slam to see its keyframes."},
    {&S::covisibility, &RunContents::covisibility, false,
     "There is no covisibility.csv in this folder. rgbd-slam writes one."},
    {&S::loops, &RunContents::loops, false, "No loop was closed in this run."},
    {&S::before_loops, &RunContents::before_loops, true,
     "No loop was closed in this run, so the path was not corrected."},
    {&S::cut_ceiling, &RunContents::up_known, false,
     "Nothing is cut off: which way is up is only a guess in this run (no accelerometer, and no "
     "floor was found)."}};

}  // namespace

const std::vector<ViewSwitch>& viewSwitches() {
    static const std::vector<ViewSwitch> switches = {
        {&S::points, "points", "The point cloud; in a replay that of the keyframes so far.", "P",
         nullptr},
        {&S::mesh, "mesh", "The surface that rgbd-map --mesh makes.", "N", nullptr},
        {&S::octree, "octree: occupied", "Occupied cells of the octree.", "O", nullptr},
        {&S::free_space, "octree: free", "Cells of the octree that were seen to be free.", "U",
         nullptr},
        {&S::grid, "2-D grid", "Obstacles and free space for driving.", "G", nullptr},
        {&S::trajectory, "trajectory", "The estimated path of the camera.", "", &trajectory_color},
        {&S::truth, "ground truth", "The true path of the camera.", "R", &truth_color},
        {&S::errors, "errors", "Lines from estimated to true positions, magnified.", "E",
         &error_color},
        {&S::keyframes, "keyframes",
         "Where keyframes looked from. Of many in one place some are drawn.", "K", &keyframe_color},
        {&S::covisibility, "covisibility", "Joins keyframes that see the same landmarks.", "V",
         &covisibility_color},
        {&S::loops, "loops", "Joins keyframes that were recognized as the same place.", "L",
         &loop_color},
        {&S::before_loops, "before loop closure", "The keyframes' path by tracking alone.", "B",
         &before_color},
        {&S::floor, "floor lines", "Lines and distances on the floor.", "D", nullptr},
        {&S::cut_ceiling, "hide ceiling", "Leaves out what is above people's heads.", "X",
         nullptr}};
    return switches;
}

RunContents contentsOf(const RunData& run) {
    RunContents contents;
    contents.points = !run.points.empty() || !run.rawlog.empty();
    contents.mesh = !run.mesh.triangles.empty();
    contents.octree = !run.octree.occupied.empty() || !run.octree.free.empty();
    contents.grid = run.grid.has_value();
    contents.truth = !run.truth.empty();
    contents.keyframes = !run.keyframes.empty();
    contents.covisibility = !run.covisibility.empty();
    contents.loops = !run.loops.empty();
    contents.before_loops = !run.keyframes_before_loops.empty();
    contents.up_known = !run.up_is_guessed;
    return contents;
}

RunContents liveContents() {
    RunContents contents;
    contents.mesh = contents.octree = contents.grid = contents.truth = contents.before_loops =
        false;
    contents.is_live = true;
    return contents;
}

std::string whyNothingToShow(bool ViewerSettings::*field, const RunContents& contents) {
    for (const Need& need : needs) {
        if (need.field != field || contents.*need.what) continue;
        return contents.is_live && need.after_run ? "Known when the run has ended." : need.why;
    }
    return {};
}

}  // namespace rgbd_graphslam
