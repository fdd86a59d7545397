/** What of a run the panels show. */
#pragma once
#include <vector>

#include "panels.h"
#include "rgbd_graphslam/live/live_messages.h"
#include "run_scene.h"

namespace rgbd_graphslam {

/** Images of a keyframe, or why there are none. */
void showKeyframe(PicturePanel& panel, const RunScene& scene, std::size_t keyframe);
/** Landmarks, times and errors of a finished run. */
void showRunPlots(PlotPanel& panel, const RunScene& scene);
/** In one line. \param points of the map */
std::string summaryOf(const RunScene& scene, std::size_t points);

/** Images of the present frame with its features. \throws Error when it has none */
void showLiveFrame(PicturePanel& panel, const LiveFrame& frame);
void showLivePlots(PlotPanel& panel, const std::vector<LiveStatistic>& statistics);

}  // namespace rgbd_graphslam
