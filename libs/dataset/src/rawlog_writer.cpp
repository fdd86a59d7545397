#include "rgbd_graphslam/dataset/rawlog_writer.h"

#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/io/CFileOutputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>

#include "gz_size.h"
#include "number_text.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/temporary_folder.h"
#include "rgbd_graphslam/dataset/image_output.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_reader.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** The disk does not take it. */
class WriteFailure : public std::exception {};

constexpr int small_jpeg_quality = 90, small_gz_level = 4;

/** All in one file. `Stream` is one of MRPT's for files. */
template <class Stream>
class StreamWriter : public RawlogWriter {
  public:
    template <class... Level>
    explicit StreamWriter(const std::string& path, Level... level) {
        if (!file_.open(path, level...)) throw WriteFailure();
    }

    void write(mrpt::obs::CObservation& observation) override {
        try {
            mrpt::serialization::archiveFrom(file_) << observation;
        } catch (const std::exception&) {
            throw WriteFailure();
        }
    }

    void writeFrame(mrpt::obs::CObservation3DRangeScan& frame, const std::string&) override {
        write(frame);
    }

    void writePair(mrpt::obs::CObservationStereoImages& pair, const std::string&,
                   const std::string&) override {
        write(pair);
    }

    /** Before compression. */
    std::uint64_t bytes() { return file_.getPosition(); }

  private:
    Stream file_;
};

class EmbeddedWriter : public StreamWriter<mrpt::io::CFileOutputStream> {
  public:
    explicit EmbeddedWriter(const std::string& path) : StreamWriter(path) {
        mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(true);  // process-wide
    }
};

class SmallWriter : public StreamWriter<mrpt::io::CFileGZOutputStream> {
  public:
    explicit SmallWriter(const std::string& path) : StreamWriter(path, small_gz_level) {
        mrpt::img::CImage::DISABLE_JPEG_COMPRESSION(false);
        mrpt::img::CImage::SERIALIZATION_JPEG_QUALITY(small_jpeg_quality);
    }
};

class CompactWriter : public EmbeddedWriter {
  public:
    CompactWriter(const std::string& path, fs::path images)
        : EmbeddedWriter(path), images_(std::move(images)) {}

    void writeFrame(mrpt::obs::CObservation3DRangeScan& frame,
                    const std::string& color_file) override {
        const std::string name = nameOf(frame);
        storeImage(frame.intensityImage, name + "_color", color_file);
        storeDepth(frame, name);
        write(frame);
    }

    void writePair(mrpt::obs::CObservationStereoImages& pair, const std::string& left_file,
                   const std::string& right_file) override {
        storeImage(pair.imageLeft, nameOf(pair) + "_left", left_file);
        storeImage(pair.imageRight, nameOf(pair) + "_right", right_file);
        write(pair);
    }

  private:
    static std::string nameOf(const mrpt::obs::CObservation& observation) {
        return observation.sensorLabel + "_" + stampText(toSeconds(observation.timestamp));
    }

    void storeImage(mrpt::img::CImage& image, const std::string& name,
                    const std::string& file) const {
        const std::string extension = fs::path(file).extension().string();
        const bool as_it_is = extension == ".png" || extension == ".jpg" || extension == ".jpeg";
        const fs::path target = images_ / (name + (as_it_is ? extension : ".png"));
        std::error_code failure;
        const bool stored = as_it_is ? fs::copy_file(file, target, failure)
                                     : writeImageFile(target.string(), image.asCvMatRef());
        if (!stored) throw WriteFailure();
        image = mrpt::img::CImage();
        image.setExternalStorage(target.filename().string());
    }

    void storeDepth(mrpt::obs::CObservation3DRangeScan& frame, const std::string& name) const {
        const std::string file = name + "_depth.bin";
        const auto pixel_bytes = frame.rangeImage.size() * sizeof(std::uint16_t);
        frame.rangeImage_convertToExternalStorage(file, images_.string() + "/");
        const auto stored_bytes = gzSize(images_ / file);
        if (!stored_bytes || *stored_bytes < pixel_bytes) throw WriteFailure();
    }

    fs::path images_;
};

bool holds(const std::string& path, std::uint64_t bytes) {
    const auto unpacked = gzSize(path);
    return unpacked ? *unpacked == static_cast<std::uint32_t>(bytes) : fs::file_size(path) == bytes;
}

/** Streams notice a full disk only when they are closed, and MRPT's say nothing then.
 *  \return whether the file is whole */
template <class Writer, class... Arguments>
bool fillFile(const std::string& path, const std::function<void(RawlogWriter&)>& fill,
              Arguments&&... arguments) {
    std::uint64_t bytes = 0;
    try {
        Writer writer(path, std::forward<Arguments>(arguments)...);
        fill(writer);
        bytes = writer.bytes();
    } catch (const WriteFailure&) {
        return false;
    }
    return holds(path, bytes);
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
        if (storage == RawlogStorage::Embedded) return fillFile<EmbeddedWriter>(temporary, fill);
        if (storage == RawlogStorage::Small) return fillFile<SmallWriter>(temporary, fill);
        const TemporaryFolder images(RawlogReader::imagesFolder(fs::absolute(path).string()));
        if (!fillFile<CompactWriter>(temporary, fill, images.path())) return false;
        images.moveToFinalName();
        return true;
    });
}

}  // namespace rgbd_graphslam
