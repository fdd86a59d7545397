#include "rgbd_graphslam/slam/dense_odometry.h"

#include "rgbd_graphslam/slam/dense_alignment.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

/** An image that shares less with the anchor becomes the next one. */
constexpr double anchor_overlap = 0.7;
/** Longest that turning alone is followed; walking on is not seen by a gyroscope. */
constexpr double longest_gyroscope_s = 0.3;
/** Longer ago, the last motion says nothing about the next. */
constexpr double longest_inertia_s = 0.2;
/** Longest that images are compared without any sensor saying that the camera is still there. */
constexpr double longest_blind_s = 1.0;
constexpr double least_depth_share = 0.25;
/** Of anything on wheels, beyond what a late reading may add. */
constexpr double fastest_m_s = 15, fastest_rad_s = 10, late_m = 0.1, late_rad = 0.1;

void put(const std::vector<float>& pixels, ByteWriter& out) {
    out.putCount(pixels.size());
    for (const float pixel : pixels) out.put(pixel);
}

std::vector<float> getPixels(ByteReader& in, std::size_t count) {
    constexpr float largest = 1e6;
    std::vector<float> pixels(in.getCount(sizeof(float)));
    if (pixels.size() != count) throw DamagedBytes("an image of another size");
    for (float& pixel : pixels) pixel = getFloat(in, largest);
    return pixels;
}

void put(const DenseView& view, ByteWriter& out) {
    putFlag(view.empty(), out);
    if (view.empty()) return;
    put(view.camera, out);
    put(view.gray, out);
    put(view.depth_m, out);
}

DenseView getView(ByteReader& in, const Camera& expected) {
    DenseView view;
    if (getFlag(in)) return view;
    view.camera = getCamera(in);
    if (view.camera.width != expected.width || view.camera.height != expected.height) {
        throw DamagedBytes("an image of another camera");
    }
    const std::size_t pixels = std::size_t(view.camera.width) * view.camera.height;
    view.gray = getPixels(in, pixels);
    view.depth_m = getPixels(in, pixels);
    return view;
}

}  // namespace

std::optional<SE3> wheelMotion(const DeadReckoning& last, const DeadReckoning& now,
                               double passed_s) {
    if (!last.T_odometry_cam || !now.T_odometry_cam) return std::nullopt;
    const SE3 motion = last.T_odometry_cam->inverse() * *now.T_odometry_cam;
    if (motion.t.norm() > late_m + fastest_m_s * passed_s) return std::nullopt;
    if (motion.angle() > late_rad + fastest_rad_s * passed_s) return std::nullopt;
    return motion;
}

void DenseOdometry::restart(const Frame& frame, const SE3& T_last_cam) {
    anchor_ = frame.view;
    T_anchor_last_ = SE3();
    accept(frame, T_last_cam);
    last_fixed_s_ = frame.stamp_s;
}

void DenseOdometry::accept(const Frame& frame, const SE3& T_last_cam) {
    motion_ = {orthonormalized(T_last_cam.R), T_last_cam.t};
    last_reckoning_ = frame.reckoning;
    last_stamp_s_ = frame.stamp_s;
}

void DenseOdometry::save(ByteWriter& out) const {
    put(anchor_.valid() ? anchor_.get() : DenseView(), out);
    put(last_reckoning_, out);
    for (const SE3& pose : {T_anchor_last_, motion_}) encodePose(pose, out);
    for (const double stamp_s : {last_stamp_s_, last_fixed_s_}) out.put(stamp_s);
}

void DenseOdometry::load(ByteReader& in, const Camera& view_camera) {
    DenseView anchor = getView(in, view_camera);
    anchor_ = {};
    if (!anchor.empty()) anchor_ = std::async(std::launch::deferred, [anchor] { return anchor; });
    last_reckoning_ = getReckoning(in);
    for (SE3* pose : {&T_anchor_last_, &motion_}) *pose = decodePose(in);
    for (double* stamp_s : {&last_stamp_s_, &last_fixed_s_}) *stamp_s = getFinite(in);
}

std::optional<SE3> DenseOdometry::follow(const Frame& frame, const PossibleMotion& possible) {
    const auto predicted = predictedMotion(frame);
    std::optional<SE3> T_last_cam;
    if (predicted || frame.stamp_s - last_stamp_s_ < longest_blind_s) {
        T_last_cam = alignWithAnchor(frame, guess(frame), possible);
        if (!T_last_cam) T_last_cam = alignWithAnchor(frame, SE3(), possible);
    }
    if (T_last_cam) {
        last_fixed_s_ = frame.stamp_s;
    } else if (predicted) {
        T_last_cam = predicted;
        T_anchor_last_ = T_anchor_last_ * *predicted;
        T_anchor_last_.R = orthonormalized(T_anchor_last_.R);
        const bool seen = frame.view.valid() && frame.view.get().depthShare() > least_depth_share;
        if (wheelMotion(last_reckoning_, frame.reckoning, frame.stamp_s - last_stamp_s_)) {
            last_fixed_s_ = frame.stamp_s;
        }
        if (seen) {
            anchor_ = frame.view;
            T_anchor_last_ = SE3();
        }
    }
    if (T_last_cam) accept(frame, *T_last_cam);
    return T_last_cam;
}

SE3 DenseOdometry::guess(const Frame& frame) const {
    return predictedMotion(frame).value_or(inertia(frame));
}

SE3 DenseOdometry::inertia(const Frame& frame) const {
    return frame.stamp_s - last_stamp_s_ < longest_inertia_s ? motion_ : SE3();
}

std::optional<SE3> DenseOdometry::alignWithAnchor(const Frame& frame, const SE3& T_last_cam_guess,
                                                  const PossibleMotion& possible) {
    if (!anchor_.valid() || !frame.view.valid()) return std::nullopt;
    const auto aligned =
        alignDensely(anchor_.get(), frame.view.get(), T_anchor_last_ * T_last_cam_guess);
    if (!aligned) return std::nullopt;
    const SE3 T_last_cam = T_anchor_last_.inverse() * aligned->T_reference_view;
    if (!possible(T_last_cam)) return std::nullopt;
    T_anchor_last_ = {orthonormalized(aligned->T_reference_view.R), aligned->T_reference_view.t};
    if (aligned->overlap < anchor_overlap) {
        anchor_ = frame.view;
        T_anchor_last_ = SE3();
    }
    return T_last_cam;
}

/** By other sensors, the best of them. */
std::optional<SE3> DenseOdometry::predictedMotion(const Frame& frame) const {
    const DeadReckoning &last = last_reckoning_, &now = frame.reckoning;
    const auto rolled = wheelMotion(last, now, frame.stamp_s - last_stamp_s_);
    if (rolled) return rolled;
    if (!gyroscopeServes(frame)) return std::nullopt;
    const bool moving = frame.stamp_s - last_stamp_s_ < longest_inertia_s;
    const Eigen::Vector3d travelled = moving ? motion_.t : Eigen::Vector3d::Zero();
    return SE3(last.R_gyroscope_cam->transpose() * *now.R_gyroscope_cam, travelled);
}

bool DenseOdometry::gyroscopeServes(const Frame& frame) const {
    return last_reckoning_.R_gyroscope_cam && frame.reckoning.R_gyroscope_cam &&
           frame.stamp_s - last_fixed_s_ < longest_gyroscope_s;
}

}  // namespace rgbd_graphslam
