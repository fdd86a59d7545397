/** Text files of lines with a stamp or other numbers in front, as sequences come with. */
#pragma once
#include <functional>
#include <sstream>
#include <string>

namespace rgbd_graphslam {

/** A line that is no comment. */
struct Line {
    std::string path;
    int number;
    std::istringstream words;

    /** \throws Error naming file and line */
    [[noreturn]] void refuse(const std::string& why, const std::string& form) const;

    /** The next word. \param form what the line should be, for the error when it is no number */
    double realNumber(const std::string& form);

    /** The rest of the line without blanks around it. */
    std::string rest();
};

/** Commas and tabs separate as blanks do, `#` starts a comment.
 *  \throws Error when the file cannot be read */
void forEachLine(const std::string& path, const std::function<void(Line&)>& use);

/** \throws Error when there is no such folder or nothing in it */
void checkSequenceFolder(const std::string& folder);

}  // namespace rgbd_graphslam
