/** The interactive viewer. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** What to show. */
struct ViewerJob {
    /** Output folder of rgbd-slam, or a `.ply`. */
    std::string path;
    /** The run is still going on, or yet to begin; once it ends its result is shown. */
    bool follow = false;
    /** Once everything is shown (of a running SLAM: once it has ended), writes the window to this
     *  PNG and ends. */
    std::string screenshot;
    /** Measures the frame rate for so long, says it and ends; 0 = does not. */
    double benchmark_s = 0;
};

/** Opens the window and returns when it is closed. Settings are kept in settingsPath().
 *  \throws Error when there is no display, no OpenGL 3.3, or nothing to show */
void runViewer(const ViewerJob& job);

}  // namespace rgbd_graphslam
