/** How far away a recording's depth is, and whether its unit can be right. */
#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Counts the raw readings of depth images. */
class DepthHistogram {
  public:
    /** Counts every fourth pixel of every fourth row.
     *  \param depth CV_16UC1, 0 = no reading */
    void add(const cv::Mat& depth);

    std::uint64_t pixels() const { return pixels_; }
    std::uint64_t readings() const { return readings_; }
    std::uint64_t count(std::uint16_t reading) const { return counts_[reading]; }

    /** The raw reading that this share of all readings does not exceed; 0 without readings.
     *  \param share 0 to 1 */
    std::uint16_t quantile(double share) const;

    /** Share of the readings beyond a raw value; 0 without readings. */
    double shareBeyond(double reading) const;

  private:
    std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(65536);
    std::uint64_t pixels_ = 0, readings_ = 0;
};

/** Depth of a recording in meters; all 0 without readings. */
struct DepthSummary {
    double lower_quartile_m = 0, median_m = 0, upper_quartile_m = 0;
    /** 95 % of the readings are nearer. */
    double far_m = 0;
    /** Share of all pixels that have a reading. */
    double coverage = 0;
    /** Share of the readings nearer than nearest_sensor_m, and beyond usual_max_depth_m. */
    double share_too_near = 0, share_beyond = 0;
};

/** Cameras of structured light or time of flight see nothing nearer. */
inline constexpr double nearest_sensor_m = 0.4;
/** The default of rgbd-slam's `depth_max_m`. */
inline constexpr double usual_max_depth_m = 10;

/** \param unit_m meters per unit of depth */
DepthSummary summarize(const DepthHistogram& depth, double unit_m);

/** "median 1.62 m, half of the readings from 0.90 to 2.31 m, 87 % of the pixels have a reading" */
std::string toText(const DepthSummary& summary);

/** Units per meter that fit the readings better than the ones in use.
 *  Units somebody stated are doubted only when the median distance is outside 0.2 to 15 m. Units
 *  that were merely assumed are also doubted when more than a fifth of the readings are nearer than
 *  a depth camera can see, and 95 % nearer than a room is wide.
 *  \param units per meter as in use
 *  \return one of the usual units for which the median is 0.5 to 8 m; nothing when the units in use
 *          are plausible, or when no usual unit is */
std::optional<double> plausibleDepthUnits(const DepthHistogram& depth, double units, bool assumed);

/** Whether the median distance is outside 0.2 to 15 m. */
bool isImplausible(const DepthSummary& summary);

/** A value for `depth_max_m` that keeps 95 % of the readings, rounded up to two digits; nothing
 *  when the default keeps at least half of them. */
std::optional<double> betterMaxDepth(const DepthSummary& summary);

}  // namespace rgbd_graphslam
