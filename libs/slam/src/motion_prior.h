/** Where the camera can be, by everything but the map. */
#pragma once
#include <optional>

#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/features/frame.h"

namespace rgbd_graphslam {

/** Standard deviations of a predicted camera pose. */
struct PoseSpread {
    double m = 0, rad = 0;
};

constexpr PoseSpread anywhere{1e3, 10};

/** How much larger than a room a scene is, at least 1: cars see far, and move far. */
double sceneScale(const Frame& frame);

/** What the motion since the last located frame says about a pose that the map offers. */
enum class Agreement {
    /** The motion was measured all the way, and leads there. */
    Confirmed,
    /** Possible, but other places are as well. */
    Possible,
    /** The camera cannot be there. */
    Contradicted,
};

/** The uncertainty of dead reckoning since the map located the camera last. It grows with the way
 *  where wheels or images measure the motion, and with time where nothing does. How far wheels are
 *  to be believed is measured while the map is in sight. */
class MotionPrior {
  public:
    /** The map locates a frame.
     *  \param T_last_cam motion since the frame before; nothing where that is not known, as at a
     *         start or when the camera is found again: it may be moving then */
    void restart(const Frame& frame, const std::optional<SE3>& T_last_cam);

    /** What tells the motion since the last frame where no trusted wheels do. */
    enum class Source {
        Images,
        /** It goes on as before: good for a frame. */
        Inertia,
        /** The same, though there may be wheels. */
        InertiaAlone,
        None,
    };

    /** A frame that the map does not locate. */
    void advance(const Frame& frame, const SE3& T_last_cam, Source source);

    /** \param T_predicted_cam from where dead reckoning puts the camera to where the map does */
    Agreement judge(const SE3& T_predicted_cam) const;

    const PoseSpread& spread() const { return spread_; }
    /** Of the frame that the map located last, see sceneScale(). */
    double scale() const { return scale_; }
    /** Whether every motion since the last located frame was measured. */
    bool measured() const { return measured_; }

    /** Whether the wheels give the motion since the last frame, and have agreed with the map. */
    bool wheelsTell(const Frame& frame) const;

    /** Whether wheels or gyroscope rule out a motion since the last frame. */
    bool rulesOut(const Frame& frame, const SE3& T_last_cam) const;

    void save(ByteWriter& out) const;
    /** \throws DamagedBytes */
    void load(ByteReader& in);

  private:
    std::optional<SE3> rolled(const Frame& frame) const;
    void compareWheels(const Frame& frame, const SE3& T_last_cam);
    void remember(const Frame& frame);

    PoseSpread spread_ = anywhere;
    bool measured_ = false;
    /** Whether the map located the last frame. */
    bool located_ = false;
    /** Whether the last motion is known. */
    bool velocity_known_ = false;
    double scale_ = 1;
    DeadReckoning last_;
    double last_stamp_s_ = 0;
    /** Error of the wheels as a share of the way, as seen so far. */
    double wheel_error_ = 0.03;
    /** Motion by the map and by the wheels since the two were compared last. */
    SE3 seen_, rolled_;
    double compared_m_ = 0;
};

}  // namespace rgbd_graphslam
