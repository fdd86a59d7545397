/** Which unit timestamps are in, where nothing but the numbers tells. */
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

struct StampUnit {
    double seconds;
    /** In the plural: "milliseconds". */
    const char* name;
};

/** Seconds, milliseconds, microseconds and nanoseconds. */
const std::vector<StampUnit>& stampUnits();

/** Recognizes the unit by magnitude, since UNIX times of this century differ by factors of a
 *  thousand; smaller numbers by the median step: images come at 0.25 Hz or faster, and rarely
 *  faster than 500 Hz.
 *  \param stamps as written, in file order, finite
 *  \return seconds where nothing can be told */
StampUnit unitOfStamps(const std::vector<double>& stamps);

/** Frame numbers: integers below ten million with a median step of 1, or all a multiple of one step
 *  of a few. */
bool areFrameNumbers(const std::vector<double>& numbers);

/** The unit in which the stamps overlap a time span; seconds before the others.
 *  \param first_s, last_s the span
 *  \return nothing when none does */
std::optional<StampUnit> unitToOverlap(const std::vector<double>& stamps, double first_s,
                                       double last_s);

}  // namespace rgbd_graphslam
