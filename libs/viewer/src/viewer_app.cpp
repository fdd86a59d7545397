#include "rgbd_graphslam/viewer/viewer_app.h"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/core/process_usage.h"
#include "viewer_window.h"

namespace rgbd_graphslam {
namespace {

std::string glfw_complaint;

/** The window system; its errors are ours to report. */
class Glfw {
  public:
    Glfw() {
        glfwSetErrorCallback([](int, const char* text) { glfw_complaint = text; });
        if (!glfwInit()) {
            throw Error(
                "no window can be opened (" + glfw_complaint + ")",
                "call from a desktop or over ssh -X, or use --snapshot for a picture without one");
        }
        glfwSetTime(0);
    }
    ~Glfw() { glfwTerminate(); }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

nanogui::ref<ViewerWindow> makeWindow(const ViewerSettings& settings, const std::string& title) {
    try {
        return new ViewerWindow(settings, title);
    } catch (const Error&) {
        throw;
    } catch (const std::exception&) {
        const char* attempt = std::getenv("LIBGL_ALWAYS_INDIRECT") ? "unset LIBGL_ALWAYS_INDIRECT"
                                                                   : "try LIBGL_ALWAYS_SOFTWARE=1";
        throw Error("the display offers no OpenGL 3.3 (" + glfw_complaint + ")",
                    std::string(attempt) + ", or use --snapshot");
    }
}

/** Of a viewer beside a running SLAM: a second thread of Mesa's software renderer gains little. */
void drawWithOneThread() {
    ::setenv("LP_NUM_THREADS", "1", 0);
}

/** From now on the viewer takes only time that is left over. On Linux each thread has a priority
 *  of its own. */
void stepBack() {
    constexpr int lowest_priority = 19;
    const sched_param none{};
    std::error_code gone;  // a thread may end meanwhile
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", gone)) {
        const int id = std::stoi(thread.path().filename());
        ::setpriority(PRIO_PROCESS, static_cast<id_t>(id), lowest_priority);
        ::sched_setscheduler(id, SCHED_IDLE, &none);  // makes room at once when another wakes up
    }
    // Linux weighs whole sessions against each other first. One that is shared with rgbd-slam must
    // not be slowed, so this needs a session of its own.
    if (::getsid(0) == ::getpid() || ::setsid() > 0)
        std::ofstream("/proc/self/autogroup") << lowest_priority;
}

void reportSpeed(ViewerWindow& window, double seconds) {
    window.spin(0.3 * seconds);  // until the number of points has adapted
    const double cpu_before_s = processCpuSeconds();
    const double rate = window.spin(seconds);
    const double cpu_s = processCpuSeconds() - cpu_before_s;
    sayInfo(formatted("%zu points, %zu in a moving picture, %.1f pictures/s, %.1f ms CPU a picture",
                      window.points(), window.pointsDrawn(), rate, 1e3 * cpu_s / (rate * seconds)));
}

void runUntilClosed(ViewerWindow& window, const ViewerJob& job) {
    bool stands_back = !job.follow;
    while (!glfwWindowShouldClose(window.glfwWindow())) {
        const double wait_s = window.update();
        if (window.settled() && job.benchmark_s > 0) return reportSpeed(window, job.benchmark_s);
        if (window.settled() && !job.screenshot.empty())
            return window.saveScreenshot(job.screenshot);
        // Not before: on a busy machine the window would take a minute to come up.
        if (!stands_back && window.showsRun()) {
            stepBack();
            stands_back = true;
        }
        glfwWaitEventsTimeout(wait_s);
    }
}

}  // namespace

void runViewer(const ViewerJob& job) {
    const auto start = std::filesystem::file_time_type::clock::now();
    if (job.follow) drawWithOneThread();
    const Glfw glfw;
    RunData run;
    if (!job.follow) run = loadRun(job.path);
    const std::string path = settingsPath();
    nanogui::ref<ViewerWindow> window = makeWindow(loadSettings(path), "rgbd-viewer: " + job.path);
    window->setVisible(true);
    if (job.follow) {
        window->follow(job.path, start);
    } else {
        window->open(std::move(run));
    }
    runUntilClosed(*window, job);
    if (job.screenshot.empty() && job.benchmark_s == 0) saveSettings(path, window->settings());
}

}  // namespace rgbd_graphslam
