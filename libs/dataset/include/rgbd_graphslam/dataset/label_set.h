/** Names of what label images show. */
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace rgbd_graphslam {

/** Name and color of a value of label images. */
struct LabelName {
    std::string name;
    std::array<std::uint8_t, 3> rgb{};
};

/** By value; 0, "no class", is never one of them. */
using LabelSet = std::map<int, LabelName>;

/** Largest value of a label image. */
inline constexpr int largest_label = 65535;

/** Sections `[VALUE]` with `name` and, if given, `color = [R G B]`; classes without a color get one
 *  that differs from their neighbors'.
 *  \param name stands for the text in error messages
 *  \throws Error naming the section that is no number from 1 to 65535 or has no name */
LabelSet labelSetFromIni(const std::string& text, const std::string& name);

/** \throws Error as labelSetFromIni(), or when the file cannot be read */
LabelSet readLabelSet(const std::string& path);

/** Section [label_names] with lines `VALUE = R G B NAME`, for a rawlog's comment. */
std::string toComment(const LabelSet& labels);

/** Inverse of toComment(); other sections and lines of another form are passed over, because people
 *  write into comments. */
LabelSet labelsIn(const std::string& comment);

/** The values whose names are among words separated by spaces. */
std::set<int> labelsNamed(const LabelSet& labels, const std::string& words);

/** The name of a value; "class N" where it has none. */
std::string nameOf(const LabelSet& labels, int label);

}  // namespace rgbd_graphslam
