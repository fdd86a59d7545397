/** Keyframes, landmarks and who sees what. */
#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/features/frame.h"
#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/slam/rig_cameras.h"

namespace rgbd_graphslam {

constexpr int no_landmark = -1;

/** Where a landmark is seen. */
struct Observation {
    int keyframe = 0;
    int keypoint = 0;
};

/** How the keyframe that found a landmark saw it: what later keypoints are aligned with. */
struct LandmarkPatch {
    Patch patch;
    int octave = 0;
    int camera = 0;
};

/** A point of the world that keyframes see. Its appearance is that of the latest keyframe that saw
 *  it, which is the view nearest to what tracking will meet. */
struct Landmark {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world, m
    /** Unit vector from the landmark to the camera that saw it last. */
    Eigen::Vector3d view_direction = Eigen::Vector3d::UnitZ();
    /** Distance at which it would be seen on pyramid level 0, m. */
    double level0_distance = 1;
    Descriptor descriptor{};
    /** None where the keyframe that found it had no patches. */
    std::shared_ptr<const LandmarkPatch> patch;
    std::vector<Observation> observations;  // by rising keyframe
    int first_keyframe = 0;
    /** Frames that should have seen it, and did. */
    int times_expected = 1, times_found = 1;
    bool alive = true;
};

/** How a keyframe is tied to the one before it. */
enum class Link : std::uint8_t {
    /** By landmarks that both see. */
    Tracked,
    /** By dead reckoning. */
    DeadReckoned,
    /** Not at all: the camera was lost, the recording is another, or known views lie between. */
    None,
};

/** A frame that is submap, with the landmarks it sees. */
struct Keyframe {
    int id = 0;
    Frame frame;
    SE3 T_cam_world;
    /** One entry per keypoint: landmark or no_landmark. */
    std::vector<int> landmarks;
    /** A culled keyframe keeps its place relative to the living keyframe `parent`. */
    bool culled = false;
    int parent = -1;
    SE3 T_cam_parent;
    /** Keyframes of one submap have known poses to each other. */
    int submap = 0;
    /** To the keyframe before, id - 1. */
    Link link = Link::Tracked;
};

/** Number of landmarks that two keyframes share. */
struct Covisibility {
    int keyframe = 0;
    int shared = 0;
};

/** The sparse map. Keeps both directions of every observation consistent; all methods that change
 *  it go through it. Ids count from 0 without gaps. A keyframe's is never used again; a landmark's
 *  is two keyframes after its death, so that a map of one place stops growing. */
class SlamMap {
  public:
    /** \param scale_factor between pyramid levels; \param levels of the pyramid */
    SlamMap(double scale_factor, int levels);
    /** Takes up a map that was kept. \param landmarks living ones, consistent with the keyframes */
    void restore(std::vector<Keyframe> keyframes, std::vector<Landmark> landmarks);

    /** All of it, to the bit. */
    void save(ByteWriter& out) const;
    /** \param cameras that the keyframes are of
     *  \throws DamagedBytes */
    void load(ByteReader& in, const RigCameras& cameras);

    /** The frame's small image is dropped; its patches stay for addLandmark() until the next.
     *  \param submap of the map that it belongs to */
    int addKeyframe(Frame frame, const SE3& T_cam_world, int submap = 0, Link link = Link::Tracked);
    /** Moves a submap as a whole and makes it one with another.
     *  \param T_new_old maps its world coordinates to where they belong */
    void mergeSubmap(int submap, int into, const SE3& T_new_old);
    /** Seen first by a keypoint that is free. */
    int addLandmark(const Eigen::Vector3d& position, int keyframe, int keypoint);
    /** The keypoint must be free and the landmark not yet seen by the keyframe. */
    void addObservation(int landmark, int keyframe, int keypoint);
    /** What a frame was found to see becomes the keyframe's; landmarks that have died since are
     * left out. \param landmarks one entry per keypoint, no_landmark where none was found */
    void addObservations(const std::vector<int>& landmarks, int keyframe);
    /** A landmark that loses its last observation dies. */
    void removeObservation(int landmark, int keyframe);
    void removeLandmark(int landmark);
    /** Gives the observations of `from` to `into` and removes `from`. */
    void fuse(int from, int into);
    void setPosition(int landmark, const Eigen::Vector3d& position) {
        landmarks_[landmark].position = position;
    }
    /** Moves a landmark in the world, and the direction from which it was seen last with it. */
    void moveLandmark(int landmark, const SE3& T_new_old);
    /** A frame should have seen the landmark. */
    void noteExpected(int landmark) { ++landmarks_[landmark].times_expected; }
    /** A frame has seen it. */
    void noteFound(int landmark) { ++landmarks_[landmark].times_found; }
    /** Takes a keyframe out of the map; its pose, and those that were tied to it, are tied to
     *  `parent`, which lives. */
    void cull(int keyframe, int parent);
    /** The keyframes that there are keep their poses from now on. */
    void freeze() { fixed_ = keyframes_.size(); }

    const std::vector<Keyframe>& keyframes() const { return keyframes_; }
    const std::vector<Landmark>& landmarks() const { return landmarks_; }
    const Keyframe& keyframe(int id) const { return keyframes_[id]; }
    const Landmark& landmark(int id) const { return landmarks_[id]; }
    std::size_t aliveLandmarks() const { return alive_; }
    /** Number of keyframes, the first ones, that freeze() fixed. */
    int fixedCount() const { return static_cast<int>(fixed_); }
    /** Whether a keyframe keeps its pose: the first always does. */
    bool isFixed(int keyframe) const { return keyframe == 0 || keyframe < fixedCount(); }
    /** Keyframes that cull() took out, in that order. */
    const std::vector<int>& culled() const { return culled_; }

    /** Of culled keyframes too. */
    SE3 T_cam_world(int keyframe) const;
    void setPose(int keyframe, const SE3& T_cam_world);

    /** Keypoint by which a keyframe sees a landmark, or -1. */
    int keypointOf(int landmark, int keyframe) const;
    /** Living keyframes that share at least `fewest` landmarks, most first, then by id. */
    std::vector<Covisibility> covisible(int keyframe, int fewest = 15) const;
    /** The same for any set of landmarks; entries of no_landmark are passed over. */
    std::vector<Covisibility> observers(const std::vector<int>& landmarks, int fewest = 1) const;

    double scaleOf(int octave) const { return scale_[octave]; }
    /** Pyramid level on which a landmark at a distance (m) is expected, not clamped. */
    int expectedOctave(const Landmark& landmark, double distance) const;
    int levels() const { return static_cast<int>(scale_.size()); }

  private:
    /** Sets a keypoint free. */
    void release(const Observation& o);
    void refreshAppearance(int landmark);
    void bury(int landmark);
    void loadDead(ByteReader& in);
    int freeLandmark();

    std::vector<double> scale_;
    double log_scale_factor_;
    std::vector<Keyframe> keyframes_;
    std::vector<Landmark> landmarks_;
    std::size_t alive_ = 0;
    std::size_t fixed_ = 0;
    /** Dead landmarks and the number of keyframes at their death. */
    std::deque<std::pair<int, std::size_t>> dead_;
    std::vector<int> culled_;
    mutable std::vector<int> votes_;  // one per keyframe, all zero between calls
};

}  // namespace rgbd_graphslam
