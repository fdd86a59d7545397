#include "frame_source.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "depth_confidence.h"
#include "no_reading_check.h"
#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/image_file.h"
#include "rgbd_graphslam/dataset/mrpt_conversions.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::string sizeText(cv::Size size) {
    return std::to_string(size.width) + "x" + std::to_string(size.height);
}

cv::Size sizeOf(const Intrinsics& camera) {
    return {camera.width, camera.height};
}

bool sameAspect(cv::Size a, cv::Size b) {
    return std::int64_t{a.width} * b.height == std::int64_t{b.width} * a.height;
}

std::string valuesText(const Intrinsics& camera) {
    return "resolution = [" + std::to_string(camera.width) + " " + std::to_string(camera.height) +
           "], fx = " + shortest(camera.fx) + ", fy = " + shortest(camera.fy) +
           ", cx = " + shortest(camera.cx) + ", cy = " + shortest(camera.cy);
}

[[noreturn]] void refuseSize(const std::string& file, cv::Size size, cv::Size expected) {
    throw Error(
        "'" + file + "' has " + sizeText(size) + " pixels, the camera " + sizeText(expected),
        "give a calibration for images of " + sizeText(size) + " with --camera FILE.ini");
}

/** The calibration for images of this size; `note` says when it was another. */
Intrinsics fitted(const Intrinsics& camera, const std::string& name, const std::string& file,
                  cv::Size size, std::vector<std::string>& notes) {
    if (size == sizeOf(camera)) return camera;
    const auto resized = resizedTo(camera, size.width, size.height);
    if (!resized) refuseSize(file, size, sizeOf(camera));
    notes.push_back("the calibration '" + name + "' is for " + sizeText(sizeOf(camera)) +
                    ", the images have " + sizeText(size) + " pixels: taken as resized, " +
                    valuesText(*resized));
    return *resized;
}

}  // namespace

FrameSource::FrameSource(const RgbdSequence& sequence, const CameraSetup& setup,
                         const ImportOptions& options, const std::vector<FramePair>& pairs)
    : sequence_(sequence),
      masks_(sequence.folder, options.mask_file),
      labels_(sequence.folder),
      setup_(setup),
      depth_setup_(options.depth_camera) {
    fitSizes(pairs);
    if (sequence.no_reading != 0) no_reading_.push_back(sequence.no_reading);
    if (!options.no_reading) {
        findNoReading(pairs);
    } else if (*options.no_reading != 0) {
        no_reading_.push_back(*options.no_reading);
    }
    if (!depth_setup_) return;
    const SE3 T_color_depth = T_optical_from_mrpt * setup_.T_base_sensor.inverse() *
                              depth_setup_->T_base_sensor * T_optical_from_mrpt.inverse();
    registration_.emplace(depth_setup_->camera, setup_.camera, T_color_depth,
                          depth_setup_->depthUnitInMetres());
    setup_.depth_units = depth_setup_->depth_units;
    setup_.depth_scale = depth_setup_->depth_scale;
    setup_.depth_units_assumed = depth_setup_->depth_units_assumed;
}

double FrameSource::depthUnits() const {
    return 1 / (depth_setup_ ? *depth_setup_ : setup_).depthUnitInMetres();
}

std::string FrameSource::pathOf(const ListedImage& image) const {
    return fs::path(sequence_.folder) / image.file;
}

/** Goes by the first pair that is whole; damaged ones are told of when they are loaded. */
void FrameSource::fitSizes(const std::vector<FramePair>& pairs) {
    constexpr std::size_t most_damaged = 20;
    depth_size_ = sizeOf(depth_setup_ ? depth_setup_->camera : setup_.camera);
    for (std::size_t i = 0; i < std::min(pairs.size(), most_damaged); ++i) {
        const std::string color_file = pathOf(pairs[i].color), depth_file = pathOf(pairs[i].depth);
        const DecodedImage color = readColorImage(color_file),
                           depth = readDepthImage(depth_file, depthUnits());
        if (!color.damage.empty() || !depth.damage.empty()) continue;
        fitColor(color_file, color.pixels.size());
        fitDepth(depth_file, depth.pixels.size());
        return;
    }
}

void FrameSource::fitColor(const std::string& file, cv::Size size) {
    setup_.camera = fitted(setup_.camera, setup_.name, file, size, notes_);
}

void FrameSource::fitDepth(const std::string& file, cv::Size size) {
    depth_size_ = size;
    const cv::Size color_size = sizeOf(setup_.camera);
    if (depth_setup_) {
        depth_setup_->camera = fitted(depth_setup_->camera, depth_setup_->name, file, size, notes_);
    } else if (size != color_size) {
        if (!sameAspect(size, color_size)) {
            throw Error("'" + file + "' has " + sizeText(size) + " pixels, color " +
                            sizeText(color_size) + ", which is no common aspect ratio",
                        "give the depth camera's calibration with --register camera_depth.ini");
        }
        notes_.push_back("depth of " + sizeText(size) + " pixels is resampled to color's " +
                         sizeText(color_size) + ", each pixel taking the nearest reading");
    }
}

void FrameSource::findNoReading(const std::vector<FramePair>& pairs) {
    constexpr std::size_t frames_looked_at = 10;
    NoReadingCheck check((depth_setup_ ? *depth_setup_ : setup_).depthUnitInMetres());
    const std::size_t stride = std::max<std::size_t>(1, pairs.size() / frames_looked_at);
    for (std::size_t i = 0; i < pairs.size(); i += stride) {
        DecodedImage depth = readDepthImage(pathOf(pairs[i].depth), depthUnits());
        if (!depth.damage.empty()) continue;
        for (const std::uint16_t value : no_reading_) depth.pixels.setTo(0, depth.pixels == value);
        check.add(depth.pixels);
    }
    const auto found = check.finding();
    if (!found) return;
    no_reading_.push_back(found->value);
    notes_.push_back(found->text());
}

LoadedFrame FrameSource::load(const FramePair& pair) const {
    const std::string color_file = pathOf(pair.color), depth_file = pathOf(pair.depth);
    DecodedImage color = readColorImage(color_file),
                 depth = readDepthImage(depth_file, depthUnits());
    std::string damage = color.damage.empty() ? depth.damage : color.damage;
    if (damage.empty()) damage = dropUnconfident(sequence_, pair.depth.file, depth.pixels);
    if (!damage.empty()) return {color_file, {}, {}, damage, false, {}, {}};
    const cv::Size color_size = sizeOf(setup_.camera);
    if (color.pixels.size() != color_size) refuseSize(color_file, color.pixels.size(), color_size);
    if (depth.pixels.size() != depth_size_)
        refuseSize(depth_file, depth.pixels.size(), depth_size_);
    for (const std::uint16_t value : no_reading_) depth.pixels.setTo(0, depth.pixels == value);
    if (registration_) {
        depth.pixels = (*registration_)(depth.pixels);
    } else if (depth_size_ != color_size) {
        cv::resize(depth.pixels, depth.pixels, color_size, 0, 0, cv::INTER_NEAREST_EXACT);
    }
    return {color_file,
            color.pixels,
            depth.pixels,
            {},
            depth.converted,
            masks_.of(pair.color.file, color_size),
            labels_.of(pair.color.file, color_size)};
}

}  // namespace rgbd_graphslam
