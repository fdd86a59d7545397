/** What the viewer needs of the recording, read while the window is already open. */
#pragma once
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/trajectory.h"
#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** Images as JPEG, so that those of a long run fit into memory. */
struct KeyframePicture {
    std::size_t keyframe = 0;
    std::vector<unsigned char> color_jpeg, depth_jpeg;
    Vertices points;  // world
};

/** The true trajectory laid over the estimate. */
struct TrueTrajectory {
    Trajectory poses;  // in the estimate's world, while the estimate lasts
    struct ErrorLine {
        double stamp_s = 0;
        Eigen::Vector3d estimate, truth;
    };
    std::vector<ErrorLine> errors;  // one a frame, in order of time
    double rmse_m = 0;
};

/** The truth in the estimate's world, aligned as for the ATE.
 *  \throws Error when too few stamps match */
TrueTrajectory alignedTruth(const Trajectory& estimate, const Trajectory& truth);

/** Reads in a thread of its own, which ends with the object. */
class RecordingLoader {
  public:
    RecordingLoader(std::string rawlog, Trajectory keyframes, Trajectory trajectory);
    ~RecordingLoader();

    struct News {
        std::vector<KeyframePicture> pictures;
        std::optional<TrueTrajectory> truth;
        std::optional<Camera> camera;
        bool finished = false;
    };
    /** All that was read since the last call. */
    News take();

  private:
    void read();
    void readPictures();
    void readTruth();

    const std::string rawlog_;
    const Trajectory keyframes_, trajectory_;
    std::mutex mutex_;
    News news_;
    bool stop_ = false;
    std::thread thread_;
};

}  // namespace rgbd_graphslam
