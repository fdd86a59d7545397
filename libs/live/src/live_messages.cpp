/** Messages as bytes. */
#include "rgbd_graphslam/live/live_messages.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

/** Of what comes beside images and poses. A text that grows would be copied some ten times. */
constexpr std::size_t least_bytes = std::size_t{1} << 15;
constexpr std::uint8_t frame_tag = 1, map_tag = 2;
constexpr std::size_t pose_bytes = 12 * sizeof(double), edge_bytes = 2 * sizeof(std::int32_t),
                      feature_bytes = 9, statistic_bytes = 17;

void put(ByteWriter& out, const SE3& T) {
    for (const double value : T.R.reshaped()) out.put(value);
    for (const double value : T.t) out.put(value);
}

SE3 getPose(ByteReader& in) {
    SE3 T;
    for (double& value : T.R.reshaped()) value = in.get<double>();
    for (double& value : T.t) value = in.get<double>();
    return T;
}

void put(ByteWriter& out, const Trajectory& trajectory) {
    out.putCount(trajectory.size());
    for (const StampedPose& pose : trajectory) {
        out.put(pose.stamp_s);
        put(out, pose.T_world_cam);
    }
}

Trajectory getTrajectory(ByteReader& in) {
    Trajectory trajectory(in.getCount(sizeof(double) + pose_bytes));
    for (StampedPose& pose : trajectory) {
        pose.stamp_s = in.get<double>();
        pose.T_world_cam = getPose(in);
    }
    return trajectory;
}

void put(ByteWriter& out, const std::vector<LiveFeature>& features) {
    out.putCount(features.size());
    for (const LiveFeature& feature : features) {
        out.put(feature.u);
        out.put(feature.v);
        out.put(static_cast<std::uint8_t>(feature.state));
    }
}

std::vector<LiveFeature> getFeatures(ByteReader& in) {
    std::vector<LiveFeature> features(in.getCount(feature_bytes));
    for (LiveFeature& feature : features) {
        feature.u = in.get<float>();
        feature.v = in.get<float>();
        feature.state = static_cast<FeatureState>(in.get<std::uint8_t>());
        if (feature.state > FeatureState::Lost)
            throw DamagedBytes("a feature is of no known state");
    }
    return features;
}

void put(ByteWriter& out, const std::vector<LiveStatistic>& statistics) {
    out.putCount(statistics.size());
    for (const LiveStatistic& statistic : statistics) {
        out.put(statistic.stamp_s);
        out.put(statistic.frame_ms);
        out.put<std::int32_t>(statistic.inliers);
        out.put<std::uint8_t>(statistic.lost ? 1 : 0);
    }
}

std::vector<LiveStatistic> getStatistics(ByteReader& in) {
    std::vector<LiveStatistic> statistics(in.getCount(statistic_bytes));
    for (LiveStatistic& statistic : statistics) {
        statistic.stamp_s = in.get<double>();
        statistic.frame_ms = in.get<float>();
        statistic.inliers = in.get<std::int32_t>();
        statistic.lost = in.get<std::uint8_t>() != 0;
    }
    return statistics;
}

std::size_t imageBytes(const cv::Mat& image) {
    return image.total() * image.elemSize();
}

/** All pixels at once: one by one they would take longer than all the rest. */
void putImage(ByteWriter& out, const cv::Mat& image) {
    const cv::Mat whole = image.isContinuous() ? image : image.clone();
    const std::size_t bytes = imageBytes(whole);
    out.put<std::int32_t>(whole.cols);
    out.putCount(bytes);
    out.putBytes({reinterpret_cast<const char*>(whole.data), bytes});
}

cv::Mat getImage(ByteReader& in, int type) {
    const int columns = in.get<std::int32_t>();
    const std::size_t size = in.getCount(1);
    const std::string_view bytes = in.getBytes(size);
    if (bytes.empty()) return {};
    const std::size_t row = CV_ELEM_SIZE(type) * static_cast<std::size_t>(std::max(columns, 0));
    if (row == 0 || bytes.size() % row != 0) {
        throw DamagedBytes("a live message has an image of no shape");
    }
    cv::Mat image(static_cast<int>(bytes.size() / row), columns, type);
    std::memcpy(image.data, bytes.data(), bytes.size());
    return image;
}

void put(ByteWriter& out, const Intrinsics& camera) {
    out.put<std::int32_t>(camera.width);
    out.put<std::int32_t>(camera.height);
    for (const double d : {camera.fx, camera.fy, camera.cx, camera.cy}) out.put(d);
    out.putText(lensModel(camera.lens));
    for (const double k : lensCoefficients(camera.lens)) out.put(k);
}

