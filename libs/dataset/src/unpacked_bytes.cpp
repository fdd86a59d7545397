#include "unpacked_bytes.h"

#include <archive.h>
#include <archive_entry.h>

#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t block_bytes = 1 << 18;

using Archive = std::unique_ptr<archive, int (*)(archive*)>;

Archive newReader() {
    Archive in(archive_read_new(), archive_read_free);
    archive_read_support_filter_bzip2(in.get());
    archive_read_support_filter_lz4(in.get());
    archive_read_support_filter_zstd(in.get());
    archive_read_support_format_raw(in.get());
    return in;
}

/** Calls `use` with block after block. \return whether the stream was whole */
template <class Use>
bool forEachBlock(archive* in, Use use) {
    archive_entry* entry = nullptr;
    constexpr int packed_filters = 2;  // the last one only reads
    if (archive_read_next_header(in, &entry) != ARCHIVE_OK) return false;
    if (archive_filter_count(in) < packed_filters) return false;
    std::vector<char> block(block_bytes);
    while (true) {
        const la_ssize_t count = archive_read_data(in, block.data(), block.size());
        if (count <= 0) return count == 0;
        if (!use(block.data(), static_cast<std::size_t>(count))) return false;
    }
}

}  // namespace

std::string unpackedBytes(std::string_view bytes, std::size_t size) {
    const std::size_t most = size > 0 ? size : largest_unpacked;
    if (most > largest_unpacked) throw std::out_of_range("compressed data are too large");
    const Archive in = newReader();
    std::string result;
    const auto append = [&](const char* block, std::size_t count) {
        if (count > most - result.size()) return false;
        result.append(block, count);
        return true;
    };
    const bool whole =
        archive_read_open_memory(in.get(), bytes.data(), bytes.size()) == ARCHIVE_OK &&
        forEachBlock(in.get(), append);
    if (!whole || (size > 0 && result.size() != size)) {
        throw std::out_of_range("compressed data cannot be unpacked");
    }
    return result;
}

bool isZstandard(std::string_view bytes) {
    return bytes.substr(0, 4) == "\x28\xb5\x2f\xfd";
}

void unpackFile(const std::string& packed, const std::string& to) {
    const Archive in = newReader();
    std::ofstream out(to, std::ios::binary);
    const auto write = [&](const char* block, std::size_t count) {
        return bool(out.write(block, static_cast<std::streamsize>(count)));
    };
    const bool whole =
        archive_read_open_filename(in.get(), packed.c_str(), block_bytes) == ARCHIVE_OK &&
        forEachBlock(in.get(), write);
    if (!out.flush()) throw Error("cannot write '" + to + "'", "check free space");
    if (!whole) throw Error("'" + packed + "' is damaged or cut off", "copy the recording again");
}

}  // namespace rgbd_graphslam
