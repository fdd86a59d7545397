/** The images of keyframes, packed in memory. */
#pragma once
#include <map>
#include <vector>

#include "rgbd_graphslam/geometry/rgbd_image.h"

namespace rgbd_graphslam {

/** Keeps what dense maps are made of when there is no recording to read again: some 0.4 MB per
 *  keyframe of 640x480, without loss. */
class KeyframeImages {
  public:
    void add(int keyframe, const RgbdImage& image);
    /** Those that `keyframe` is not one of are never asked for again. */
    void drop(int keyframe) { packed_.erase(keyframe); }
    bool has(int keyframe) const { return packed_.count(keyframe) > 0; }
    /** \throws std::out_of_range for a keyframe that was not added */
    RgbdImage operator[](int keyframe) const;

  private:
    struct Packed {
        double stamp_s = 0, depth_unit_m = 0.001;
        std::vector<unsigned char> color, depth;  // PNG; color may be gray
    };
    std::map<int, Packed> packed_;
};

}  // namespace rgbd_graphslam
