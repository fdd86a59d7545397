#include "rgbd_graphslam/dataset/rawlog_writer.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/serialization/CArchive.h>
#include <unistd.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "number_text.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

class EmbeddedWriter : public RawlogWriter {
  public:
    explicit EmbeddedWriter(const std::string& path) {
        mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(
            true);  // process-wide; its default loses pixels
        if (!file_.open(path)) throw Error("cannot open '" + path + "' for writing");
    }

    void write(mrpt::obs::CObservation& observation) override {
        mrpt::serialization::archiveFrom(file_) << observation;
    }

    void writeFrame(mrpt::obs::CObservation3DRangeScan& frame, const std::string&) override {
        write(frame);
    }

    std::uint64_t bytes() { return file_.getPosition(); }

  private:
    mrpt::io::CFileOutputStream file_;
};

class CompactWriter : public EmbeddedWriter {
  public:
    CompactWriter(const std::string& path, fs::path images)
        : EmbeddedWriter(path), images_(std::move(images)) {}

    void writeFrame(mrpt::obs::CObservation3DRangeScan& frame,
                    const std::string& color_file) override {
        const std::string name = frame.sensorLabel + "_" + stampText(toSeconds(frame.timestamp));
        storeColor(frame, name, color_file);
        frame.rangeImage_convertToExternalStorage(name + "_depth.bin", images_.string() + "/");
        write(frame);
    }

  private:
    void storeColor(mrpt::obs::CObservation3DRangeScan& frame, const std::string& name,
                    const std::string& color_file) const {
        const std::string extension =
            color_file.empty() ? ".png" : fs::path(color_file).extension().string();
        const fs::path target = images_ / (name + "_color" + extension);
        if (!color_file.empty()) {
            fs::copy_file(color_file, target);
        } else if (!cv::imwrite(target.string(), frame.intensityImage.asCvMatRef())) {
            throw Error("cannot write '" + target.string() + "'", "check free space");
        }
        frame.intensityImage = mrpt::img::CImage();
        frame.intensityImage.setExternalStorage(target.filename().string());
    }

    fs::path images_;
};

/** A folder that is removed again unless it is moved to its final name. */
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const fs::path& final_path)
        : final_(final_path),
          path_(final_path.parent_path() /
                (".tmp-" + std::to_string(getpid()) + "-" + final_path.filename().string())) {
        makeWritableFolder(path_.string());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }
    void moveToFinalName() const {
        fs::remove_all(final_);
        fs::rename(path_, final_);
    }

  private:
    fs::path final_, path_;
};

/** Streams report a full disk only when they are closed, and MRPT's not even then. */
template <class Writer, class... Arguments>
void fillFile(const std::string& path, const std::function<void(RawlogWriter&)>& fill,
              Arguments&&... arguments) {
    std::uint64_t bytes = 0;
    {
        Writer writer(path, std::forward<Arguments>(arguments)...);
        fill(writer);
        bytes = writer.bytes();
    }
    if (fs::file_size(path) != bytes) {
        throw Error("'" + path + "' was not written completely", "check free space");
    }
}

}  // namespace

void writeRawlog(const std::string& path, RawlogStorage storage,
                 const std::function<void(RawlogWriter&)>& fill) {
    const fs::path folder = fs::absolute(path).parent_path();
    makeWritableFolder(folder.string());
    if (fs::is_directory(path)) {
        throw Error("'" + path + "' is a folder", "name a file for the rawlog");
    }
    writeAtomically(path, [&](const std::string& temporary) {
        if (storage == RawlogStorage::Embedded) {
            fillFile<EmbeddedWriter>(temporary, fill);
        } else {
            const TemporaryFolder images(RawlogReader::imagesFolder(fs::absolute(path).string()));
            fillFile<CompactWriter>(temporary, fill, images.path());
            images.moveToFinalName();
        }
        return true;
    });
}

}  // namespace rgbd_graphslam
