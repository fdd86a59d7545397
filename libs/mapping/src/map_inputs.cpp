#include "rgbd_graphslam/mapping/map_inputs.h"

#include <algorithm>
#include <numeric>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

std::vector<std::size_t> sessionLengths(const MapInputs& inputs) {
    std::vector<std::size_t> lengths;
    for (const EarlierSession& session : inputs.earlier) lengths.push_back(session.keyframes);
    return lengths;
}

void checkInputs(const MapInputs& inputs) {
    if (inputs.keyframes.empty())
        throw Error("there is no keyframe to make maps of", "check the trajectory");
    const int count = static_cast<int>(inputs.keyframes.size());
    const auto sessions = sessionLengths(inputs);
    const std::size_t earlier = std::accumulate(sessions.begin(), sessions.end(), std::size_t{0});
    if (earlier > inputs.keyframes.size())
        throw Error("earlier sessions name more keyframes than there are");
    for (const MapLoopEdge& loop : inputs.loops) {
        if (std::min(loop.from, loop.to) >= 0 && std::max(loop.from, loop.to) < count) continue;
        throw Error("a loop names keyframe " + std::to_string(std::max(loop.from, loop.to)) +
                    " of " + std::to_string(count));
    }
}

MapInputs withoutDisconnected(const MapInputs& inputs) {
    MapInputs result = inputs;
    result.disconnected.clear();
    result.keyframes.clear();
    result.loops.clear();
    result.keyframes_before_loops.clear();
    const auto& disconnected = inputs.disconnected;
    std::vector<int> number;
    for (std::size_t k = 0; k < inputs.keyframes.size(); ++k) {
        const bool left_out =
            std::binary_search(disconnected.begin(), disconnected.end(), static_cast<int>(k));
        number.push_back(left_out ? -1 : static_cast<int>(result.keyframes.size()));
        if (left_out) continue;
        result.keyframes.push_back(inputs.keyframes[k]);
        if (k < inputs.keyframes_before_loops.size())
            result.keyframes_before_loops.push_back(inputs.keyframes_before_loops[k]);
    }
    for (const MapLoopEdge& loop : inputs.loops) {
        if (number[loop.from] < 0 || number[loop.to] < 0) continue;
        result.loops.push_back({number[loop.from], number[loop.to], loop.inliers});
    }
    std::size_t begin = 0;
    for (EarlierSession& session : result.earlier) {
        const auto first = number.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = first + static_cast<std::ptrdiff_t>(session.keyframes);
        begin += session.keyframes;
        session.keyframes -= static_cast<std::size_t>(std::count(first, last, -1));
    }
    return result;
}

MapInputs transformed(const SE3& T_a_world, MapInputs inputs) {
    for (Trajectory* poses :
         {&inputs.keyframes, &inputs.trajectory, &inputs.keyframes_before_loops}) {
        for (auto& pose : *poses) pose.T_world_cam = T_a_world * pose.T_world_cam;
    }
    return inputs;
}

}  // namespace rgbd_graphslam
