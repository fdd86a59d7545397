#include "run_origin.h"

#include "rgbd_graphslam/core/command_text.h"

namespace rgbd_graphslam {

nlohmann::json originJson(const std::optional<Intrinsics>& camera) {
    nlohmann::json json = {
        {"command", commandText()}, {"date", localTimeText()}, {"camera", nullptr}};
    if (camera) {
        json["camera"] = {{"width", camera->width},
                          {"height", camera->height},
                          {"fx", camera->fx},
                          {"fy", camera->fy},
                          {"cx", camera->cx},
                          {"cy", camera->cy},
                          {"lens", lensModel(camera->lens)},
                          {"distortion", lensCoefficients(camera->lens)}};
    }
    return json;
}

}  // namespace rgbd_graphslam
