/** The switches of the 3-D view, and why some have nothing to show. */
#pragma once
#include <string>
#include <vector>

#include "rgbd_graphslam/mapping/scene_colors.h"
#include "rgbd_graphslam/viewer/run_data.h"
#include "rgbd_graphslam/viewer/viewer_settings.h"

namespace rgbd_graphslam {

/** A checkbox of the view and its key. */
struct ViewSwitch {
    bool ViewerSettings::*field;
    const char* name;
    const char* about;
    const char* key;    // empty without one
    const Rgba* color;  // of its lines; nullptr for surfaces
};

/** In the order of the panel. */
const std::vector<ViewSwitch>& viewSwitches();

/** What a run has to show. */
struct RunContents {
    bool points = true, mesh = true, octree = true, grid = true, truth = true, keyframes = true,
         covisibility = true, loops = true, before_loops = true, up_known = true;
    /** The run is still going on: its maps and its truth come when it ends. */
    bool is_live = false;
};

RunContents contentsOf(const RunData& run);
/** Of a run while it goes on. */
RunContents liveContents();

/** Why a switch has nothing to show, in a sentence that says how to get it; empty where it has. */
std::string whyNothingToShow(bool ViewerSettings::*field, const RunContents& contents);

}  // namespace rgbd_graphslam
