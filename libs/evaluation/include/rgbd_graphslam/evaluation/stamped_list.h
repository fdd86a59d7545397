/** Lists of stamped things, e.g. the images of a sequence. */
#pragma once
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A line "stamp anything" of a list of the TUM benchmark. */
struct StampedLine {
    double stamp_s = 0;
    std::string rest;  // what follows the stamp, words separated by one blank
};

/** Commas and tabs separate as blanks do, `#` starts a comment.
 *  \return in order of time; of lines with the same stamp the last
 *  \throws Error naming file and line for a stamp that is no number, or when the list is empty */
std::vector<StampedLine> readStampedList(const std::string& path);

/** In seconds. */
std::vector<double> stampsOf(const std::vector<StampedLine>& lines);

/** How two lists are associated by their stamps. */
struct AssociationOptions {
    double max_difference_s = 0.02;  // exclusive
    double offset_s = 0;             // added to the stamps of the second list
    bool first_only = false;         // leave out what the second list says
};

/** The pairs of associate() as lines "stamp rest stamp rest", with the stamps as recorded.
 *  \throws Error when no pair is found */
std::string associationText(const std::vector<StampedLine>& first,
                            const std::vector<StampedLine>& second,
                            const AssociationOptions& options = {});

}  // namespace rgbd_graphslam
