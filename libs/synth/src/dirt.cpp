#include "dirt.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {

namespace {
const cv::Size kSize(1280, 960);
constexpr int kSpecks = 14, kSmears = 4;
const cv::Scalar kSpeckColor(28, 34, 38);

/** A blot of irregular outline. \param softness of its rim, as a share of the radius */
void blot(cv::Mat& cover, const cv::Mat& ragged, const cv::Point2d& at, double radius_px,
          double softness) {
    const cv::Point corner(cvRound(at.x - 2 * radius_px), cvRound(at.y - 2 * radius_px));
    const int side = cvRound(4 * radius_px);
    const cv::Rect box = cv::Rect(corner, cv::Size(side, side)) & cv::Rect({0, 0}, cover.size());
    for (int v = box.y; v < box.br().y; ++v)
        for (int u = box.x; u < box.br().x; ++u) {
            const double distance = std::hypot(u - at.x, v - at.y) / radius_px;
            const double depth = 1 - distance + 0.45 * ragged.at<float>(v, u);
            float& pixel = cover.at<float>(v, u);
            pixel = std::max(pixel, static_cast<float>(std::clamp(depth / softness, 0.0, 1.0)));
        }
}

cv::Mat blots(int count, double least_px, double most_px, double softness, Random& random) {
    cv::Mat cover = cv::Mat::zeros(kSize, CV_32FC1);
    const cv::Mat ragged = fractalNoise(kSize, {24, 18}, 4, 0.7, random);
    for (int i = 0; i < count; ++i) {
        const double x = random.uniform(0.05, 0.95) * kSize.width;
        const double y = random.uniform(0.05, 0.95) * kSize.height;
        blot(cover, ragged, {x, y}, random.uniform(least_px, most_px), softness);
    }
    return cover;
}

cv::Mat fitted(const cv::Mat& cover, cv::Size size) {
    cv::Mat small;
    cv::resize(cover, small, size, 0, 0, cv::INTER_AREA);
    return small;
}

/** picture = picture * (1 - share) + other * share */
void blend(cv::Mat& picture, const cv::Mat& other, const cv::Mat& share) {
    for (int v = 0; v < picture.rows; ++v)
        for (int u = 0; u < picture.cols; ++u) {
            const float part = share.at<float>(v, u);
            auto& pixel = picture.at<cv::Vec3f>(v, u);
            pixel = pixel * (1 - part) + other.at<cv::Vec3f>(v, u) * part;
        }
}
}  // namespace

LensDirt::LensDirt(std::uint64_t seed) {
    Random random = Random::of(seed, 29);
    specks_ = 0.95 * blots(kSpecks, 18, 60, 0.25, random);
    smears_ = blots(kSmears, 110, 190, 0.4, random);
}

void LensDirt::spoil(cv::Mat& picture, const SE3&, const Camera&) const {
    cv::Mat blurred;
    cv::GaussianBlur(picture, blurred, {}, 0.012 * picture.cols);
    blend(picture, blurred, fitted(smears_, picture.size()));
    blend(picture, cv::Mat(picture.size(), CV_32FC3, kSpeckColor), fitted(specks_, picture.size()));
}

void LensDirt::mark(cv::Mat& mask, const SE3&, const Camera&) const {
    mask.setTo(255, fitted(specks_, mask.size()) > 0.5);
    mask.setTo(255, fitted(smears_, mask.size()) > 0.5);
}

}  // namespace rgbd_graphslam::synth
