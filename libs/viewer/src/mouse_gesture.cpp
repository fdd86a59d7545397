#include "rgbd_graphslam/viewer/mouse_gesture.h"

#include <utility>

namespace rgbd_graphslam {
namespace {

/** A hand that clicks may tremble so far. */
constexpr double slack_px = 4;
constexpr std::chrono::milliseconds double_click(400);

}  // namespace

void MouseGesture::press(const Eigen::Vector2i& pixel, Button button) {
    pressed_ = true;
    dragged_ = false;
    button_ = button;
    start_ = pixel;
}

MouseGesture::Drag MouseGesture::drag(const Eigen::Vector2i& pixel, bool shift) {
    if (!pressed_) return Drag::None;
    dragged_ |= (pixel - start_).cast<double>().norm() > slack_px;
    if (!dragged_) return Drag::None;
    return button_ == Button::Left && !shift ? Drag::Turn : Drag::Move;
}

MouseGesture::Click MouseGesture::release(TimePoint now) {
    const bool clicked = std::exchange(pressed_, false) && !dragged_ && button_ == Button::Left;
    if (!clicked) return Click::None;
    const auto since_last = now - std::exchange(last_click_, now);
    return since_last < double_click ? Click::Double : Click::Single;
}

}  // namespace rgbd_graphslam
