/** Pieces of HTML. */
#pragma once
#include <map>
#include <string>

namespace rgbd_graphslam {

/** Text as it must stand in HTML, in attributes too: & < > " ' become entities, bytes that are no
 *  UTF-8 and control characters a replacement character. */
std::string htmlEscaped(const std::string& text);

/** A file's bytes as the address of a picture. \param type e.g. "image/png" */
std::string dataUri(const std::string& type, const std::string& bytes);

/** A picture that is part of the page; nothing for no bytes. \param description plain text */
std::string embeddedImage(const std::string& type, const std::string& bytes,
                          const std::string& description);

/** A template with each {{name}} replaced by its value, which is HTML already.
 *  \throws Error when a name has no value or a value no place */
std::string filled(const std::string& page, const std::map<std::string, std::string>& values);

}  // namespace rgbd_graphslam
