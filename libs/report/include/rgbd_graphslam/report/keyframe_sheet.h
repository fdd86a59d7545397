/** What the camera saw, as one picture. */
#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace rgbd_graphslam {

/** Collects small pictures of keyframes, however many come: some dozens, evenly spread, are kept.
 */
class KeyframeSheet {
  public:
    /** \param keyframe its number
     *  \param seconds since the first frame
     *  \param picture CV_8UC3 (BGR) or CV_8UC1 (gray) */
    void add(int keyframe, double seconds, const cv::Mat& picture);

    /** Rows of pictures with number and time in each; empty when none was added. */
    cv::Mat3b picture() const;

  private:
    struct Thumbnail {
        int keyframe;
        double seconds;
        cv::Mat3b image;
    };
    void thinOut();

    std::vector<Thumbnail> thumbnails_;  // of every stride_-th picture
    int count_ = 0, stride_ = 1;
};

}  // namespace rgbd_graphslam
