/** bench_soak RAWLOG FRAMES PERIOD > CSV: plays the first PERIOD frames of a rawlog, whose last
 * leads to the first again, until FRAMES frames are through, and writes what the process holds. */
#include <dirent.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"
#include "rgbd_graphslam/graphslam/graph_slam_session.h"

namespace rgbd_graphslam {
namespace {

constexpr int frames_a_row = 500;
constexpr double frame_period_s = 1.0 / 30;

double cpuMs() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1e3 * double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-3 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

double memoryMb() {
    std::ifstream statm("/proc/self/statm");
    double all = 0, resident = 0;
    statm >> all >> resident;
    return resident * 4096e-6;
}

/** What was asked for and not given back; the allocator and libraries hold more. */
double heapMb() {
    const struct mallinfo2 info = mallinfo2();
    return 1e-6 * static_cast<double>(info.uordblks + info.hblkhd);
}

long handles() {
    const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir("/proc/self/fd"), closedir);
    long count = 0;
    while (readdir(folder.get())) ++count;
    return count;
}

class Soak {
  public:
    void step(const mrpt::obs::CObservation3DRangeScan::Ptr& frame) {
        frame->timestamp = toMrptTime(1000 + frame_period_s * frames_);
        if (!session_) {
            session_ = std::make_unique<GraphSlamSession>(SlamOptions{}, *frame);
            std::puts(
                "frame,keyframes,all_keyframes,landmarks,lost,loops,"
                "memory_mb,heap_mb,handles,cpu_ms_a_frame");
        }
        lost_ += session_->step(frame).origin == FrameOrigin::Lost;
        if (++frames_ % frames_a_row == 0) writeRow();
    }
    long frames() const { return frames_; }

  private:
    void writeRow() {
        long living = 0;
        const auto keyframes = session_->slam().keyframes();
        for (const KeyframeView& keyframe : keyframes) living += !keyframe.culled;
        const double now_ms = cpuMs();
        std::printf("%ld,%ld,%zu,%zu,%ld,%zu,%.1f,%.1f,%ld,%.2f\n", frames_, living,
                    keyframes.size(), session_->slam().landmarks().size(), lost_,
                    session_->slam().loops().size(), memoryMb(), heapMb(), handles(),
                    (now_ms - last_row_ms_) / frames_a_row);
        std::fflush(stdout);
        last_row_ms_ = now_ms;
    }

    std::unique_ptr<GraphSlamSession> session_;
    long frames_ = 0, lost_ = 0;
    double last_row_ms_ = 0;
};

void soak(const std::string& rawlog, long frames, long period) {
    Soak soak;
    while (soak.frames() < frames) {
        RawlogReader reader(rawlog);
        for (long played = 0; played < period && soak.frames() < frames;) {
            const auto entry = reader.next();
            if (!entry) break;
            const auto frame = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(entry);
            if (!frame) continue;
            ++played;
            soak.step(frame);
        }
    }
}

}  // namespace
}  // namespace rgbd_graphslam

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: %s RAWLOG FRAMES PERIOD > CSV\n", *argv);
        return 2;
    }
    rgbd_graphslam::soak(argv[1], std::atol(argv[2]), std::atol(argv[3]));
    return 0;
}
