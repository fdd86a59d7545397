/** Sequences still packed, as the TUM benchmark hands them out. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/temporary_folder.h"

namespace rgbd_graphslam {

/** Whether a path names a file with the ending of an archive: .tgz, .zip, or .tar, also with .gz,
 *  .bz2 or .xz behind it. */
bool isSequenceArchive(const std::string& path);

/** The path without such an ending. */
std::string withoutArchiveEnding(const std::string& path);

/** An archive (.tgz, .tar, .zip, whatever libarchive reads) unpacked into a temporary folder that
 *  goes when this object goes. */
class UnpackedArchive {
  public:
    /** \param scratch folder to unpack in; needs room for all files
     *  \throws Error when the archive is damaged, cut off, tries to write outside of its folder, or
     *          does not fit */
    UnpackedArchive(const std::string& archive, const std::string& scratch);

    /** The unpacked folder that holds the sequence, see layoutOf().
     *  \throws Error when there is none */
    std::string sequenceFolder() const;

  private:
    std::string archive_;
    TemporaryFolder folder_;
};

}  // namespace rgbd_graphslam
