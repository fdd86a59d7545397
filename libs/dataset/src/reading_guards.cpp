#include "reading_guards.h"

#include <dlfcn.h>
#include <mrpt/core/aligned_allocator.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <jpeglib.h>  // needs cstdio

namespace rgbd_graphslam {
namespace {

thread_local std::size_t most_bytes_at_once = std::numeric_limits<std::size_t>::max();

struct RefusedMemory : std::bad_alloc {
    const char* what() const noexcept override { return "asks for more memory than there is"; }
};

using mrpt::serialization::CArchive;

/** A count, then the items as they lie in memory. */
template <class List>
CArchive& readAsItComes(CArchive& in, List& list) {
    constexpr std::size_t most_at_once = std::size_t{1} << 20;
    const auto count = in.ReadAs<std::uint32_t>();
    list.clear();
    while (list.size() < count) {
        const std::size_t before = list.size(), more = std::min(count - before, most_at_once);
        list.resize(before + more);
        in.ReadBufferFixEndianness(&list[before], more);
    }
    return in;
}

/** libjpeg expects not to return from here; it was compiled to let exceptions pass. */
void throwJpegError(j_common_ptr state) {
    std::string message(JMSG_LENGTH_MAX, '\0');
    state->err->format_message(state, message.data());
    message.resize(message.find('\0'));
    if (state->mem) state->mem->self_destruct(state);
    state->mem = nullptr;
    throw std::runtime_error("JPEG image: " + message);
}

}  // namespace

MemoryLimit::MemoryLimit(std::size_t most_bytes) : outer_(most_bytes_at_once) {
    most_bytes_at_once = most_bytes;
}

MemoryLimit::~MemoryLimit() {
    most_bytes_at_once = outer_;
}

}  // namespace rgbd_graphslam

void* mrpt::aligned_malloc(std::size_t size, std::size_t alignment) {
    using namespace rgbd_graphslam;
    void* memory = nullptr;
    if (size > most_bytes_at_once || posix_memalign(&memory, alignment, size) != 0) {
        throw RefusedMemory();
    }
    return memory;
}

namespace mrpt::serialization {
using rgbd_graphslam::readAsItComes;

// Parameters are called as where MRPT declares them.
CArchive& operator>>(CArchive& in, std::string& str) {
    return readAsItComes(in, str);
}
CArchive& operator>>(CArchive& s, std::vector<float>& a) {
    return readAsItComes(s, a);
}
CArchive& operator>>(CArchive& s, std::vector<double>& a) {
    return readAsItComes(s, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::int8_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::uint8_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::int16_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::uint16_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::int32_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::uint32_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& in, std::vector<std::int64_t>& a) {
    return readAsItComes(in, a);
}
CArchive& operator>>(CArchive& s, std::vector<std::uint64_t>& a) {
    return readAsItComes(s, a);
}

CArchive& operator>>(CArchive& in, std::vector<bool>& a) {
    std::vector<std::uint8_t> bytes;
    in >> bytes;
    a.clear();
    for (const std::uint8_t byte : bytes) a.push_back(byte != 0);
    return in;
}

CArchive& operator>>(CArchive& in, std::vector<std::string>& a) {
    a.clear();
    for (auto left = in.ReadAs<std::uint32_t>(); left > 0; --left) in >> a.emplace_back();
    return in;
}

}  // namespace mrpt::serialization

void mrpt::obs::CObservation3DRangeScan::resizePoints3DVectors(std::size_t points) {
    using namespace rgbd_graphslam;
    using Function = void (*)(CObservation3DRangeScan*, std::size_t);
    static const auto original = reinterpret_cast<Function>(
        dlsym(RTLD_NEXT, "_ZN4mrpt3obs23CObservation3DRangeScan21resizePoints3DVectorsEm"));
    constexpr std::size_t bytes_a_point = 3 * sizeof(float) + 2 * sizeof(std::uint16_t);
    if (points > most_bytes_at_once / bytes_a_point) throw RefusedMemory();
    original(this, points);
}

extern "C" jpeg_error_mgr* jpeg_std_error(jpeg_error_mgr* errors) {
    using Function = jpeg_error_mgr* (*)(jpeg_error_mgr*);
    static const auto original = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "jpeg_std_error"));
    original(errors);
    errors->error_exit = rgbd_graphslam::throwJpegError;
    return errors;
}
