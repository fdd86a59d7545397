/** What the viewer needs of the recording, read while the window is already open. */
#pragma once
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/mapping/keyframe_images.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Images as JPEG, so that those of a long run fit into memory. */
struct KeyframePicture {
    std::size_t keyframe = 0;
    std::vector<unsigned char> color_jpeg, depth_jpeg;
    Vertices points;  // world
};

/** Reads in a thread of its own, which ends with the object. */
class RecordingLoader {
  public:
    /** \param keyframes whose images are wanted */
    RecordingLoader(std::unique_ptr<const KeyframeImages> images, Trajectory keyframes);
    ~RecordingLoader();

    struct News {
        std::vector<KeyframePicture> pictures;
        std::optional<Camera> camera;
        bool finished = false;
    };
    /** All that was read since the last call. */
    News take();

  private:
    void read();
    void readPictures();

    const std::unique_ptr<const KeyframeImages> images_;
    const Trajectory keyframes_;
    std::mutex mutex_;
    News news_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace rgbd_graphslam
