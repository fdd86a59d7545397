#include "rgbd_graphslam/dataset/rawlog_reader.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cctype>
#include <deque>
#include <filesystem>
#include <stdexcept>

#include "gz_size.h"
#include "reading_guards.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
using mrpt::obs::CObservation;
namespace {

/** MRPT's messages are reports of many lines; the line that says what happened is enough. Bytes of
 *  a damaged file may be quoted in it. */
std::string firstMessage(const std::exception& e) {
    const std::string text = e.what(), mark = "Message:";
    const auto marked = text.rfind(mark);
    const auto from =
        marked == std::string::npos ? 0 : text.find_first_not_of(' ', marked + mark.size());
    std::string line = text.substr(from, text.find('\n', from) - from);
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
    return line;
}

/** MRPT takes less than it asked for as all of it. */
class StrictArchive : public mrpt::serialization::CArchive {
  public:
    explicit StrictArchive(mrpt::io::CFileGZInputStream& file) : file_(file) {}
    std::string getArchiveDescription() const override { return file_.getStreamDescription(); }

  protected:
    std::size_t write(const void*, std::size_t) override { return 0; }
    std::size_t read(void* bytes, std::size_t count) override {
        const std::size_t there = file_.Read(bytes, count);
        if (there > 0 && there < count) throw std::runtime_error("the file ends early");
        return there;
    }

  private:
    mrpt::io::CFileGZInputStream& file_;
};

}  // namespace

class RawlogReader::Implementation {
  public:
    explicit Implementation(const std::string& path)
        : path_(path), images_(imagesFolder(path)), gz_size_(checkedGzSize(path)) {
        if (!file_.open(path))
            throw Error("cannot open the rawlog '" + path + "'", "check the name");
        if (!readEntry() && entries_ == 0) refuse("is empty");
    }

    CObservation::Ptr next() {
        while (waiting_.empty() && readEntry()) continue;
        if (waiting_.empty()) return nullptr;
        useOwnImages();
        auto observation = waiting_.front();
        waiting_.pop_front();
        return observation;
    }

    double progress() const {
        const double total = gz_size_ ? *gz_size_ : file_.getTotalBytesCount();
        return total > 0 ? std::min(1.0, file_.getPosition() / total) : 1.0;
    }

  private:
    static std::optional<std::uint32_t> checkedGzSize(const std::string& path) {
        if (!fs::exists(path)) throw Error("there is no rawlog '" + path + "'", "check the name");
        if (fs::is_directory(path)) {
            throw Error("'" + path + "' is a folder, not a rawlog", "import it with rgbd-import");
        }
        return gzSize(path);
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("'" + path_ + "' " + why,
                    "give a rawlog of MRPT, or make one with rgbd-import");
    }

    /** \return false at the end of the file */
    bool readEntry() {
        const auto start = file_.getPosition();
        mrpt::serialization::CSerializable::Ptr entry;
        try {
            const MemoryLimit limit(mostBytesOfBlock());
            entry = StrictArchive(file_).ReadObject();
        } catch (const std::exception& e) {
            if (file_.getPosition() == start && whole()) return false;
            if (entries_ == 0) refuse("is not a rawlog");
            throw Error("rawlog '" + path_ + "' is cut off or damaged at entry " +
                            std::to_string(entries_) + ", byte " + std::to_string(start) + " (" +
                            firstMessage(e) + ")",
                        "record or import it again");
        }
        ++entries_;
        queue(entry);
        return true;
    }

    /** Blocks hold what is in the file, twice at most while they grow; how much a gz file will
     *  unpack to is not known. */
    std::size_t mostBytesOfBlock() const {
        constexpr std::size_t always = std::size_t{64} << 20, never = std::size_t{1} << 30;
        if (gz_size_) return never;
        return std::min(never, always + 2 * (file_.getTotalBytesCount() - file_.getPosition()));
    }

    bool whole() const {
        return !gz_size_ || static_cast<std::uint32_t>(file_.getPosition()) == *gz_size_;
    }

    void queue(const mrpt::serialization::CSerializable::Ptr& entry) {
        if (const auto one = std::dynamic_pointer_cast<CObservation>(entry)) {
            waiting_.push_back(one);
        } else if (const auto many = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
            if (moved_ && many->size() > 0) queueOdometry((*many->begin())->timestamp);
            waiting_.insert(waiting_.end(), many->begin(), many->end());
        } else if (const auto actions =
                       std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(entry)) {
            noteMotion(*actions);
        } else {
            refuse("is not a rawlog");
        }
    }

    /** An action is the motion since the sensory frame before. */
    void noteMotion(const mrpt::obs::CActionCollection& actions) {
        const auto motion = actions.getActionByClass<mrpt::obs::CActionRobotMovement2D>();
        if (!motion) return;
        const bool by_wheels =
            motion->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry;
        odometry_ = odometry_ + (by_wheels || !motion->poseChange
                                     ? motion->rawOdometryIncrementReading
                                     : mrpt::poses::CPose2D(motion->poseChange->getMeanVal()));
        moved_ = true;
    }

    /** The motions so far, as odometry of the moment of a sensory frame. */
    void queueOdometry(mrpt::Clock::time_point stamp) {
        const auto odometry = mrpt::obs::CObservationOdometry::Create();
        odometry->sensorLabel = "ODOMETRY";
        odometry->timestamp = stamp;
        odometry->odometry = odometry_;
        waiting_.push_back(odometry);
    }

    /** detectImagesDirectory of MRPT 2.5 drops a slash, hence our own. */
    void useOwnImages() const {
        if (mrpt::img::CImage::getImagesPathBase() != images_) {
            mrpt::img::CImage::setImagesPathBase(images_);
        }
    }

    std::string path_, images_;
    std::optional<std::uint32_t> gz_size_;
    mrpt::io::CFileGZInputStream file_;
    std::deque<CObservation::Ptr> waiting_;
    mrpt::poses::CPose2D odometry_;  // sum of all actions
    bool moved_ = false;
    std::size_t entries_ = 0;
};

RawlogReader::RawlogReader(const std::string& path)
    : impl_(std::make_unique<Implementation>(path)) {}

RawlogReader::~RawlogReader() = default;

CObservation::Ptr RawlogReader::next() {
    return impl_->next();
}

double RawlogReader::progress() const {
    return impl_->progress();
}

std::string RawlogReader::imagesFolder(const std::string& rawlog_path) {
    fs::path path(rawlog_path);
    if (path.extension() == ".gz") path.replace_extension();
    return (path.parent_path() / (path.stem().string() + "_Images")).string();
}

}  // namespace rgbd_graphslam
