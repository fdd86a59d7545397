/** What MRPT's ini reader would evaluate. */
#pragma once
#include <string>

namespace rgbd_graphslam {

/** MRPT replaces `$env{NAME}` by a variable of the environment and `$eval{...}` by the value of a
 *  formula, wherever they stand. A file from elsewhere could so bring what is none of its business
 *  into outputs and error messages, and settings would not be what they look like.
 *  \param name stands for the file in error messages
 *  \throws Error naming file and line of the first of them */
void refuseFormulas(const std::string& text, const std::string& name);

}  // namespace rgbd_graphslam
