#include "png_check.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace rgbd_graphslam {
namespace {

constexpr unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::array<std::uint32_t, 256> makeCrcTable() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit) {
            table[i] = table[i] & 1 ? 0xedb88320u ^ (table[i] >> 1) : table[i] >> 1;
        }
    }
    return table;
}

std::uint32_t crcOf(const unsigned char* data, std::size_t count) {
    static const auto table = makeCrcTable();
    std::uint32_t crc = 0xffffffffu;
    for (std::size_t i = 0; i < count; ++i) crc = table[(crc ^ data[i]) & 0xff] ^ (crc >> 8);
    return ~crc;
}

std::uint32_t bigEndian(const unsigned char* data) {
    return static_cast<std::uint32_t>(data[0]) << 24 | data[1] << 16 | data[2] << 8 | data[3];
}

}  // namespace

PngState checkPng(const std::vector<unsigned char>& bytes) {
    const std::size_t size = bytes.size();
    if (size < sizeof(signature) || std::memcmp(bytes.data(), signature, sizeof(signature)) != 0) {
        return PngState::NoPng;
    }
    for (std::size_t at = sizeof(signature); size - at >= 12;) {
        const unsigned char* chunk = bytes.data() + at;  // length, name, data, check sum
        const std::size_t length = bigEndian(chunk);
        if (length > size - at - 12) return PngState::CutOff;
        if (crcOf(chunk + 4, length + 4) != bigEndian(chunk + 8 + length)) return PngState::Damaged;
        if (std::memcmp(chunk + 4, "IEND", 4) == 0) return PngState::Whole;
        at += length + 12;
    }
    return PngState::CutOff;
}

}  // namespace rgbd_graphslam
