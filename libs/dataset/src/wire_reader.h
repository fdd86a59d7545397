/** Numbers and texts as ROS puts them on the wire: little-endian, without padding. */
#pragma once
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace rgbd_graphslam {

/** Reads one value after the other from bytes that outlive it. */
class WireReader {
  public:
    explicit WireReader(const std::string& bytes) : bytes_(bytes) {}

    /** \throws std::out_of_range when the bytes end before the value does */
    template <class Number>
    Number number() {
        Number value;
        std::memcpy(&value, take(sizeof value), sizeof value);
        return value;
    }

    /** Length and bytes. */
    std::string text() {
        const auto length = number<std::uint32_t>();
        return {take(length), length};
    }

    void skip(std::size_t count) { take(count); }
    bool atEnd() const { return at_ == bytes_.size(); }

  private:
    const char* take(std::size_t count) {
        if (count > bytes_.size() - at_) throw std::out_of_range("too few bytes");
        at_ += count;
        return bytes_.data() + at_ - count;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
};

}  // namespace rgbd_graphslam
