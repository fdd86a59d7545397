/** A SLAM that is saved and loaded goes on as if nothing had been, to the bit. */
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "rgbd_graphslam/slam/visual_slam.h"
#include "synthetic_world.h"

namespace rgbd_graphslam {
namespace {

constexpr double pi = 3.14159265358979;

void step(VisualSlam& slam, const Frame& frame) {
    const TrackedFrame tracked = slam.track(frame);
    if (tracked.keyframe) slam.closeLoops(*tracked.keyframe);
}

std::string saved(const VisualSlam& slam) {
    ByteWriter out;
    slam.save(out);
    return out.bytes();
}

std::unique_ptr<VisualSlam> loaded(const std::string& bytes, const SlamOptions& options) {
    auto slam = std::make_unique<VisualSlam>(options, Camera{});
    ByteReader in(bytes);
    slam->load(in);
    EXPECT_EQ(in.left(), 0u);
    return slam;
}

bool sameFrames(const VisualSlam& a, const VisualSlam& b) {
    const auto left = a.frames(), right = b.frames();
    return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                      [](const TrackedFrame& l, const TrackedFrame& r) {
                          return l.stamp_s == r.stamp_s && l.origin == r.origin &&
                                 l.T_world_cam.R == r.T_world_cam.R &&
                                 l.T_world_cam.t == r.T_world_cam.t && l.inliers == r.inliers &&
                                 l.keyframe == r.keyframe && l.submap == r.submap;
                      });
}

/** One run is never interrupted; another is saved and loaded again every `interval` frames. */
void expectTheSame(const std::vector<Frame>& film, int interval, std::unique_ptr<VisualSlam> whole,
                   const SlamOptions& options = {}) {
    auto broken = loaded(saved(*whole), options);
    for (std::size_t i = 0; i < film.size(); ++i) {
        step(*whole, film[i]);
        step(*broken, film[i]);
        if (i % interval == 0) broken = loaded(saved(*broken), options);
    }
    EXPECT_TRUE(saved(*whole) == saved(*broken));
    whole->finish();
    broken->finish();
    EXPECT_TRUE(sameFrames(*whole, *broken));
    EXPECT_TRUE(saved(*whole) == saved(*broken));
}

void expectTheSame(const std::vector<Frame>& film, int interval, const SlamOptions& options = {}) {
    expectTheSame(film, interval, std::make_unique<VisualSlam>(options, Camera{}), options);
}

class Film {
  public:
    Film& show(const SE3& T_world_cam) {
        frames_.push_back(world_.view(T_world_cam, nextStamp(), camera_));
        return *this;
    }
    Film& turn(double from, double to, int frames) {
        for (int i = 0; i < frames; ++i) show(onCircle(from + (to - from) * i / frames));
        return *this;
    }
    Film& cover(int frames, bool with_odometry = false) {
        for (int i = 0; i < frames; ++i) {
            Frame frame;
            frame.grid = KeypointGrid({}, camera_.width, camera_.height);
            frame.stamp_s = nextStamp();
            if (with_odometry) frame.reckoning.T_odometry_cam = onCircle(0.001 * i);
            frames_.push_back(frame);
        }
        return *this;
    }
    const std::vector<Frame>& frames() const { return frames_; }

  private:
    double nextStamp() const { return 0.033 * (frames_.size() + 1); }

    Camera camera_;
    SyntheticWorld world_{24000};
    std::vector<Frame> frames_;
};

TEST(SavedSlam, goesOnInEveryFrame) {
    expectTheSame(Film().turn(0, 0.4 * pi, 45).frames(), 1);
}

TEST(SavedSlam, goesOnThroughALoop) {
    Film film;
    film.turn(0, 2.3 * pi, 260);
    VisualSlam slam(SlamOptions{}, Camera{});
    for (const Frame& frame : film.frames()) step(slam, frame);
    ASSERT_FALSE(slam.loops().empty());
    expectTheSame(film.frames(), 17);
}

TEST(SavedSlam, goesOnWhereKeyframesAndLandmarksGo) {
    Film film;
    for (int i = 0; i < 2 * 80; ++i) film.show(onCircle(pi / 4 * (1 - std::cos(2 * pi * i / 80))));
    SlamOptions dense;
    dense.keyframes.max_translation_ratio = dense.keyframes.min_translation_ratio;
    dense.keyframes.max_rotation_rad = dense.keyframes.min_rotation_rad;
    VisualSlam slam(dense, Camera{});
    for (const Frame& frame : film.frames()) step(slam, frame);
    const auto keyframes = slam.keyframes();
    ASSERT_GT(std::count_if(keyframes.begin(), keyframes.end(),
                            [](const KeyframeView& k) { return k.culled; }),
              5);
    expectTheSame(film.frames(), 12, dense);
}

TEST(SavedSlam, goesOnWhileLostAndInANewPart) {
    Film film;
    film.turn(0, 0.3 * pi, 50).cover(10).turn(pi, 2.2 * pi, 200);
    VisualSlam slam(SlamOptions{}, Camera{});
    for (const Frame& frame : film.frames()) step(slam, frame);
    ASSERT_FALSE(slam.loops().empty());
    expectTheSame(film.frames(), 9);
}

TEST(SavedSlam, goesOnWithWeakMotion) {
    Film film;
    film.turn(0, 0.2 * pi, 30).cover(20, true).turn(0.1 * pi, 0.3 * pi, 30);
    expectTheSame(film.frames(), 1);
}

TEST(SavedSlam, goesOnInAMapThatIsExtended) {
    Film first, second;
    first.turn(0, 0.3 * pi, 50);
    second.turn(0.2 * pi, 0.6 * pi, 60);
    VisualSlam slam(SlamOptions{}, Camera{});
    for (const Frame& frame : first.frames()) step(slam, frame);
    slam.finish();
    expectTheSame(
        second.frames(), 4,
        std::make_unique<VisualSlam>(SlamOptions{}, Camera{}, slam.snapshot(), MapUse::Extend));
}

TEST(SavedSlam, refusesBytesThatEndEarly) {
    const Film film = Film().turn(0, 0.1 * pi, 15);
    VisualSlam slam(SlamOptions{}, Camera{});
    for (const Frame& frame : film.frames()) step(slam, frame);
    const std::string bytes = saved(slam);
    for (int percent = 0; percent < 100; percent += 3) {
        const std::string cut = bytes.substr(0, bytes.size() * percent / 100);
        VisualSlam other(SlamOptions{}, Camera{});
        ByteReader in(cut);
        EXPECT_THROW(other.load(in), DamagedBytes) << percent;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
