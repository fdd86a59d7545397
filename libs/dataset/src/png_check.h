/** Whether a PNG file came through whole. */
#pragma once
#include <vector>

namespace rgbd_graphslam {

enum class PngState { NoPng, Whole, CutOff, Damaged };

/** Walks the chunks and their check sums (PNG specification, section 5). The decoder checks less
 *  and complains on stderr by itself. */
PngState checkPng(const std::vector<unsigned char>& bytes);

}  // namespace rgbd_graphslam
