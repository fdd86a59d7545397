/** Keys and mouse of the window. */
#include <cmath>

#include "viewer_window.h"

namespace rgbd_graphslam {
namespace {

constexpr double zoom_a_notch = 0.85;

}  // namespace

std::vector<Shortcut> ViewerWindow::viewShortcuts() {
    const auto flips = [this](bool ViewerSettings::*field) {
        return [this, field] { flip(field); };
    };
    std::vector<Shortcut> shortcuts = {
        {GLFW_KEY_F, "F", "show everything", [this] { fit(); }},
        {GLFW_KEY_T, "T", "look from above", [this] { lookDown(); }},
        {GLFW_KEY_C, "C", "follow the camera", [this] { toggleFollowing(); }},
        {GLFW_KEY_H, "H", "color by height", [this] { toggleColors(); }},
    };
    // GLFW names letters by their capitals.
    for (const ViewSwitch& entry : viewSwitches()) {
        if (*entry.key)
            shortcuts.push_back({*entry.key, entry.key, entry.name, flips(entry.field)});
    }
    return shortcuts;
}

std::vector<Shortcut> ViewerWindow::toolShortcuts() {
    const auto toggles = [this](auto panel) {
        return [this, panel] {
            panels_->toggle((panels_.get()->*panel)());
            panelsChanged();
        };
    };
    return {
        {GLFW_KEY_M, "M", "measure a distance", [this] { toggleMeasuring(); }},
        {GLFW_KEY_SPACE, "Space", "play or pause the replay", [this] { play(!replay_.playing()); }},
        {GLFW_KEY_LEFT, "Left", "previous keyframe", [this] { stepKeyframe(-1); }},
        {GLFW_KEY_RIGHT, "Right", "next keyframe", [this] { stepKeyframe(1); }},
        {GLFW_KEY_END, "End", "the whole run", [this] { moveTo(std::nullopt); }},
        {GLFW_KEY_S, "S", "screenshot", [this] { takeScreenshot(); }},
        {GLFW_KEY_W, "W", "write the map to a file", toggles(&PanelSet::files)},
        {GLFW_KEY_TAB, "Tab", "hide or show the panels",
         [this] {
             panels_->toggle();
             panelsChanged();
         }},
        {GLFW_KEY_ESCAPE, "Esc", "close a dialog, stop measuring", [this] { escape(); }},
        {GLFW_KEY_F1, "? or F1", "this list", toggles(&PanelSet::help)},
        {GLFW_KEY_Q, "Q", "quit", [this] { glfwSetWindowShouldClose(glfwWindow(), 1); }},
    };
}

void ViewerWindow::connectPanels() {
    panels_->time().on_move = [this](float share) {
        replay_.moveToShare(share);
        moveTo(replay_.now());
    };
    panels_->time().on_play = [this](bool on) { play(on); };
    panels_->help().on_close = panels_->files().on_close = [this] { escape(); };
    panels_->files().on_export = [this](ExportFormat format) { exportMap(format); };
}

bool ViewerWindow::mouseButtonEvent(const Eigen::Vector2i& p, int button, bool down,
                                    int modifiers) {
    if (down) {
        if (nanogui::Screen::mouseButtonEvent(p, button, down, modifiers)) return true;
        const bool left = button == GLFW_MOUSE_BUTTON_LEFT;
        mouse_.press(p, left ? MouseGesture::Button::Left : MouseGesture::Button::Other);
        return true;
    }
    if (!mouse_.pressed()) return nanogui::Screen::mouseButtonEvent(p, button, down, modifiers);
    const Eigen::Vector2d pixel = pixelRatio() * p.cast<double>();
    const auto clicked = mouse_.release(Clock::now());
    if (clicked == MouseGesture::Click::Double && !measuring_.active()) {
        lookAt(pixel);
    } else if (clicked != MouseGesture::Click::None) {
        click(pixel);
    }
    return true;
}

bool ViewerWindow::mouseMotionEvent(const Eigen::Vector2i& p, const Eigen::Vector2i& rel,
                                    int button, int modifiers) {
    if (!mouse_.pressed()) return nanogui::Screen::mouseMotionEvent(p, rel, button, modifiers);
    const Eigen::Vector2d motion = pixelRatio() * rel.cast<double>();
    switch (mouse_.drag(p, modifiers & GLFW_MOD_SHIFT)) {
        case MouseGesture::Drag::None:
            return true;
        case MouseGesture::Drag::Turn:
            camera_.orbit(motion);
            break;
        case MouseGesture::Drag::Move:
            camera_.pan(motion, mFBSize.y());
            follow_camera_ = false;
            break;
    }
    sceneChanged();
    return true;
}

bool ViewerWindow::scrollEvent(const Eigen::Vector2i& p, const Eigen::Vector2f& rel) {
    if (nanogui::Screen::scrollEvent(p, rel)) return true;
    camera_.zoom(std::pow(zoom_a_notch, static_cast<double>(rel.y())),
                 pixelRatio() * p.cast<double>(), mFBSize);
    sceneChanged();
    return true;
}

bool ViewerWindow::keyboardEvent(int key, int, int action, int) {
    if (action == GLFW_RELEASE) return false;
    for (const Shortcut& shortcut : shortcuts_) {
        if (shortcut.key != key) continue;
        shortcut.act();
        return true;
    }
    return false;
}

bool ViewerWindow::keyboardCharacterEvent(unsigned int codepoint) {
    if (codepoint != '?') return false;
    panels_->toggle(panels_->help());
    panelsChanged();
    return true;
}

bool ViewerWindow::resizeEvent(const Eigen::Vector2i&) {
    placePanels();
    sceneChanged();
    return true;
}

}  // namespace rgbd_graphslam
