#include "reading_guards.h"

#include <dlfcn.h>
#include <mrpt/core/aligned_allocator.h>

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include <jpeglib.h>  // needs cstdio

namespace rgbd_graphslam {
namespace {

thread_local std::size_t most_bytes_at_once = std::numeric_limits<std::size_t>::max();

struct RefusedMemory : std::bad_alloc {
    const char* what() const noexcept override { return "asks for more memory than there is"; }
};

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

extern "C" jpeg_error_mgr* jpeg_std_error(jpeg_error_mgr* errors) {
    using Function = jpeg_error_mgr* (*)(jpeg_error_mgr*);
    static const auto original = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "jpeg_std_error"));
    original(errors);
    errors->error_exit = rgbd_graphslam::throwJpegError;
    return errors;
}
