#include "rgbd_graphslam/dataset/rgbd_sequence.h"

#include <set>

namespace rgbd_graphslam {

StampOrder stampOrder(const std::vector<ListedImage>& images) {
    StampOrder order;
    std::set<double> seen;
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (i > 0 && images[i].stamp_s < images[i - 1].stamp_s) ++order.backwards;
        if (!seen.insert(images[i].stamp_s).second) ++order.repeated;
    }
    return order;
}

}  // namespace rgbd_graphslam
