/** Numbers as bytes, little-endian on every machine; reading distrusts its input. */
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

namespace detail {
template <std::size_t bytes>
using UnsignedOf = std::conditional_t<
    bytes == 1, std::uint8_t,
    std::conditional_t<bytes == 2, std::uint16_t,
                       std::conditional_t<bytes == 4, std::uint32_t, std::uint64_t>>>;
}

/** The bytes are not what a ByteWriter wrote. */
class DamagedBytes : public Error {
  public:
    using Error::Error;
};

/** Appends numbers and texts to a growing buffer. */
class ByteWriter {
  public:
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

    template <class Number>
    void put(Number number) {
        static_assert(std::is_arithmetic_v<Number>);
        detail::UnsignedOf<sizeof(Number)> bits;
        std::memcpy(&bits, &number, sizeof(number));
        char bytes[sizeof(Number)];
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            bytes[i] = static_cast<char>(bits >> (8 * i));
        }
        bytes_.append(bytes, sizeof(bytes));
    }

    /** Number of items that follow, 32 bits. */
    void putCount(std::size_t count) { put(static_cast<std::uint32_t>(count)); }

    void putBytes(std::string_view bytes) { bytes_ += bytes; }

    void putText(const std::string& text) {
        putCount(text.size());
        bytes_ += text;
    }

    const std::string& bytes() const { return bytes_; }
    /** The writer is empty afterwards. */
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/** Every read is checked against the end, so that damaged input ends in DamagedBytes and never in a
 *  read beyond it or a huge allocation. */
class ByteReader {
  public:
    /** \param bytes must outlive the reader */
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    /** \throws DamagedBytes at the end */
    template <class Number>
    Number get() {
        static_assert(std::is_arithmetic_v<Number>);
        const char* const from = take(sizeof(Number));
        detail::UnsignedOf<sizeof(Number)> bits = 0;
        for (std::size_t i = 0; i < sizeof(Number); ++i) {
            const auto byte = static_cast<unsigned char>(from[i]);
            bits = static_cast<decltype(bits)>(bits | static_cast<decltype(bits)>(byte) << (8 * i));
        }
        Number number;
        std::memcpy(&number, &bits, sizeof(number));
        return number;
    }

    /** \param least_bytes that one of the items takes
     *  \throws DamagedBytes when that many cannot follow */
    std::size_t getCount(std::size_t least_bytes) {
        const auto count = get<std::uint32_t>();
        if (count > left() / least_bytes) throw DamagedBytes("a list is longer than its data");
        return count;
    }

    /** \return a view of the bytes that are read */
    std::string_view getBytes(std::size_t count) { return {take(count), count}; }

    std::string getText() { return std::string(getBytes(getCount(1))); }

    std::size_t left() const { return bytes_.size() - position_; }

  private:
    const char* take(std::size_t count) {
        if (count > left()) throw DamagedBytes("the data end early");
        const char* const from = bytes_.data() + position_;
        position_ += count;
        return from;
    }

    std::string_view bytes_;
    std::size_t position_ = 0;
};

}  // namespace rgbd_graphslam
