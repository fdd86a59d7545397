/** Messages of ROS 2 as bytes. */
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "rgbd_graphslam/core/byte_stream.h"

namespace rgbd_graphslam {

/** OMG's Common Data Representation, plain and little-endian, as DDS and ROS 2 use it: numbers are
 *  aligned to their size, counted from behind the four bytes of the encapsulation header. */
class CdrWriter {
  public:
    CdrWriter() { out_.putBytes(std::string_view("\0\1\0\0", header_bytes)); }

    template <class Number>
    CdrWriter& put(Number number) {
        while ((out_.bytes().size() - header_bytes) % sizeof(Number) != 0) out_.put<char>(0);
        out_.put(number);
        return *this;
    }

    CdrWriter& putText(const std::string& text) {
        putCount(text.size() + 1);
        out_.putBytes(text);
        out_.put<char>(0);
        return *this;
    }

    /** Length of a sequence, which follows. */
    CdrWriter& putCount(std::size_t count) { return put(static_cast<std::uint32_t>(count)); }

    /** Elements of single bytes. */
    CdrWriter& putBytes(std::string_view bytes) {
        out_.putBytes(bytes);
        return *this;
    }

    void reserve(std::size_t bytes) { out_.reserve(bytes); }
    std::string take() { return out_.take(); }

  private:
    static constexpr std::size_t header_bytes = 4;
    ByteWriter out_;
};

}  // namespace rgbd_graphslam
