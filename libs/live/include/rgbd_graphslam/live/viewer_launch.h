/** Starting the viewer beside a run. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** Starts `rgbd-viewer --follow FOLDER` as a process in a session of its own: it outlives the run,
 *  and keys pressed in the run's terminal do not reach it. The viewer beside this program is taken,
 *  else the one on the PATH. Warns when there is none. */
void launchViewer(const std::string& folder);

}  // namespace rgbd_graphslam
