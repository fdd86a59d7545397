#include "rgbd_graphslam/live/live_messages.h"

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <type_traits>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr int widest_px = 320, jpeg_quality = 80;
constexpr std::uint8_t frame_tag = 1, map_tag = 2;

class Writer {
  public:
    template <class T>
    void put(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    template <class T>
    void putList(const std::vector<T>& list) {
        put<std::uint32_t>(static_cast<std::uint32_t>(list.size()));
        for (const T& value : list) put(value);
    }
    void putPose(const SE3& T) {
        const Eigen::Matrix<double, 3, 4> matrix =
            (Eigen::Matrix<double, 3, 4>() << T.R, T.t).finished();
        bytes_.append(reinterpret_cast<const char*>(matrix.data()), sizeof(double) * 12);
    }
    void putTrajectory(const Trajectory& trajectory) {
        put<std::uint32_t>(static_cast<std::uint32_t>(trajectory.size()));
        for (const StampedPose& pose : trajectory) {
            put(pose.stamp_s);
            putPose(pose.T_world_cam);
        }
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

class Reader {
  public:
    explicit Reader(const std::string& bytes) : bytes_(bytes) {}

    template <class T>
    T get() {
        T value;
        copy(&value, sizeof(T));
        return value;
    }
    template <class T>
    std::vector<T> getList() {
        std::vector<T> list(count(sizeof(T)));
        copy(list.data(), list.size() * sizeof(T));
        return list;
    }
    SE3 getPose() {
        Eigen::Matrix<double, 3, 4> matrix;
        copy(matrix.data(), sizeof(double) * 12);
        return {Eigen::Matrix3d(matrix.leftCols<3>()), Eigen::Vector3d(matrix.col(3))};
    }
    Trajectory getTrajectory() {
        Trajectory trajectory(count(13 * sizeof(double)));
        for (StampedPose& pose : trajectory) {
            pose.stamp_s = get<double>();
            pose.T_world_cam = getPose();
        }
        return trajectory;
    }
    void finish() const {
        if (at_ != bytes_.size()) throw Error("a live message has bytes too many");
    }

  private:
    /** A list's length, which must fit into what is left. */
    std::size_t count(std::size_t bytes_each) {
        const std::size_t n = get<std::uint32_t>();
        if (n > (bytes_.size() - at_) / bytes_each) throw Error("a live message is cut off");
        return n;
    }
    void copy(void* to, std::size_t size) {
        if (size > bytes_.size() - at_) throw Error("a live message is cut off");
        if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
};

void write(Writer& out, const LiveFrame& frame) {
    out.put(frame_tag);
    out.put(frame.stamp_s);
    out.put(frame.lost);
    out.putPose(frame.T_world_cam);
    out.put(frame.keyframe);
    out.put(frame.camera);
    out.putList(frame.features);
    out.putList(frame.statistics);
    out.putList(frame.color_jpeg);
    out.put(frame.depth_step);
    out.put(frame.depth_unit_m);
    out.put(frame.depth.cols);
    const cv::Mat depth = frame.depth.isContinuous() ? frame.depth : frame.depth.clone();
    const auto* first = depth.ptr<std::uint16_t>();
    out.putList(std::vector<std::uint16_t>(first, first + depth.total()));
}

LiveFrame readFrame(Reader& in) {
    LiveFrame frame;
    frame.stamp_s = in.get<double>();
    frame.lost = in.get<bool>();
    frame.T_world_cam = in.getPose();
    frame.keyframe = in.get<int>();
    frame.camera = in.get<Camera>();
    frame.features = in.getList<LiveFeature>();
    frame.statistics = in.getList<LiveStatistic>();
    frame.color_jpeg = in.getList<unsigned char>();
    frame.depth_step = in.get<int>();
    frame.depth_unit_m = in.get<double>();
    const int columns = in.get<int>();
    const auto depth = in.getList<std::uint16_t>();
    if (depth.empty()) return frame;
    if (columns <= 0 || depth.size() % static_cast<std::size_t>(columns) != 0) {
        throw Error("a live message has a depth image of no shape");
    }
    frame.depth = cv::Mat(depth, true).reshape(1, static_cast<int>(depth.size()) / columns);
    return frame;
}

void writeEdges(Writer& out, const std::vector<std::pair<int, int>>& edges) {
    std::vector<int> ends;
    for (const auto& [from, to] : edges) ends.insert(ends.end(), {from, to});
    out.putList(ends);
}

std::vector<std::pair<int, int>> readEdges(Reader& in, std::size_t keyframes) {
    const auto ends = in.getList<int>();
    std::vector<std::pair<int, int>> edges;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        for (const int end : {ends[i], ends[i + 1]}) {
            if (end < 0 || static_cast<std::size_t>(end) >= keyframes)
                throw Error("a live message has an edge to nowhere");
        }
        edges.emplace_back(ends[i], ends[i + 1]);
    }
    return edges;
}

LiveMap readMap(Reader& in) {
    LiveMap map;
    map.path = in.getTrajectory();
    map.keyframes = in.getTrajectory();
    map.loops = readEdges(in, map.keyframes.size());
    map.covisibility = readEdges(in, map.keyframes.size());
    return map;
}

void write(Writer& out, const LiveMap& map) {
    out.put(map_tag);
    out.putTrajectory(map.path);
    out.putTrajectory(map.keyframes);
    writeEdges(out, map.loops);
    writeEdges(out, map.covisibility);
}

cv::Mat everyNth(const cv::Mat& image, int step) {
    cv::Mat small((image.rows + step - 1) / step, (image.cols + step - 1) / step, image.type());
    for (int y = 0; y < small.rows; ++y) {
        for (int x = 0; x < small.cols; ++x) {
            std::memcpy(small.ptr(y, x), image.ptr(y * step, x * step), image.elemSize());
        }
    }
    return small;
}

/** Of the images whose pixels are every n-th of the camera's. */
Camera reduced(Camera camera, const cv::Size& size, int step) {
    camera.width = size.width;
    camera.height = size.height;
    for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value /= step;
    return camera;
}

}  // namespace

void putImages(const RgbdImage& image, LiveFrame& frame) {
    frame.depth_step = std::max(1, (image.depth.cols + widest_px - 1) / widest_px);
    frame.depth_unit_m = image.depth_unit_m;
    frame.depth = everyNth(image.depth, frame.depth_step);
    cv::imencode(".jpg", everyNth(image.color, frame.depth_step), frame.color_jpeg,
                 {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
}

LiveImages imagesOf(const LiveFrame& frame) {
    LiveImages images;
    if (!frame.color_jpeg.empty()) {
        images.color = cv::imdecode(frame.color_jpeg, cv::IMREAD_COLOR);
    }
    images.depth = frame.depth;
    if (images.color.empty() || images.color.size() != images.depth.size() ||
        frame.depth_step < 1) {
        throw Error("a live message has no usable images");
    }
    images.camera = reduced(frame.camera, images.depth.size(), frame.depth_step);
    return images;
}

std::string encode(const LiveMessage& message) {
    Writer out;
    std::visit([&](const auto& content) { write(out, content); }, message);
    return out.take();
}

LiveMessage decode(const std::string& bytes) {
    Reader in(bytes);
    const auto tag = in.get<std::uint8_t>();
    if (tag != frame_tag && tag != map_tag) throw Error("a live message is of an unknown kind");
    LiveMessage message;
    if (tag == frame_tag) {
        message = readFrame(in);
    } else {
        message = readMap(in);
    }
    in.finish();
    return message;
}

}  // namespace rgbd_graphslam
