/** What is known of the TUM RGB-D benchmark's sequences. */
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** A section of ini/tum-sequences.ini, which explains the keys. */
struct KnownSequence {
    std::string name;  // e.g. "fr1/desk"
    std::string url, good_for;
    double duration_s = 0, length_m = 0;
    bool duration_checked = false, length_checked = false;
    /** Of the archive; nothing where it is not known. */
    std::optional<std::size_t> bytes;
    /** Best published ATE RMSE with an RGB-D camera; nothing where none was found. */
    std::optional<double> best_ate_m;

    /** "rgbd_dataset_freiburg1_desk", the name of archive and folder. */
    std::string folder() const;
};

/** In the file's order.
 *  \throws Error naming the file and the section in which a key is missing, unknown or no number */
std::vector<KnownSequence> readSequenceTable(const std::string& path);

/** The sequence that a name means: "fr1/desk", "fr1_desk", "freiburg1_desk" or its folder's.
 *  \return nullptr when there is none in the table */
const KnownSequence* findSequence(const std::vector<KnownSequence>& table, const std::string& name);

/** A table for people: name, duration, length, size, what it is good for. */
std::string toText(const std::vector<KnownSequence>& table);

}  // namespace rgbd_graphslam
