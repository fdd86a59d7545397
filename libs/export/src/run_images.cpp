#include "run_images.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/mapping/keyframe_reader.h"

namespace rgbd_graphslam {
namespace {

cv::Matx33d matrixOf(const Camera& camera) {
    return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

bool equal(const Camera& a, const Camera& b) {
    return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
           a.cx == b.cx && a.cy == b.cy && a.distortion == b.distortion;
}

/** Removes one camera's distortion from many images. */
class Undistorter {
  public:
    explicit Undistorter(const Camera& camera)
        : seen_by_(camera), undistorted_(undistortedCamera(camera)) {
        if (!camera.hasDistortion()) return;
        const auto& d = camera.distortion;
        cv::initUndistortRectifyMap(matrixOf(camera), cv::Vec<double, 5>(d.data()), {},
                                    matrixOf(undistorted_), {camera.width, camera.height}, CV_32FC1,
                                    map_x_, map_y_);
    }

    const Camera& seenBy() const { return seen_by_; }
    const Camera& undistorted() const { return undistorted_; }

    /** \param interpolation of OpenCV; depth must not be mixed across edges */
    cv::Mat operator()(const cv::Mat& image, int interpolation) const {
        if (map_x_.empty()) return image;
        cv::Mat result;
        cv::remap(image, result, map_x_, map_y_, interpolation);
        return result;
    }

  private:
    Camera seen_by_, undistorted_;
    cv::Mat map_x_, map_y_;
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

    std::size_t read(const std::string& rawlog, const std::vector<NumberedKeyframe>& poses) {
        if (poses.empty()) return 0;
        Trajectory trajectory;
        for (const NumberedKeyframe& pose : poses) trajectory.push_back(pose.pose);
        return forEachKeyframe(rawlog, trajectory, label_, [&](const Keyframe3D& frame) {
            pass(frame, poses[frame.index].number);
        });
    }

  private:
    void pass(const Keyframe3D& frame, int number) {
        if (!undistorter_) undistorter_.emplace(frame.camera);
        if (!equal(frame.camera, undistorter_->seenBy())) {
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
    const auto readUpTo = [&](int end, const std::string& rawlog) {
        const auto stop = std::find_if(begin, placed.end(),
                                       [&](const NumberedKeyframe& k) { return k.number >= end; });
        read += reader.read(rawlog, {begin, stop});
        begin = stop;
    };
    for (const EarlierSession& session : run.earlier) {
        session_end += static_cast<int>(session.keyframes);
        readUpTo(session_end, session.rawlog);
    }
    readUpTo(static_cast<int>(run.keyframes.size()), run.rawlog);
    return read;
}

}  // namespace

Camera undistortedCamera(const Camera& camera) {
    if (!camera.hasDistortion()) return camera;
    // The largest rectangle inside the outline of what was seen.
    double left = -1e9, right = 1e9, top = -1e9, bottom = 1e9;
    const int w = camera.width - 1, h = camera.height - 1;
    for (int v = 0; v <= h; ++v) {
        left = std::max(left, camera.undistort({0., v}).x());
        right = std::min(right, camera.undistort({w, v}).x());
    }
    for (int u = 0; u <= w; ++u) {
        top = std::max(top, camera.undistort({u, 0.}).y());
        bottom = std::min(bottom, camera.undistort({u, h}).y());
    }
    Camera result = camera;
    result.distortion = {};
    const double scale_x = w / (right - left), scale_y = h / (bottom - top);
    result.fx = camera.fx * scale_x;
    result.fy = camera.fy * scale_y;
    result.cx = (camera.cx - left) * scale_x;
    result.cy = (camera.cy - top) * scale_y;
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
    return reader.read(run.rawlog, frames);
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
