/** Text files of lines with a stamp or other numbers in front, as sequences come with. */
#pragma once
#include <functional>
#include <optional>
#include <sstream>
#include <string>

namespace rgbd_graphslam {

/** A line that is no comment. */
struct Line {
    std::string path;
    int number;
    std::istringstream words;
    /** It had commas for decimal points; they are points now. */
    bool had_decimal_commas = false;

    /** \throws Error naming file and line */
    [[noreturn]] void refuse(const std::string& why, const std::string& form) const;

    /** The next word. \param form what the line should be, for the error when it is no number */
    double realNumber(const std::string& form);

    /** The rest of the line without blanks around it. */
    std::string rest();
};

/** Whether a word is a finite number as a whole. */
std::optional<double> numberIn(const std::string& word);

/** Commas, semicolons and tabs separate as blanks do, but for commas that stand for decimal points;
 *  `#` starts a comment; a byte-order mark is skipped.
 *  \throws Error when the file cannot be read or is UTF-16 */
void forEachLine(const std::string& path, const std::function<void(Line&)>& use);

/** \throws Error when there is no such folder or nothing in it */
void checkSequenceFolder(const std::string& folder);

}  // namespace rgbd_graphslam
