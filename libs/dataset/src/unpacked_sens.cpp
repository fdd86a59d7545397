#include "rgbd_graphslam/dataset/unpacked_sens.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/progress.h"
#include "rgbd_graphslam/dataset/image_output.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr std::uint32_t known_version = 4, largest_side_px = 1 << 13;
constexpr std::uint64_t most_image_bytes = std::uint64_t{1} << 28, most_name_bytes = 1 << 16;

enum class ColorCompression : std::int32_t { Png = 1, Jpeg = 2 };
enum class DepthCompression : std::int32_t { Raw = 0, Zlib = 1 };

using Matrix = std::array<float, 16>;  // row by row

/** A `.sens` file read from front to back. */
class SensFile {
  public:
    explicit SensFile(const std::string& path) : path_(path), in_(path, std::ios::binary) {
        std::error_code failure;
        size_ = fs::file_size(path, failure);
        if (!in_ || failure) throw Error("cannot read '" + path + "'", "check the name");
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("'" + path_ + "' " + why, "fetch the scene again");
    }

    template <class Number>
    Number next() {
        Number number;
        readInto(&number, sizeof number);
        return number;
    }

    /** \param most what a sound file has at most */
    std::string nextBytes(std::uint64_t count, std::uint64_t most) {
        if (count > most || count > left()) refuse("is cut off or damaged at " + place());
        std::string bytes(static_cast<std::size_t>(count), '\0');
        readInto(bytes.data(), bytes.size());
        return bytes;
    }

    std::uint64_t left() { return size_ - static_cast<std::uint64_t>(in_.tellg()); }

    void atFrame(std::uint64_t frame) { frame_ = "frame " + std::to_string(frame); }
    const std::string& place() const { return frame_; }

  private:
    void readInto(void* bytes, std::size_t count) {
        in_.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count));
        if (!in_) refuse("is cut off or damaged at " + place());
    }

    std::string path_, frame_ = "its header";
    std::ifstream in_;
    std::uint64_t size_ = 0;
};

struct SensHeader {
    Matrix color_intrinsic, color_extrinsic, depth_intrinsic, depth_extrinsic;
    std::int32_t color_compression, depth_compression;
    std::uint32_t color_width, color_height, depth_width, depth_height;
    float depth_units;
    std::uint64_t frames;
};

SensHeader headerOf(SensFile& file) {
    if (file.next<std::uint32_t>() != known_version) file.refuse("is not a .sens file of version 4");
    file.nextBytes(file.next<std::uint64_t>(), most_name_bytes);
    SensHeader header;
    for (Matrix* matrix : {&header.color_intrinsic, &header.color_extrinsic,
                           &header.depth_intrinsic, &header.depth_extrinsic}) {
        *matrix = file.next<Matrix>();
    }
    header.color_compression = file.next<std::int32_t>();
    header.depth_compression = file.next<std::int32_t>();
    for (std::uint32_t* side :
         {&header.color_width, &header.color_height, &header.depth_width, &header.depth_height}) {
        *side = file.next<std::uint32_t>();
        if (*side == 0 || *side > largest_side_px) file.refuse("has images of an impossible size");
    }
    header.depth_units = file.next<float>();
    header.frames = file.next<std::uint64_t>();
    if (!(header.depth_units > 0) || !std::isfinite(header.depth_units)) {
        file.refuse("has no usable depth unit");
    }
    const auto color = static_cast<ColorCompression>(header.color_compression);
    const auto depth = static_cast<DepthCompression>(header.depth_compression);
    if (color != ColorCompression::Png && color != ColorCompression::Jpeg) {
        file.refuse("has color images that are neither JPEG nor PNG");
    }
    if (depth != DepthCompression::Raw && depth != DepthCompression::Zlib) {
        file.refuse("has depth in a compression that is not read (only zlib or none)");
    }
    return header;
}

CameraSetup cameraOf(const SensFile& file, const Matrix& K, std::uint32_t width,
                     std::uint32_t height, double depth_units) {
    CameraSetup setup;
    setup.name = ".sens";
    setup.camera = {static_cast<int>(width), static_cast<int>(height), K[0], K[5], K[2], K[6], {}};
    setup.depth_units = depth_units;
    const bool usable = K[0] > 0 && K[5] > 0 && std::isfinite(K[0] * K[5]);
    if (!usable || !std::isfinite(K[2] + K[6])) file.refuse("has no usable intrinsics");
    return setup;
}

/** Frames that could not be placed have infinite poses. */
std::optional<SE3> poseOf(const Matrix& m) {
    for (const float number : m) {
        if (!std::isfinite(number)) return std::nullopt;
    }
    const Eigen::Matrix3d R =
        (Eigen::Matrix3d() << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]).finished();
    const bool rotation =
        (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 0.01 && R.determinant() > 0;
    if (!rotation) return std::nullopt;
    return SE3{orthonormalized(R), {m[3], m[7], m[11]}};
}

