/** Keyframe images in memory. */
#pragma once
#include <map>
#include <vector>

#include "rgbd_graphslam/mapping/keyframe_images.h"

namespace rgbd_graphslam {

/** Keeps what dense maps are made of when there is no recording to read again, as PNG: some 0.4 MB
 *  per keyframe of 640x480, without loss. The camera is the body; images are known by their
 *  stamps. */
class PackedImages final : public KeyframeImages {
  public:
    explicit PackedImages(Camera camera) : camera_(std::move(camera)) {}

    void add(const RgbdImage& image);
    /** Those of a stamp that there is none of are never asked for again. */
    void drop(double stamp_s) { packed_.erase(stamp_s); }
    bool has(double stamp_s) const { return packed_.count(stamp_s) > 0; }

    /** There is nothing to note. */
    std::size_t forEach(const Trajectory& keyframes, const std::string& label,
                        const Consume& consume, const Note& note = {}) const override;

  private:
    struct Packed {
        double depth_unit_m = 0.001;
        std::vector<unsigned char> color, depth;  // PNG; color may be gray
    };
    static RgbdImage unpacked(double stamp_s, const Packed& packed);

    Camera camera_;
    std::map<double, Packed> packed_;
};

}  // namespace rgbd_graphslam
