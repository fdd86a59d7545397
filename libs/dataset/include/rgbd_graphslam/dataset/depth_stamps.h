/** When the depth image of each frame was taken. */
#pragma once
#include <map>
#include <string>

namespace rgbd_graphslam {

/** Stamp of the depth image by stamp of the color image, both in microseconds of UNIX time; frames
 *  whose stamps agree are left out. An RGB-D observation has one time only, that of its color
 *  image, so a rawlog keeps these in its comment block (CObservationComment, an ini text), where
 *  every MRPT tool preserves and shows them. */
using DepthStamps = std::map<long long, long long>;

/** The lines `color stamp = depth stamp` of section [depth_stamps]; nothing when there is none. */
std::string toIniText(const DepthStamps& stamps);

/** Inverse of toIniText; lines of other sections and lines of another form are passed over, because
 *  people write into comments. */
DepthStamps depthStampsIn(const std::string& comment);

}  // namespace rgbd_graphslam
