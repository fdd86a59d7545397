/** TUM folder to rawlog. */
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rgbd_graphslam/dataset/camera_file.h"
#include "rgbd_graphslam/dataset/depth_statistics.h"
#include "rgbd_graphslam/dataset/lag_check.h"
#include "rgbd_graphslam/dataset/lens_check.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/dataset/registration_check.h"
#include "rgbd_graphslam/dataset/rgbd_sequence.h"

namespace rgbd_graphslam {

/** What to import, and how images are paired. */
struct ImportOptions {
    /** Color and depth further apart than this are no pair, s. */
    double max_difference_s = 0.02;
    /** Added to depth's stamps before. */
    double depth_offset_s = 0;
    RawlogStorage storage = RawlogStorage::Embedded;
    /** A listed file that is missing is an error, and so is what ImportReport::warnings would say:
     *  nothing is written then. */
    bool strict = false;
    /** Fewer pairs than half of the shorter list are no error. */
    bool allow_loss = false;
    /** Depth readings of this value are none; 0: all are readings. Unset: found out where a value
     *  stands out. */
    std::optional<std::uint16_t> no_reading;
    /** Frames whose image is damaged are left out and counted instead of an error. */
    bool skip_damaged = false;
    /** The camera that took the depth images, when they are not registered to color: they are
     *  warped then. Its pose and the color camera's on the robot tell how they lie to each other;
     *  its depth unit is that of the images. */
    std::optional<CameraSetup> depth_camera;
    /** Image that is black where every frame is ignored, such as the robot's own arm; empty: the
     *  sequence's mask.png, if it has one. */
    std::string mask_file;
    /** Threads that decode images. */
    int threads = 2;
};

/** What became of the images of one list. */
struct ImageTally {
    std::size_t listed = 0, missing = 0, repeated = 0;
    /** As the list has it. */
    std::string first_missing;
    /** No image of the other kind near enough. */
    std::size_t no_partner = 0;
    /** All images of the other kind that are near enough went to nearer ones. */
    std::size_t partner_taken = 0;
    /** Stamps earlier than the line before; they are sorted. */
    std::size_t backwards = 0;

    std::size_t leftOver() const { return missing + repeated + no_partner + partner_taken; }
};

/** What was written and what was left out. */
struct ImportReport {
    ImageTally color, depth;
    /** Frames written, and pairs left out because an image of theirs is damaged. */
    std::size_t frames = 0, damaged = 0;
    std::size_t imu = 0, odometry = 0, truth = 0, others = 0;
    /** The sequence's notes, and what the import changed. */
    std::vector<std::string> notes;
    /** What is probably wrong with the recording or its calibration, with the value that would be
     *  right; also said by sayWarning. */
    std::vector<std::string> warnings;
    /** Depth over the whole recording. */
    DepthSummary depth_summary;
    /** How depth lies against color, and by how much it is late: at most one of them, the one that
     *  explains the images better. Nothing when it lies well or nothing can be told. */
    std::optional<Misregistration> misregistration;
    std::optional<DepthLag> depth_lag;
    /** Distortion that the calibration leaves in the color images; never of a fisheye's. */
    std::optional<LensDistortion> lens_distortion;
    /** Stamps of the first and last frame, UNIX time. */
    double first_stamp_s = 0, last_stamp_s = 0;
    /** Between two frames that follow each other. */
    double longest_gap_s = 0;
    /** Duration of the import. */
    double seconds = 0;
};

/** A few lines for the user. */
std::string toText(const ImportReport& report);

/** Writes color and depth pairs (stamped by color), accelerometer and gyroscope, odometry and
 *  ground truth to a rawlog, in order of time over all sensors. Depth keeps its bits; its own
 *  stamps are kept as DepthStamps. Shows progress.
 *  Calibrations made for images an exact number of times as large or small are resized; depth of
 *  another size but the same aspect ratio is resampled to color's without interpolation.
 *  \throws Error when nothing can be paired, more than half would be lost, the calibration cannot
 * be right, an image is of the wrong kind or size, a damaged or (if strict) missing image is met,
 * or the rawlog cannot be written */
ImportReport importSequence(const RgbdSequence& sequence, const CameraSetup& setup,
                            const std::string& rawlog_path, const ImportOptions& options);

}  // namespace rgbd_graphslam
