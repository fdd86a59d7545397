/** Depth images that say "no reading" by a value other than 0. */
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace rgbd_graphslam {

/** Looks for one exact value beyond all readings, far from the next, in most images: the end of the
 *  range of 16 bits or a round distance at which a driver cuts off. */
class NoReadingCheck {
  public:
    explicit NoReadingCheck(double unit_m) : unit_m_(unit_m) {}

    /** \param depth CV_16UC1, 0 = no reading */
    void add(const cv::Mat& depth);

    struct Finding {
        std::uint16_t value = 0;
        double distance_m = 0;
        /** Of the pixels of all images. */
        double share = 0;

        /** A line for the user. */
        std::string text() const;
    };
    std::optional<Finding> finding() const;

  private:
    bool isUsual(std::uint16_t value) const;

    struct Candidate {
        std::size_t images = 0;
        double shares = 0;
    };
    double unit_m_;
    std::size_t images_ = 0;
    std::map<std::uint16_t, Candidate> candidates_;
};

}  // namespace rgbd_graphslam
