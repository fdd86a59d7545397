/** libFuzzer's entry into one target, RGBD_FUZZ_TARGET, by its name in fuzzTargets(). */
#include <cstdint>
#include <cstdlib>
#include <new>

#include "fuzz_targets.h"

// An instrumented program ends where memory does; in the real one, readers are told so and go on.
namespace {
constexpr std::size_t most_bytes_at_once = std::size_t{256} << 20;

rgbd_graphslam::FuzzTarget target() {
    for (const auto& each : rgbd_graphslam::fuzzTargets()) {
        if (std::string(each.name) == RGBD_FUZZ_TARGET) return each.run;
    }
    std::abort();
}
}  // namespace

void* operator new(std::size_t bytes) {
    void* const memory = bytes > most_bytes_at_once ? nullptr : std::malloc(bytes);
    if (!memory) throw std::bad_alloc();
    return memory;
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

/** What a target prepares once, the film of checkpoints above all, takes longer than an input may.
 */
extern "C" int LLVMFuzzerInitialize(int*, char***) {
    target()("");
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const rgbd_graphslam::FuzzTarget run = target();
    run(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