Lens getLens(ByteReader& in) {
    const std::string model = in.getText();
    const std::size_t count = model == "kannala_brandt" ? 4 : model == "rational" ? 8 : 5;
    std::vector<double> coefficients(count);
    for (double& k : coefficients) k = in.get<double>();
    try {
        return makeLens(model, coefficients);
    } catch (const std::invalid_argument&) {
        throw DamagedBytes("a live message has no camera");
    }
}

Intrinsics getCamera(ByteReader& in) {
    Intrinsics camera;
    camera.width = in.get<std::int32_t>();
    camera.height = in.get<std::int32_t>();
    for (double* d : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *d = in.get<double>();
    camera.lens = getLens(in);
    return camera;
}

void put(ByteWriter& out, const LiveFrame& frame) {
    out.put(frame_tag);
    out.put<std::uint8_t>(frame.is_picture ? 1 : 0);
    out.put(frame.stamp_s);
    out.put<std::uint8_t>(frame.lost ? 1 : 0);
    put(out, frame.T_world_cam);
    out.put<std::int32_t>(frame.keyframe);
    put(out, frame.camera);
    put(out, frame.features);
    put(out, frame.statistics);
    out.put<std::int32_t>(frame.step);
    out.put(frame.depth_unit_m);
    putImage(out, frame.color);
    putImage(out, frame.depth);
}

LiveFrame getFrame(ByteReader& in) {
    LiveFrame frame;
    frame.is_picture = in.get<std::uint8_t>() != 0;
    frame.stamp_s = in.get<double>();
    frame.lost = in.get<std::uint8_t>() != 0;
    frame.T_world_cam = getPose(in);
    frame.keyframe = in.get<std::int32_t>();
    frame.camera = getCamera(in);
    frame.features = getFeatures(in);
    frame.statistics = getStatistics(in);
    frame.step = in.get<std::int32_t>();
    frame.depth_unit_m = in.get<double>();
    frame.color = getImage(in, CV_8UC3);
    frame.depth = getImage(in, CV_16UC1);
    return frame;
}

void put(ByteWriter& out, const std::vector<std::pair<int, int>>& edges) {
    out.putCount(edges.size());
    for (const auto& [from, to] : edges) {
        out.put<std::int32_t>(from);
        out.put<std::int32_t>(to);
    }
}

std::vector<std::pair<int, int>> getEdges(ByteReader& in, std::size_t keyframes) {
    std::vector<std::pair<int, int>> edges(in.getCount(edge_bytes));
    for (auto& [from, to] : edges) {
        for (int* end : {&from, &to}) {
            *end = in.get<std::int32_t>();
            if (*end < 0 || static_cast<std::size_t>(*end) >= keyframes)
                throw DamagedBytes("a live message has an edge to nowhere");
        }
    }
    return edges;
}

void put(ByteWriter& out, const LiveMap& map) {
    out.put(map_tag);
    put(out, map.path);
    put(out, map.keyframes);
    put(out, map.loops);
    put(out, map.covisibility);
}

LiveMap getMap(ByteReader& in) {
    LiveMap map;
    map.path = getTrajectory(in);
    map.keyframes = getTrajectory(in);
    map.loops = getEdges(in, map.keyframes.size());
    map.covisibility = getEdges(in, map.keyframes.size());
    return map;
}

/** About as many as the message will have. */
std::size_t bytesOf(const LiveFrame& frame) {
    return least_bytes + imageBytes(frame.color) + imageBytes(frame.depth);
}

std::size_t bytesOf(const LiveMap& map) {
    return least_bytes + (map.path.size() + map.keyframes.size()) * (sizeof(double) + pose_bytes) +
           (map.loops.size() + map.covisibility.size()) * edge_bytes;
}

LiveMessage getMessage(ByteReader& in) {
    switch (in.get<std::uint8_t>()) {
        case frame_tag:
            return getFrame(in);
        case map_tag:
            return getMap(in);
        default:
            throw DamagedBytes("a live message is of an unknown kind");
    }
}

}  // namespace

std::string encode(const LiveMessage& message) {
    ByteWriter out;
    std::visit(
        [&](const auto& content) {
            out.reserve(bytesOf(content));
            put(out, content);
        },
        message);
    return out.take();
}

LiveMessage decode(const std::string& bytes) {
    ByteReader in(bytes);
    LiveMessage message = getMessage(in);
    if (in.left() > 0) throw DamagedBytes("a live message has bytes too many");
    return message;
}

}  // namespace rgbd_graphslam
