/** Numbers and texts as ROS puts them on the wire. */
#pragma once
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rgbd_graphslam {

enum class WireFormat {
    /** ROS 1: little-endian, without padding. */
    Ros1,
    /** ROS 2: CDR of OMG's DDS-XTypes 1.3, section 7.4.3. Four bytes say which endianness; numbers
     *  are aligned to their size, texts end with a zero. */
    Cdr
};

/** Reads one value after the other from bytes that outlive it. */
class WireReader {
  public:
    /** \throws std::out_of_range for an encapsulation other than plain CDR, version 1 or 2 */
    explicit WireReader(std::string_view bytes, WireFormat format = WireFormat::Ros1)
        : bytes_(bytes), format_(format) {
        if (format == WireFormat::Cdr) readEncapsulation();
    }

    WireFormat format() const { return format_; }

    /** \throws std::out_of_range when the bytes end before the value does */
    template <class Number>
    Number number() {
        align(sizeof(Number));
        char raw[sizeof(Number)];
        std::memcpy(raw, take(sizeof raw), sizeof raw);
        if (big_endian_) std::reverse(raw, raw + sizeof raw);
        Number value;
        std::memcpy(&value, raw, sizeof value);
        return value;
    }

    /** Length and bytes; they belong to the message. */
    std::string_view data() {
        const auto length = number<std::uint32_t>();
        return {take(length), length};
    }

    /** Length and characters. */
    std::string text() {
        const std::string_view characters = data();
        const bool has_end = format_ == WireFormat::Cdr && !characters.empty();
        return std::string(characters.substr(0, characters.size() - (has_end ? 1 : 0)));
    }

    /** The length of a sequence of numbers, all of which must be there. */
    template <class Number>
    std::size_t lengthOfSequence() {
        const std::size_t length = number<std::uint32_t>();
        if (length > left() / sizeof(Number)) throw std::out_of_range("too few bytes");
        return length;
    }

    void skip(std::size_t count) { take(count); }
    std::size_t left() const { return bytes_.size() - at_; }
    bool atEnd() const { return left() == 0; }

  private:
    void readEncapsulation() {
        const char* kind = take(4);
        const bool version_2 = kind[1] == 6 || kind[1] == 7;
        if (kind[0] != 0 || !(kind[1] == 0 || kind[1] == 1 || version_2)) {
            throw std::out_of_range("an unknown encapsulation");
        }
        big_endian_ = (kind[1] & 1) == 0;
        most_alignment_ = version_2 ? 4 : 8;
        start_ = at_;
    }

    void align(std::size_t size) {
        if (format_ == WireFormat::Ros1) return;
        const std::size_t step = std::min(size, most_alignment_);
        const std::size_t past = (at_ - start_) % step;
        if (past != 0) take(step - past);
    }

    const char* take(std::size_t count) {
        if (count > left()) throw std::out_of_range("too few bytes");
        at_ += count;
        return bytes_.data() + at_ - count;
    }

    std::string_view bytes_;
    WireFormat format_;
    bool big_endian_ = false;
    std::size_t most_alignment_ = 1;
    std::size_t start_ = 0, at_ = 0;
};

}  // namespace rgbd_graphslam
