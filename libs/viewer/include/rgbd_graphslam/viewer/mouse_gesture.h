/** What a hand does with the mouse. */
#pragma once
#include <Eigen/Core>
#include <chrono>

namespace rgbd_graphslam {

/** Tells drags from clicks and clicks from double clicks. Positions are in pixels of any size. */
class MouseGesture {
  public:
    using TimePoint = std::chrono::steady_clock::time_point;
    enum class Button { Left, Other };
    enum class Drag { None, Turn, Move };
    enum class Click { None, Single, Double };

    void press(const Eigen::Vector2i& pixel, Button button);
    bool pressed() const { return pressed_; }
    /** \param pixel where the mouse is now
     *  \param shift lets the left button move, too */
    Drag drag(const Eigen::Vector2i& pixel, bool shift);
    Click release(TimePoint now);

  private:
    bool pressed_ = false, dragged_ = false;
    Button button_ = Button::Left;
    Eigen::Vector2i start_ = Eigen::Vector2i::Zero();
    TimePoint last_click_;
};

}  // namespace rgbd_graphslam
