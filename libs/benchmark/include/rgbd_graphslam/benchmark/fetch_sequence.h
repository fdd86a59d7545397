/** What tum-get does. */
#pragma once
#include <string>

#include "rgbd_graphslam/benchmark/sequence_table.h"

namespace rgbd_graphslam {

/** Downloads a sequence and unpacks it into `folder`/rgbd_dataset_..., which appears when it is
 *  complete. What is there already is not fetched or unpacked again.
 *  \param keep_archive leave the .tgz in `folder`
 *  \return the sequence's folder
 *  \throws Error as download() does, or when the archive is damaged */
std::string fetchSequence(const KnownSequence& sequence, const std::string& folder,
                          bool keep_archive);

}  // namespace rgbd_graphslam
