/** Saved states whose numbers are fine one by one but make no sense together. */
#include <gtest/gtest.h>

#include <functional>

#include "rgbd_graphslam/slam/dense_odometry.h"
#include "rgbd_graphslam/slam/global_bundle_adjuster.h"
#include "rgbd_graphslam/slam/map_encoding.h"
#include "rgbd_graphslam/slam/place_index.h"

namespace rgbd_graphslam {
namespace {

using Write = std::function<void(ByteWriter&)>;

std::string bytesOf(const Write& write) {
    ByteWriter out;
    write(out);
    return out.take();
}

/** A map of a living keyframe, a culled one that hangs on it, and a landmark of the living. */
SlamMap smallMap() {
    SlamMap map(1.25, 6);
    Frame frame;
    frame.keypoints.resize(1);
    frame.descriptors.resize(1);
    for (int k = 0; k < 2; ++k) map.addKeyframe(frame, SE3());
    map.addLandmark({0, 0, 1}, 0, 0);
    map.cull(1, 0);
    return map;
}

constexpr std::size_t no_dead = sizeof(std::uint32_t), one_culled = 2 * sizeof(std::uint32_t),
                      no_held = sizeof(std::uint32_t);

/** The small map, and instead of dead landmarks, culled and fixed keyframes what `write` gives. */
void loadMap(const Write& write) {
    std::string bytes = bytesOf([](ByteWriter& out) { smallMap().save(out); });
    bytes.resize(bytes.size() - no_dead - one_culled - no_held);
    bytes += bytesOf(write);
    ByteReader in(bytes);
    SlamMap map(1.25, 6);
    map.load(in, RigCameras(Camera{}));
    EXPECT_EQ(in.left(), 0u);
}

TEST(DamagedState, deadLandmarksAreDead) {
    EXPECT_NO_THROW(loadMap([](ByteWriter& out) {
        out.putCount(0);
        putNumbers({1}, out);
        out.putCount(0);
    }));
    EXPECT_THROW(loadMap([](ByteWriter& out) {
                     out.putCount(1);
                     out.putCount(0);
                     out.putCount(0);
                     putNumbers({1}, out);
                 }),
                 DamagedBytes);
}

TEST(DamagedState, culledKeyframesAreCulled) {
    for (const int keyframe : {-1, 0, 2}) {
        EXPECT_THROW(loadMap([&](ByteWriter& out) {
                         out.putCount(0);
                         putNumbers({keyframe}, out);
                     }),
                     DamagedBytes)
            << keyframe;
    }
}

TEST(DamagedState, noMoreKeyframesAreHeldThanThereAre) {
    for (const std::uint32_t held : {0u, 2u, 3u}) {
        const auto load = [&] {
            loadMap([&](ByteWriter& out) {
                out.putCount(0);
                putNumbers({1}, out);
                out.putCount(held);
            });
        };
        if (held <= 2) {
            EXPECT_NO_THROW(load()) << held;
        } else {
            EXPECT_THROW(load(), DamagedBytes);
        }
    }
}

void loadPlaces(std::size_t keyframes, std::uint32_t forgotten, std::uint32_t splits_at,
                std::uint32_t swept = 0) {
    const std::string bytes = bytesOf([&](ByteWriter& out) {
        out.putCount(keyframes);
        for (std::size_t k = 0; k < keyframes; ++k) putFlag(true, out);
        for (int tree = 0; tree < 4; ++tree) {
            out.putCount(swept);
            out.putCount(1);
            out.put<std::int16_t>(-1);
            out.put(splits_at);
            out.put(forgotten);
        }
        out.putCount(0);
    });
    ByteReader in(bytes);
    PlaceIndex index(40);
    index.load(in, 3);
    EXPECT_TRUE(index.query({Descriptor{}}).empty());
}

TEST(DamagedState, placesAreOfKeyframesThatAreThere) {
    EXPECT_NO_THROW(loadPlaces(3, 0, 80));
    EXPECT_THROW(loadPlaces(4, 0, 80), DamagedBytes);
}

/** Each as an entry would take 160 GB. */
TEST(DamagedState, forgottenPlacesTakeNoMemory) {
    EXPECT_NO_THROW(loadPlaces(3, 0xffffffff, 0xffffffff));
    EXPECT_THROW(loadPlaces(3, 81, 80), DamagedBytes);
}

TEST(DamagedState, placesAreSweptWhereThereAreNodes) {
    EXPECT_THROW(loadPlaces(3, 0, 80, 1), DamagedBytes);
}

TEST(DamagedState, smallImagesAreOfTheCamera) {
    const std::string bytes = bytesOf([](ByteWriter& out) {
        putFlag(false, out);
        put(Intrinsics{2, 1, 1, 1, 0, 0, {}}, out);
        for (int image = 0; image < 2; ++image) {
            out.putCount(2);
            for (int pixel = 0; pixel < 2; ++pixel) out.put(1.0f);
        }
        for (int reckoning = 0; reckoning < 3; ++reckoning) putFlag(false, out);
        for (int pose = 0; pose < 2; ++pose) encodePose(SE3(), out);
        for (int stamp = 0; stamp < 2; ++stamp) out.put(1.0);
    });
    DenseOdometry tracker;
    ByteReader good(bytes), bad(bytes);
    EXPECT_NO_THROW(tracker.load(good, Intrinsics{2, 1, 1, 1, 0, 0, {}}));
    EXPECT_EQ(good.left(), 0u);
    EXPECT_THROW(tracker.load(bad, Intrinsics{80, 60, 1, 1, 0, 0, {}}), DamagedBytes);
}

TEST(DamagedState, adjustmentsEndAndAreOfSomething) {
    const SlamOptions options;
    const RigCameras cameras{Camera()};
    SlamMap map = smallMap();
    const auto load = [&](std::uint32_t iterations, std::size_t free) {
        const std::string bytes = bytesOf([&](ByteWriter& out) {
            putFlag(true, out);
            out.put(iterations);
            putNumbers({0}, out);
            putNumbers({}, out);
            putNumbers({}, out);
            out.putCount(map.keyframes().size());
            out.putCount(free);
            encodePose(SE3(), out);
        });
        GlobalBundleAdjuster adjuster(options, cameras, map);
        ByteReader in(bytes);
        adjuster.load(in);
        adjuster.applyPendingAdjustment();
    };
    EXPECT_NO_THROW(load(5, 1));
    EXPECT_THROW(load(0x7fffffff, 1), DamagedBytes);
    EXPECT_THROW(load(5, 0), DamagedBytes);
}

TEST(DamagedState, countsLeaveRoomToCountOn) {
    for (const std::int32_t count : {-1, 0x7fffffff}) {
        const std::string bytes = bytesOf([&](ByteWriter& out) { out.put(count); });
        ByteReader in(bytes);
        EXPECT_THROW(getTally(in), DamagedBytes) << count;
    }
}

}  // namespace
}  // namespace rgbd_graphslam
