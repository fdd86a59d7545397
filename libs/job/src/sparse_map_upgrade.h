/** map.sparse as earlier editions wrote it. */
#pragma once
#include <string>
#include <string_view>

namespace rgbd_graphslam {

/** Version 2 knew one pinhole camera and its five Brown-Conrady coefficients; version 3 has a rig.
 *  \param payload of a map.sparse of version 2
 *  \return the same map as version 3
 *  \throws DamagedBytes where the bytes end early */
std::string upgradeFromVersion2(std::string_view payload);

}  // namespace rgbd_graphslam
