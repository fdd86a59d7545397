#include "semantic_files.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/formatted.h"

namespace rgbd_graphslam {
namespace {

using nlohmann::ordered_json;

std::array<std::uint8_t, 3> colorOf(const LabelSet& names, int label) {
    const auto found = names.find(label);
    return found == names.end() ? std::array<std::uint8_t, 3>{128, 128, 128} : found->second.rgb;
}

template <class T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string header(std::size_t points) {
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points) +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
           "property uchar green\nproperty uchar blue\nproperty ushort label\n"
           "property float confidence\nproperty ushort views\nproperty int object\nend_header\n";
}

/** To a thousandth. */
double rounded(double value) {
    return std::round(1000 * value) / 1000;
}

ordered_json toJson(const Eigen::Vector3d& m) {
    return {rounded(m.x()), rounded(m.y()), rounded(m.z())};
}

ordered_json toJson(const MapObject& object, int number, const LabelSet& names,
                    const std::vector<ObjectView>& views) {
    ordered_json json;
    json["id"] = number;
    json["class"] = nameOf(names, object.label);
    json["label"] = object.label;
    json["confidence"] = rounded(object.confidence);
    json["center_m"] = toJson(object.box.center);
    json["size_m"] = toJson(object.box.size);
    json["yaw_deg"] = rounded(object.box.yaw_rad * 180 / M_PI);
    json["voxels"] = object.voxels;
    json["views"] = ordered_json::array();
    for (const ObjectView& view : views) {
        json["views"].push_back({{"stamp", formatted("%.6f", view.stamp_s)},
                                 {"box_px", {view.u_min, view.v_min, view.u_max, view.v_max}}});
    }
    return json;
}

}  // namespace

PointMap pointsByClass(const LabelFusion& map, const LabelSet& names) {
    PointMap points;
    for (const auto& entry : map.voxels().entries()) {
        points.push_back({map.position(entry), colorOf(names, entry.cell.vote.best())});
    }
    return points;
}

void saveLabeledPly(const std::string& path, const LabelFusion& map, const LabelSet& names,
                    const FoundObjects& objects, const SemanticOptions& options) {
    const auto& entries = map.voxels().entries();
    const int classes = std::max<int>(2, static_cast<int>(names.size()));
    std::string bytes = header(entries.size());
    for (const auto& entry : entries) {
        const LabelVote& vote = entry.cell.vote;
        const auto object = objects.object_of_voxel.find(entry.key);
        append(bytes, map.position(entry));
        append(bytes, colorOf(names, vote.best()));
        append(bytes, static_cast<std::uint16_t>(vote.best()));
        append(bytes, static_cast<float>(vote.confidence(options.frame_accuracy, classes)));
        append(bytes, static_cast<std::uint16_t>(std::min<std::uint32_t>(65535, entry.cell.views)));
        append(bytes, object == objects.object_of_voxel.end() ? -1 : object->second);
    }
    writeTextAtomically(path, bytes);
}

void saveObjects(const std::string& path, const FoundObjects& objects, const LabelSet& names,
                 const ObjectViews& views) {
    ordered_json json;
    json["classes"] = ordered_json::object();
    for (const auto& [label, of] : names) json["classes"][std::to_string(label)] = of.name;
    json["objects"] = ordered_json::array();
    for (std::size_t i = 0; i < objects.objects.size(); ++i) {
        json["objects"].push_back(toJson(objects.objects[i], static_cast<int>(i), names, views[i]));
    }
    writeTextAtomically(path, json.dump(1) + "\n");
}

}  // namespace rgbd_graphslam
