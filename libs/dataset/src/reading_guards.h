/** What keeps damaged files from ending a process inside the libraries that read them. */
#pragma once
#include <cstddef>

namespace rgbd_graphslam {

/** While it lives, MRPT's containers that ask for more than this at once, in this thread, get a
 *  std::bad_alloc. Lengths in a file are taken at their word by MRPT, and memory is filled before
 *  it turns out that the file has no such contents.
 *
 *  Linking this also replaces functions of the libraries beneath, for the whole process:
 *  - mrpt::aligned_malloc, whose callers write to the null it gives where memory is refused, throws
 *    std::bad_alloc instead;
 *  - MRPT's reading of texts and plain lists, which takes as much memory as a length says before it
 *    looks for the contents, takes it as they come;
 *  - CObservation3DRangeScan's making room for points, which fills it before it looks for them,
 * keeps to the limit, too;
 *  - jpeg_std_error, with which libjpeg ends the process at a damaged image, sets up a
 *    std::runtime_error instead (OpenCV goes on to set its own way). */
class MemoryLimit {
  public:
    explicit MemoryLimit(std::size_t most_bytes);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

  private:
    std::size_t outer_;
};

}  // namespace rgbd_graphslam
