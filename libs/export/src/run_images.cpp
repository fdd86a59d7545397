#include "run_images.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/mapping/recorded_images.h"

namespace rgbd_graphslam {
namespace {

/** Removes one camera's distortion from many images. */
class Undistorter {
  public:
    explicit Undistorter(const Camera& camera)
        : seen_by_(camera), undistorted_(undistortedCamera(camera)) {
        if (!camera.hasDistortion()) return;
        cv::Mat2f map(camera.height, camera.width);
        for (int v = 0; v < map.rows; ++v) {
            for (int u = 0; u < map.cols; ++u) {
                const Eigen::Vector2d seen = camera.project(undistorted_.unproject(u, v, 1));
                map(v, u) = {static_cast<float>(seen.x()), static_cast<float>(seen.y())};
            }
        }
        map_ = map;
    }

    const Camera& seenBy() const { return seen_by_; }
    const Camera& undistorted() const { return undistorted_; }

    /** \param interpolation of OpenCV; depth must not be mixed across edges */
    cv::Mat operator()(const cv::Mat& image, int interpolation) const {
        if (map_.empty()) return image;
        cv::Mat result;
        cv::remap(image, result, map_, {}, interpolation);
        return result;
    }

  private:
    Camera seen_by_, undistorted_;
    cv::Mat map_;  // of pixels to where the sensor saw them
};

cv::Mat colorOf(const RgbdImage& image) {
    if (!image.color.empty()) return image.color;
    cv::Mat color;
    cv::cvtColor(image.gray, color, cv::COLOR_GRAY2BGR);
    return color;
}

/** Images of one list of poses after another, all of one camera. */
class ImageReader {
  public:
    ImageReader(std::string label, const std::function<void(const RunImage&)>& consume)
        : label_(std::move(label)), consume_(consume) {}

    std::size_t read(const KeyframeImages& images, const std::vector<NumberedKeyframe>& poses) {
        if (poses.empty()) return 0;
        Trajectory trajectory;
        for (const NumberedKeyframe& pose : poses) trajectory.push_back(pose.pose);
        return images.forEach(trajectory, label_, [&](const Keyframe3D& frame) {
            pass(frame, poses[frame.index].number);
        });
    }

  private:
    void pass(const Keyframe3D& frame, int number) {
        if (!undistorter_) undistorter_.emplace(frame.camera);
        if (frame.camera.intrinsics() != undistorter_->seenBy().intrinsics()) {
            throw Error("the images of this run are of cameras with different calibrations",
                        "export runs of one camera only");
        }
        consume_({number, frame.pose, undistorter_->undistorted(),
                  (*undistorter_)(colorOf(frame.image), cv::INTER_LINEAR),
                  (*undistorter_)(frame.image.depth, cv::INTER_NEAREST), frame.image.depth_unit_m});
    }

    std::string label_;
    const std::function<void(const RunImage&)>& consume_;
    std::optional<Undistorter> undistorter_;
};

std::size_t readKeyframes(const MapInputs& run, ImageReader& reader) {
    const auto placed = placedKeyframes(run);
    auto begin = placed.begin();
    int session_end = 0;
    std::size_t read = 0;
    const auto readUpTo = [&](int end, const RecordedCamera& camera) {
        const auto stop = std::find_if(begin, placed.end(),
                                       [&](const NumberedKeyframe& k) { return k.number >= end; });
        read += reader.read(RecordedImages(camera), {begin, stop});
        begin = stop;
    };
    for (const EarlierSession& session : run.earlier) {
        session_end += static_cast<int>(session.keyframes);
        readUpTo(session_end, {session.rawlog, session.sensor_label, session.entries});
    }
    readUpTo(static_cast<int>(run.keyframes.size()), {run.rawlog, run.sensor_label, run.entries});
    return read;
}

}  // namespace

Camera undistortedCamera(const Camera& camera) {
    if (!camera.hasDistortion()) return camera;
    // The largest rectangle inside the outline of what was seen.
    double left = -1e9, right = 1e9, top = -1e9, bottom = 1e9;
    const int w = camera.width - 1, h = camera.height - 1;
    const auto pinholePixel = [&](double u, double v) {
        return camera.fromPlane(camera.unproject(u, v, 1).head<2>());
    };
    for (int v = 0; v <= h; ++v) {
        left = std::max(left, pinholePixel(0, v).x());
        right = std::min(right, pinholePixel(w, v).x());
    }
    for (int u = 0; u <= w; ++u) {
        top = std::max(top, pinholePixel(u, 0).y());
        bottom = std::min(bottom, pinholePixel(u, h).y());
    }
    Intrinsics result = camera.intrinsics();
    result.lens = {};
    const double scale_x = w / (right - left), scale_y = h / (bottom - top);
    result.cx = (result.cx - left) * scale_x;
    result.cy = (result.cy - top) * scale_y;
    result.fx *= scale_x;
    result.fy *= scale_y;
    return result;
}

std::vector<NumberedKeyframe> placedKeyframes(const MapInputs& run) {
    std::vector<NumberedKeyframe> placed;
    for (int i = 0; i < static_cast<int>(run.keyframes.size()); ++i) {
        if (!std::binary_search(run.disconnected.begin(), run.disconnected.end(), i))
            placed.push_back({i, run.keyframes[i]});
    }
    return placed;
}

std::size_t forEachImage(const MapInputs& run, bool all_frames, const std::string& label,
                         const std::function<void(const RunImage&)>& consume) {
    checkInputs(run);
    ImageReader reader(label, consume);
    if (!all_frames) return readKeyframes(run, reader);
    std::vector<NumberedKeyframe> frames;
    for (const StampedPose& pose : run.trajectory)
        frames.push_back({static_cast<int>(frames.size()), pose});
    return reader.read(RecordedImages({run.rawlog, run.sensor_label, run.entries}), frames);
}

std::string imageName(const char* prefix, int number, const char* extension) {
    return formatted("%s_%06d.%s", prefix, number, extension);
}

void writeImage(const std::string& path, const cv::Mat& image) {
    constexpr int jpeg_quality = 95;
    writeAtomically(path, [&](const std::string& temporary) {
        return cv::imwrite(temporary, image, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality});
    });
}

}  // namespace rgbd_graphslam
