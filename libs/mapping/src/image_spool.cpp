#include "rgbd_graphslam/mapping/image_spool.h"

#include <utility>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/stereo_frame.h"

namespace rgbd_graphslam {
using mrpt::obs::CObservation;
namespace {

constexpr std::size_t longest_queue = 256;

/** Ends the writing of a file that is not wanted any more. */
class GivenUp : public std::exception {};

}  // namespace

ImageSpool::ImageSpool(const std::string& path)
    : spooled_(path), queue_(longest_queue), writer_([this] { write(); }) {}

ImageSpool::~ImageSpool() {
    queue_.close();
    if (writer_.joinable()) writer_.join();
}

void ImageSpool::write() {
    try {
        writeRawlog(spooled_.rawlog, RawlogStorage::Embedded, [this](RawlogWriter& writer) {
            while (const auto observation = queue_.pop()) {
                if (!*observation) return;  // the end
                writer.write(**observation);
            }
            throw GivenUp();
        });
    } catch (const GivenUp&) {
        return;
    } catch (...) {
        failure_ = std::current_exception();
    }
    queue_.close();
}

bool ImageSpool::push(CObservation::Ptr observation) {
    ++entries_;
    return queue_.push(std::move(observation));
}

bool ImageSpool::note(CObservation::Ptr reading) {
    return push(std::move(reading));
}

bool ImageSpool::add(const mrpt::obs::CObservation3DRangeScan::Ptr& frame) {
    spooled_.sensor_label = frame->sensorLabel;
    spooled_.entries.push_back({toSeconds(frame->timestamp), entries_});
    const auto stereo = std::dynamic_pointer_cast<StereoFrame>(frame);
    if (stereo) return push(stereo->pair());
    return push(frame);
}

RecordedCamera ImageSpool::finish() {
    queue_.push(nullptr);
    writer_.join();
    if (failure_) std::rethrow_exception(failure_);
    return spooled_;
}

}  // namespace rgbd_graphslam
