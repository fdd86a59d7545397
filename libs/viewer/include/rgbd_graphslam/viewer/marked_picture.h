/** An image as a panel shows it. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/viewer/vertex.h"

namespace rgbd_graphslam {

/** A point marked in a picture. */
struct PictureMark {
    float x = 0, y = 0;  // share of width and height, 0 to 1
    Rgba color{};
};

/** The image as large as it fits into a size, in the middle, with a square at each mark. The
 *  processor paints it: a thousand marks would take nanovg long without a graphics card.
 *  \param image BGR, not empty
 *  \param size_px of the result
 *  \param margin color of what the image leaves free
 *  \return RGBA */
cv::Mat4b fittedPicture(const cv::Mat3b& image, const std::vector<PictureMark>& marks,
                        const cv::Size& size_px, const Rgba& margin);

}  // namespace rgbd_graphslam
