#include "sparse_map_upgrade.h"

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/slam/map_encoding.h"

namespace rgbd_graphslam {
namespace {

constexpr std::uint8_t first_camera = 0;

/** Reads version 2 and writes version 3, most of it as it stands. */
class Upgrade {
  public:
    explicit Upgrade(std::string_view payload) : in_(payload) {}

    std::string run() {
        copyText();  // of the settings
        copy(pose_bytes);
        copySessions();
        putRig();
        copy(sizeof(double) + sizeof(std::int32_t));  // the image pyramid
        for (std::size_t left = copyCount(); left > 0; --left) copyKeyframe();
        for (std::size_t left = copyCount(); left > 0; --left) copyLandmark();
        copy(in_.left());
        return out_.take();
    }

  private:
    void copy(std::size_t bytes) { out_.putBytes(in_.getBytes(bytes)); }

    template <class Number>
    Number copyNumber() {
        const auto number = in_.get<Number>();
        out_.put(number);
        return number;
    }

    /** Items of a byte and more, so that no count is believed beyond the data. */
    std::size_t copyCount() {
        const std::size_t count = in_.getCount(1);
        out_.putCount(count);
        return count;
    }

    void copyText() { copy(copyCount()); }

    void copySessions() {
        for (std::size_t left = copyCount(); left > 0; --left) {
            copyText();
            copy(sizeof(std::int32_t));
        }
    }

    void putRig() {
        const std::string no_label;
        out_.putCount(1);
        out_.putText(no_label);
        copy(2 * sizeof(std::int32_t) + 4 * sizeof(double));
        putLens();
        encodePose(SE3(), out_);
    }

    void putLens() {
        BrownLens lens;
        constexpr std::size_t coefficients = 5;
        for (std::size_t i = 0; i < coefficients; ++i) lens.coefficients[i] = in_.get<double>();
        const std::vector<double> all = lensCoefficients(lens);
        out_.putText(lensModel(lens));
        out_.putCount(all.size());
        for (const double k : all) out_.put(k);
    }

    void copyKeyframe() {
        copy(sizeof(double));  // the stamp
        for (std::size_t left = copyCount(); left > 0; --left) copyKeypoint();
        copy(pose_bytes + sizeof(std::uint32_t) + 1);  // with submap and link
        const bool culled = copyNumber<std::uint8_t>() != 0;
        if (culled) copy(sizeof(std::uint32_t) + pose_bytes);
    }

    void copyKeypoint() {
        copy(4 * sizeof(float) + 2);
        out_.put(first_camera);
        copy(sizeof(Descriptor));
    }

    void copyLandmark() {
        copy(7 * sizeof(double) + sizeof(Descriptor));
        const bool has_patch = copyNumber<std::uint8_t>() != 0;
        if (has_patch) copyPatch();
        copy(3 * sizeof(std::uint32_t));
        copy(copyCount() * 2 * sizeof(std::uint32_t));
    }

    void copyPatch() {
        copy(1);  // the octave
        out_.put(first_camera);
        copy(2 * sizeof(float) + Patch().gray.size());
    }

    ByteReader in_;
    ByteWriter out_;
};

}  // namespace

std::string upgradeFromVersion2(std::string_view payload) {
    return Upgrade(payload).run();
}

}  // namespace rgbd_graphslam
