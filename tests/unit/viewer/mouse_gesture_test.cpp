#include "rgbd_graphslam/viewer/mouse_gesture.h"

#include <gtest/gtest.h>

namespace rgbd_graphslam {
namespace {

using Button = MouseGesture::Button;
using Click = MouseGesture::Click;
using Drag = MouseGesture::Drag;

MouseGesture::TimePoint at(int ms) {
    return MouseGesture::TimePoint(std::chrono::seconds(100) + std::chrono::milliseconds(ms));
}

TEST(MouseGesture, aHandThatTremblesStillClicks) {
    MouseGesture mouse;
    mouse.press({100, 100}, Button::Left);
    EXPECT_EQ(mouse.drag({102, 103}, false), Drag::None);
    EXPECT_EQ(mouse.release(at(0)), Click::Single);
    EXPECT_FALSE(mouse.pressed());
}

TEST(MouseGesture, aDragThatComesBackIsNoClick) {
    MouseGesture mouse;
    mouse.press({100, 100}, Button::Left);
    EXPECT_EQ(mouse.drag({150, 100}, false), Drag::Turn);
    EXPECT_EQ(mouse.drag({100, 100}, false), Drag::Turn);
    EXPECT_EQ(mouse.release(at(0)), Click::None);
}

TEST(MouseGesture, theOtherButtonAndShiftMove) {
    MouseGesture mouse;
    mouse.press({0, 0}, Button::Other);
    EXPECT_EQ(mouse.drag({9, 0}, false), Drag::Move);
    EXPECT_EQ(mouse.release(at(0)), Click::None);
    mouse.press({0, 0}, Button::Left);
    EXPECT_EQ(mouse.drag({9, 0}, true), Drag::Move);
}

TEST(MouseGesture, twoQuickClicksAreADoubleClick) {
    MouseGesture mouse;
    const auto click = [&](int ms) {
        mouse.press({5, 5}, Button::Left);
        return mouse.release(at(ms));
    };
    EXPECT_EQ(click(0), Click::Single);
    EXPECT_EQ(click(300), Click::Double);
    EXPECT_EQ(click(2000), Click::Single);
}

TEST(MouseGesture, withoutAButtonNothingIsDragged) {
    MouseGesture mouse;
    EXPECT_EQ(mouse.drag({50, 50}, false), Drag::None);
    EXPECT_EQ(mouse.release(at(0)), Click::None);
}

}  // namespace
}  // namespace rgbd_graphslam
