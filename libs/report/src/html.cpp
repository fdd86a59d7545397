#include "rgbd_graphslam/report/html.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string_view>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

/** Bytes of the UTF-8 character that begins at `i`; 0 where none does. Overlong forms are refused
 *  as far as they would hide ASCII. */
std::size_t characterLength(const std::string& text, std::size_t i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80                   ? 1
                               : byte >= 0xC2 && byte < 0xE0 ? 2
                               : byte >= 0xE0 && byte < 0xF0 ? 3
                               : byte >= 0xF0 && byte < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return 0;
    }
    return length;
}

std::string_view entityOf(char c) {
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
        default:
            return {};
    }
}

bool isControl(char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
}

std::string base64(const std::string& bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t triple = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            triple = triple << 8 | (k < have ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= have ? digits[triple >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

}  // namespace

std::string htmlEscaped(const std::string& text) {
    std::string html;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = characterLength(text, i);
        const std::string_view entity = entityOf(text[i]);
        if (length == 0 || isControl(text[i])) {
            html += replacement;
        } else if (!entity.empty()) {
            html += entity;
        } else {
            html.append(text, i, length);
        }
        i += std::max<std::size_t>(1, length);
    }
    return html;
}

std::string dataUri(const std::string& type, const std::string& bytes) {
    return "data:" + type + ";base64," + base64(bytes);
}

std::string embeddedImage(const std::string& type, const std::string& bytes,
                          const std::string& description) {
    if (bytes.empty()) return {};
    return "<img alt=\"" + htmlEscaped(description) + "\" src=\"" + dataUri(type, bytes) + "\">";
}

std::string filled(const std::string& page, const std::map<std::string, std::string>& values) {
    std::string html;
    std::set<std::string> used;
    std::size_t at = 0;
    while (true) {
        const std::size_t open = page.find("{{", at);
        html.append(page, at, open - at);
        if (open == std::string::npos) break;
        const std::size_t close = page.find("}}", open);
        const std::string name = page.substr(open + 2, close - open - 2);
        const auto value = values.find(name);
        if (value == values.end()) throw Error("the page has no value for '" + name + "'");
        html += value->second;
        used.insert(name);
        at = close + 2;
    }
    if (used.size() < values.size()) throw Error("a value has no place in the page");
    return html;
}

}  // namespace rgbd_graphslam
