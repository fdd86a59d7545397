/** Painters of procedural pictures, CV_8UC3 in BGR. All of them have detail at several scales, so
 *  that features are found near and far; the same generator state gives the same picture. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/synth/random.h"

namespace rgbd_graphslam::synth {

using Bgr = cv::Scalar;

/** A strong color of printed matter, or a quiet one of furniture and clothes. */
Bgr vividColor(Random& random);
Bgr quietColor(Random& random);

/** Sum of `octaves` tileable value noises, each twice as fine and `persistence` as strong as the
 *  one before. \param cells of the coarsest along x and y \return CV_32FC1, about [-1, 1] */
cv::Mat fractalNoise(cv::Size size, cv::Size cells, int octaves, double persistence,
                     Random& random);

// Surfaces that repeat.
cv::Mat paintPlaster(const Bgr& color, double contrast, Random& random);
cv::Mat paintCarpet(const Bgr& color, Random& random);
cv::Mat paintParquet(Random& random);
cv::Mat paintTiles(const Bgr& color, Random& random);
cv::Mat paintBricks(Random& random);
cv::Mat paintWood(const Bgr& color, Random& random);
cv::Mat paintCeiling(Random& random);
cv::Mat paintFabric(const Bgr& color, Random& random);
cv::Mat paintMetal(const Bgr& color, Random& random);

// Things that are fitted to a face.
cv::Mat paintPoster(Random& random);
cv::Mat paintArt(Random& random);
cv::Mat paintPaper(Random& random);
cv::Mat paintScreen(Random& random);
cv::Mat paintKeyboard(Random& random);
cv::Mat paintCardboard(Random& random);
cv::Mat paintDoor(const Bgr& color, Random& random);
cv::Mat paintWindow(Random& random);
cv::Mat paintRug(Random& random);
cv::Mat paintLeaves(Random& random);
cv::Mat paintPackage(Random& random);
cv::Mat paintWhiteboard(Random& random);
cv::Mat paintClock();
/** \param count spines side by side, each the same width */
cv::Mat paintBookSpines(int count, Random& random);
cv::Mat paintFace(Random& random);

}  // namespace rgbd_graphslam::synth
