#include "rgbd_graphslam/mapping/scan_rawlog.h"

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <optional>

#include "rgbd_graphslam/dataset/mrpt_conversions.h"
#include "rgbd_graphslam/dataset/rawlog_writer.h"
#include "rgbd_graphslam/mapping/depth_timing.h"
#include "rgbd_graphslam/mapping/level_scan.h"
#include "rgbd_graphslam/mapping/recorded_images.h"

namespace rgbd_graphslam {
namespace {

Trajectory spacedOut(const Trajectory& poses, double per_second) {
    constexpr double jitter_s = 1e-3;
    Trajectory spaced;
    for (const StampedPose& pose : poses) {
        const bool due =
            spaced.empty() || pose.stamp_s > spaced.back().stamp_s + 1 / per_second - jitter_s;
        if (due) spaced.push_back(pose);
    }
    return spaced;
}

mrpt::obs::CObservationComment provenance(double stamp_s) {
    mrpt::obs::CObservationComment comment;
    comment.timestamp = toMrptTime(stamp_s);
    comment.text =
        "DEPTH_SCAN: level scans made of depth images. BASE_ODOMETRY: motion of the base below the "
        "camera in the run's trajectory.txt, visual and with its loops closed; no wheels.";
    return comment;
}

mrpt::obs::CObservationOdometry odometry(const SE3& T_up_base) {
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = "BASE_ODOMETRY";
    odometry.odometry = mrpt::poses::CPose2D(toCPose3D(T_up_base));
    return odometry;
}

}  // namespace

std::size_t writeScans(const MapInputs& inputs, const MapOptions& options, double per_second,
                       const std::string& path) {
    const Trajectory poses = spacedOut(inputs.trajectory, per_second);
    std::size_t scans = 0;
    writeRawlog(path, RawlogStorage::Embedded, [&](RawlogWriter& rawlog) {
        std::optional<RayTable> rays;
        auto about = provenance(poses.front().stamp_s);
        rawlog.write(about);
        const RecordedImages images({inputs.rawlog, inputs.sensor_label, inputs.entries});
        scans = images.forEach(poses, "scans", [&](const Keyframe3D& frame) {
            if (!rays) rays.emplace(frame.camera);
            const SE3 T_up_cam = depthPose(frame.pose, frame.depth_stamp_s, inputs.trajectory);
            const SE3 T_up_base = basePose(T_up_cam);
            const DepthView view(frame.image, *rays, options);
            auto moved = odometry(T_up_base);
            const auto scan = levelScan(view, T_up_base.inverse() * T_up_cam, options);
            moved.timestamp = scan->timestamp = toMrptTime(frame.depth_stamp_s);
            rawlog.write(moved);
            rawlog.write(*scan);
        });
    });
    return scans;
}

}  // namespace rgbd_graphslam
