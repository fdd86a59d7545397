/** What a structured-light RGB-D camera makes of a scene: noise, holes, blur, exposure. */
#pragma once
#include <opencv2/core/mat.hpp>

#include "rgbd_graphslam/geometry/camera.h"
#include "rgbd_graphslam/geometry/depth_noise.h"
#include "rgbd_graphslam/synth/random.h"

namespace rgbd_graphslam::synth {

/** The Kinect: disparities are measured in steps, far and grazing surfaces and the shadow of the
 *  projector give nothing. */
struct DepthSensorModel {
    DepthNoise noise;
    double baseline_m = 0.075;
    double focal_px = 580;  // of the infrared camera, 640 pixels wide
    double disparity_step_px = 0.125;
    double min_m = 0.45;
    double fading_from_m = 4.0, max_m = 5.0;  // readings get rare between the two
    double grazing_cosine = 0.17;             // surfaces seen flatter than this give nothing
    double lateral_px = 0.6;                  // deviation of where a pixel looks; frays edges
    double speckle_loss = 0.002;              // share of readings lost anywhere
};

/** \param depth CV_32FC1, true depth (m), 0 = none
 *  \return CV_32FC1, readings (m), 0 = none. Away from edges their deviation is noise.sigma(z),
 *          quantization included. */
cv::Mat senseDepth(const cv::Mat& depth, const Camera& camera, const DepthSensorModel& model,
                   Random random);

/** \return CV_16UC1 in units of 1/5000 m, 0 = none; too far for the format is none */
cv::Mat toDepthUnits(const cv::Mat& depth_m);

/** Signal-dependent and read-out noise, gray levels of 255. */
struct ColorSensorModel {
    double read_noise = 1.1;
    double shot_noise = 0.13;  // deviation at level I is shot_noise * sqrt(I)
};

/** \param picture CV_8UC3 or CV_32FC3 of levels 0..255
 *  \param exposure factor of the brightness
 *  \param gain of the amplifier, which multiplies the noise
 *  \return CV_8UC3 */
cv::Mat senseColor(const cv::Mat& picture, double exposure, double gain,
                   const ColorSensorModel& model, Random random);

}  // namespace rgbd_graphslam::synth
