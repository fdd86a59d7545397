/** Finding the sequences below a folder. */
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A recording and the name it has in a report. */
struct FoundSequence {
    std::string name;
    /** A folder in one of the known layouts, an archive or bag of one, or a rawlog. */
    std::string source;
};

/** Sequences in the folders, at any depth, sorted by name; a root may itself be a sequence. A name
 *  is the path below the root with `_` for `/` and without ending. Of a folder, an archive and a
 *  rawlog with the same name the first counts.
 *  \param leave_out a folder that is not searched
 *  \throws Error when a root is missing, nothing is found, or sequences of two roots have one name
 */
std::vector<FoundSequence> findSequences(const std::vector<std::string>& roots,
                                         const std::string& leave_out);

/** A share of a list, for machines that divide the work. */
struct Share {
    std::size_t part = 1, of = 1;
};

/** Reads "i/n", 1 <= i <= n. \throws Error for another form */
Share parseShare(const std::string& text);

/** Every n-th entry, beginning with the i-th. */
std::vector<FoundSequence> shareOf(const std::vector<FoundSequence>& all, const Share& share);

}  // namespace rgbd_graphslam
