/** Bytes compressed with bzip2, LZ4 or Zstandard. */
#pragma once
#include <string>
#include <string_view>

namespace rgbd_graphslam {

/** No recorder makes chunks or messages so large; a damaged size shall not fill the memory. */
constexpr std::size_t largest_unpacked = std::size_t{1} << 30;

/** Unpacks one stream. Memory grows with what comes out, not with what a header claims.
 *  \param size of what must come out; 0 when it is not known
 *  \throws std::out_of_range when the stream is damaged, or of another size */
std::string unpackedBytes(std::string_view bytes, std::size_t size);

/** Whether bytes start as a Zstandard frame (RFC 8878, section 3.1.1). */
bool isZstandard(std::string_view bytes);

/** Unpacks a file. \throws Error naming it when that fails */
void unpackFile(const std::string& packed, const std::string& to);

}  // namespace rgbd_graphslam
