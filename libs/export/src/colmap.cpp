#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>

#include "colmap_model.h"
#include "formats.h"
#include "landmark_tracks.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/mapping/run_folder.h"
#include "run_images.h"
#include "run_points.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_points = 500000;
constexpr std::size_t shortest_track = 2;

/** Numbers of keyframes by the number of the image that shows them. */
using KeyframeOfImage = std::map<int, int>;

/** Frames of the run's own rawlog that are keyframes, known by their stamps. */
KeyframeOfImage keyframesAmongFrames(const MapInputs& run) {
    constexpr double same_s = 1e-6;  // both files round to it
    std::size_t first = 0;
    for (const EarlierSession& session : run.earlier) first += session.keyframes;
    KeyframeOfImage keyframes;
    for (const NumberedKeyframe& keyframe : placedKeyframes(run)) {
        if (keyframe.number < static_cast<int>(first)) continue;
        const auto frame = std::lower_bound(
            run.trajectory.begin(), run.trajectory.end(), keyframe.pose.stamp_s - same_s,
            [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
        if (frame == run.trajectory.end() || frame->stamp_s > keyframe.pose.stamp_s + same_s)
            continue;
        keyframes[static_cast<int>(frame - run.trajectory.begin())] = keyframe.number;
    }
    return keyframes;
}

/** Observations by keyframe, of landmarks that several of the exported images show. */
class TrackedPoints {
  public:
    TrackedPoints(const std::vector<LandmarkTrack>& tracks, const std::vector<bool>& exported) {
        for (const LandmarkTrack& track : tracks) {
            std::vector<TrackElement> seen;
            for (const TrackElement& element : track.seen) {
                const auto keyframe = static_cast<std::size_t>(element.keyframe);
                if (keyframe < exported.size() && exported[keyframe]) seen.push_back(element);
            }
            if (seen.size() < shortest_track) continue;
            for (const TrackElement& element : seen)
                in_keyframe_[element.keyframe].push_back({points_.size(), element.direction});
            points_.push_back({track.position, {}});
        }
    }

    /** Features of an image, which also gives the points their color. */
    std::vector<ColmapFeature> featuresIn(const RunImage& image, int keyframe) {
        std::vector<ColmapFeature> features;
        for (const auto& [point, direction] : in_keyframe_[keyframe]) {
            const Camera& c = image.camera;
            const Eigen::Vector2d pixel = c.fromPlane(direction);
            if (!c.contains(pixel)) continue;
            const cv::Vec3b bgr = image.color(static_cast<int>(std::lround(pixel.y())),
                                              static_cast<int>(std::lround(pixel.x())));
            points_[point].rgb = {bgr[2], bgr[1], bgr[0]};
            features.push_back({pixel, point});
        }
        return features;
    }

    std::vector<ColmapPoint> take() { return std::move(points_); }

  private:
    std::map<int, std::vector<std::pair<std::size_t, Eigen::Vector2d>>> in_keyframe_;
    std::vector<ColmapPoint> points_;
};

/** Removing distortion cuts off borders, and with them features. */
void dropShortTracks(ColmapModel& model) {
    std::vector<std::size_t> length(model.points.size()), number(model.points.size());
    for (const ColmapImage& image : model.images) {
        for (const ColmapFeature& feature : image.features) ++length[feature.point];
    }
    std::vector<ColmapPoint> kept;
    for (std::size_t i = 0; i < length.size(); ++i) {
        number[i] = kept.size();
        if (length[i] >= shortest_track) kept.push_back(model.points[i]);
    }
    model.points = std::move(kept);
    for (ColmapImage& image : model.images) {
        std::vector<ColmapFeature> features;
        for (const ColmapFeature& feature : image.features) {
            if (length[feature.point] >= shortest_track)
                features.push_back({feature.pixel, number[feature.point]});
        }
        image.features = std::move(features);
    }
}

std::vector<ColmapPoint> densePoints(const std::string& run_folder) {
    std::vector<ColmapPoint> points;
    for (const MapPoint& point : readRunPoints(run_folder, most_points))
        points.push_back({point.position.cast<double>(), point.rgb});
    return points;
}

class ColmapExporter : public Exporter {
  public:
    const char* name() const override { return "colmap"; }
    const char* about() const override {
        return "undistorted images and sparse text model for COLMAP";
    }
    const char* fileName() const override { return "colmap"; }
    bool writesFolder() const override { return true; }

    std::string write(const std::string& run_folder, const ExportOptions& options,
                      const std::string& path) const override {
        const fs::path out(path);
        const MapInputs run = readRunFolder(run_folder, options.rawlog);
        const auto tracks = readLandmarkTracks(run_folder);
        ColmapModel model;
        if (!tracks) {
            model.points = densePoints(run_folder);
            sayWarning("'" + run_folder +
                       "' has no map.sparse: points3D.txt has the points of points.ply, without "
                       "the images that show them");
        }
        fs::create_directories(out / "images");
        addImages(run, options, tracks.value_or(std::vector<LandmarkTrack>()), out, model);
        writeModel(model, out / "sparse");
        return std::to_string(model.images.size()) + " images, " +
               std::to_string(model.points.size()) + (tracks ? " points with tracks" : " points");
    }

  private:
    static void addImages(const MapInputs& run, const ExportOptions& options,
                          const std::vector<LandmarkTrack>& tracks, const fs::path& out,
                          ColmapModel& model) {
        KeyframeOfImage keyframe_of;
        if (options.all_frames) {
            keyframe_of = keyframesAmongFrames(run);
        } else {
            for (const auto& keyframe : placedKeyframes(run))
                keyframe_of[keyframe.number] = keyframe.number;
        }
        std::vector<bool> exported(run.keyframes.size());
        for (const auto& [image, keyframe] : keyframe_of) exported[keyframe] = true;
        TrackedPoints tracked(tracks, exported);
        forEachImage(run, options.all_frames, "colmap", [&](const RunImage& image) {
            model.camera = image.camera;
            ColmapImage entry{imageName("frame", image.number, "jpg"), image.pose.T_world_cam, {}};
            const auto keyframe = keyframe_of.find(image.number);
            if (keyframe != keyframe_of.end())
                entry.features = tracked.featuresIn(image, keyframe->second);
            writeImage((out / "images" / entry.name).string(), image.color);
            model.images.push_back(std::move(entry));
        });
        if (tracks.empty()) return;
        model.points = tracked.take();
        dropShortTracks(model);
    }

    static void writeModel(const ColmapModel& model, const fs::path& folder) {
        fs::create_directories(folder);
        writeTextAtomically((folder / "cameras.txt").string(), colmapCameras(model));
        writeTextAtomically((folder / "images.txt").string(), colmapImages(model));
        writeTextAtomically((folder / "points3D.txt").string(), colmapPoints(model));
    }
};

}  // namespace

std::unique_ptr<const Exporter> colmapExporter() {
    return std::make_unique<ColmapExporter>();
}

}  // namespace rgbd_graphslam