cv::Mat depthOf(const SensFile& file, const SensHeader& header, const std::string& bytes) {
    cv::Mat depth(static_cast<int>(header.depth_height), static_cast<int>(header.depth_width),
                  CV_16UC1);
    const auto expected = static_cast<uLongf>(depth.total() * depth.elemSize());
    if (static_cast<DepthCompression>(header.depth_compression) == DepthCompression::Raw) {
        if (bytes.size() != expected) file.refuse("has depth of a wrong size at " + file.place());
        std::memcpy(depth.data, bytes.data(), bytes.size());
        return depth;
    }
    uLongf unpacked = expected;
    const int status =
        uncompress(depth.data, &unpacked, reinterpret_cast<const Bytef*>(bytes.data()),
                   static_cast<uLong>(bytes.size()));
    if (status != Z_OK || unpacked != expected) {
        file.refuse("has damaged depth at " + file.place());
    }
    return depth;
}

void writeBytes(const fs::path& path, const std::string& bytes) {
    std::ofstream out(path, std::ios::binary);
    if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
        throw Error("cannot write '" + path.string() + "'", "check free space");
    }
}

std::string frameName(std::uint64_t frame) {
    char text[32];
    std::snprintf(text, sizeof text, "%06llu", static_cast<unsigned long long>(frame));
    return text;
}

class Unpacking {
  public:
    Unpacking(const std::string& sens, const std::string& folder, double rate_hz)
        : file_(sens), header_(headerOf(file_)), folder_(folder), rate_hz_(rate_hz) {
        sequence_.folder = folder;
        sequence_.camera = cameraOf(file_, header_.color_intrinsic, header_.color_width,
                                    header_.color_height, header_.depth_units);
        const CameraSetup depth = cameraOf(file_, header_.depth_intrinsic, header_.depth_width,
                                           header_.depth_height, header_.depth_units);
        if (header_.depth_intrinsic != header_.color_intrinsic ||
            header_.depth_width != header_.color_width) {
            sequence_.depth_camera = depth;
        }
        fs::create_directories(folder_ / "rgb");
        fs::create_directories(folder_ / "depth");
    }

    RgbdSequence run() {
        constexpr std::uint64_t least_frame_bytes = 96;
        if (header_.frames > file_.left() / least_frame_bytes) {
            file_.refuse("is cut off: it should have " + std::to_string(header_.frames) +
                         " frames");
        }
        if (header_.frames == 0) file_.refuse("holds no frame");
        Progress progress("unpacking", static_cast<std::size_t>(header_.frames));
        for (std::uint64_t frame = 0; frame < header_.frames; ++frame) {
            file_.atFrame(frame);
            unpack(frame);
            progress.update(static_cast<std::size_t>(frame + 1));
        }
        setStamps();
        if (!sequence_.truth.empty()) {
            sequence_.notes.push_back(
                "ground truth: the poses in the file, which ScanNet estimated from the images");
        }
        return std::move(sequence_);
    }

  private:
    void unpack(std::uint64_t frame) {
        const auto pose = poseOf(file_.next<Matrix>());
        stamps_us_.push_back(file_.next<std::uint64_t>());
        file_.next<std::uint64_t>();  // of depth, taken at once
        const auto color_bytes = file_.next<std::uint64_t>();
        const auto depth_bytes = file_.next<std::uint64_t>();
        const bool jpeg =
            static_cast<ColorCompression>(header_.color_compression) == ColorCompression::Jpeg;
        const std::string color = "rgb/" + frameName(frame) + (jpeg ? ".jpg" : ".png");
        const std::string depth = "depth/" + frameName(frame) + ".png";
        writeBytes(folder_ / color, file_.nextBytes(color_bytes, most_image_bytes));
        const cv::Mat readings =
            depthOf(file_, header_, file_.nextBytes(depth_bytes, most_image_bytes));
        if (!writeImageFile((folder_ / depth).string(), readings)) {
            throw Error("cannot write '" + (folder_ / depth).string() + "'", "check free space");
        }
        sequence_.color.push_back({0, color});
        sequence_.depth.push_back({0, depth});
        if (pose) sequence_.truth.push_back({static_cast<double>(frame), *pose});
    }

    /** Stamps are microseconds, but many files have none, or all the same. */
    void setStamps() {
        bool rising = stamps_us_.back() < std::uint64_t{1} << 56;
        for (std::size_t i = 1; i < stamps_us_.size(); ++i) {
            rising &= stamps_us_[i] > stamps_us_[i - 1];
        }
        const auto stampOf = [&](std::size_t frame) {
            return rising ? static_cast<double>(stamps_us_[frame]) * 1e-6
                          : static_cast<double>(frame) / rate_hz_;
        };
        for (std::size_t i = 0; i < stamps_us_.size(); ++i) {
            sequence_.color[i].stamp_s = sequence_.depth[i].stamp_s = stampOf(i);
        }
        for (auto& pose : sequence_.truth) {
            pose.stamp_s = stampOf(static_cast<std::size_t>(pose.stamp_s));
        }
        if (rising) return;
        sequence_.notes.push_back("the file has no timestamps: frames are taken at " +
                                  shortest(rate_hz_) + " frames/s (--rate)");
    }

    SensFile file_;
    SensHeader header_;
    fs::path folder_;
    double rate_hz_;
    std::vector<std::uint64_t> stamps_us_;
    RgbdSequence sequence_;
};

}  // namespace

bool isSens(const std::string& path) {
    return fs::path(path).extension() == ".sens" && fs::is_regular_file(path);
}

UnpackedSens::UnpackedSens(const std::string& sens, const std::string& scratch, double rate_hz)
    : folder_((fs::path(scratch) / "unpacked").string()),
      sequence_(Unpacking(sens, folder_.path(), rate_hz).run()) {}

}  // namespace rgbd_graphslam
