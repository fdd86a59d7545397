#include "rgbd_graphslam/core/printable_text.h"

namespace rgbd_graphslam {
namespace {

bool inRange(const std::string& text, std::size_t at, unsigned low, unsigned high) {
    if (at >= text.size()) return false;
    const auto byte = static_cast<unsigned char>(text[at]);
    return byte >= low && byte <= high;
}

/** \return bytes of the printable character at `at` (RFC 3629, without the control characters),
 *  0 when there is none */
std::size_t characterLength(const std::string& text, std::size_t at) {
    const auto follows = [&](std::size_t i) { return inRange(text, at + i, 0x80, 0xBF); };
    const auto lead = static_cast<unsigned char>(text[at]);
    if (lead < 0x80) return lead >= ' ' && lead != 0x7F ? 1 : 0;
    if (lead >= 0xC2 && lead <= 0xDF) {
        return inRange(text, at + 1, lead == 0xC2 ? 0xA0 : 0x80, 0xBF) ? 2 : 0;
    }
    if (lead >= 0xE0 && lead <= 0xEF) {
        const unsigned low = lead == 0xE0 ? 0xA0 : 0x80, high = lead == 0xED ? 0x9F : 0xBF;
        return inRange(text, at + 1, low, high) && follows(2) ? 3 : 0;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        const unsigned low = lead == 0xF0 ? 0x90 : 0x80, high = lead == 0xF4 ? 0x8F : 0xBF;
        return inRange(text, at + 1, low, high) && follows(2) && follows(3) ? 4 : 0;
    }
    return 0;
}

}  // namespace

std::string printableLine(const std::string& text, std::size_t most_bytes) {
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = characterLength(text, at);
        line += length > 0 ? text.substr(at, length) : "?";
        at += length > 0 ? length : 1;
        if (line.size() >= most_bytes && at < text.size()) return line + "...";
    }
    return line;
}

}  // namespace rgbd_graphslam
