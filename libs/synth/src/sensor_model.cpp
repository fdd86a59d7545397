#include "rgbd_graphslam/synth/sensor_model.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam::synth {

namespace {
const FastNormal& fastNormal() {
    static const FastNormal table;
    return table;
}

cv::Mat normalField(cv::Size size, Random& random) {
    cv::Mat field(size, CV_32FC1);
    const FastNormal& normal = fastNormal();
    for (int v = 0; v < size.height; ++v) {
        float* row = field.ptr<float>(v);
        for (int u = 0; u < size.width; ++u) row[u] = normal(random);
    }
    return field;
}

/** Neighboring readings come from overlapping windows of the pattern: half of the noise is shared
 *  with the neighbors. Deviation 1. */
cv::Mat correlatedField(cv::Size size, Random& random) {
    const cv::Mat shared = normalField(size, random), own = normalField(size, random);
    cv::Mat smooth;
    cv::blur(shared, smooth, {3, 3});
    return std::sqrt(0.5) * (3 * smooth + own);
}

/** Marks pixels that the projector, a baseline to the right of the camera, cannot light because
 *  something nearer stands between: they lie at the left of that thing. */
void dropShadows(const cv::Mat& truth, double disparity_m_px, cv::Mat& readings) {
    for (int v = 0; v < truth.rows; ++v) {
        const float* z = truth.ptr<float>(v);
        float* out = readings.ptr<float>(v);
        double nearest = 1e9;
        for (int u = truth.cols - 1; u >= 0; --u) {
            if (z[u] <= 0) continue;
            const double lit_from = u - disparity_m_px / z[u];
            if (lit_from > nearest + 1) out[u] = 0;
            nearest = std::min(nearest, lit_from);
        }
    }
}

/** Cosine between the ray and the surface's normal, from the slopes of the inverse depth, which
 *  are constant over a plane. */
double incidenceCosine(const cv::Mat& truth, const Camera& camera, int u, int v) {
    const double z = truth.at<float>(v, u);
    const double right = truth.at<float>(v, u + 1), below = truth.at<float>(v + 1, u);
    if (right <= 0 || below <= 0) return 0;
    const Eigen::Vector2d focal_px = camera.pixelsPerRadian();
    const double slope_u = (1 / right - 1 / z) * focal_px.x(),
                 slope_v = (1 / below - 1 / z) * focal_px.y();
    const Eigen::Vector2d ray = camera.toPlane(Eigen::Vector2d(u, v));
    const double x = ray.x(), y = ray.y();
    const double along = 1 / z - slope_u * x - slope_v * y;
    const double normal = std::sqrt(slope_u * slope_u + slope_v * slope_v + along * along);
    return (1 / z) / (normal * std::sqrt(x * x + y * y + 1));
}

cv::Mat displaced(const cv::Mat& truth, double deviation_px, Random& random) {
    const cv::Mat du = normalField(truth.size(), random), dv = normalField(truth.size(), random);
    cv::Mat seen(truth.size(), CV_32FC1);
    for (int v = 0; v < truth.rows; ++v)
        for (int u = 0; u < truth.cols; ++u) {
            const long x = std::lround(u + deviation_px * du.at<float>(v, u));
            const long y = std::lround(v + deviation_px * dv.at<float>(v, u));
            seen.at<float>(v, u) =
                truth.at<float>(static_cast<int>(std::min(std::max(y, 0L), truth.rows - 1L)),
                                static_cast<int>(std::min(std::max(x, 0L), truth.cols - 1L)));
        }
    return seen;
}

/** One reading of a surface at z, as a whole number of disparity steps. */
double measured(double z, double deviate, double disparity_m_px, const DepthSensorModel& model) {
    const double step_m = z * z * model.disparity_step_px / disparity_m_px;
    const double sigma = model.noise.sigma(z);
    const double rest = std::sqrt(std::max(0.0, sigma * sigma - step_m * step_m / 12));
    const double disparity = disparity_m_px / std::max(0.1, z + rest * deviate);
    const double steps = std::round(disparity / model.disparity_step_px);
    return steps > 0 ? disparity_m_px / (steps * model.disparity_step_px) : 0;
}
}  // namespace

cv::Mat senseDepth(const cv::Mat& depth, const Camera& camera, const DepthSensorModel& model,
                   Random random) {
    const double disparity_m_px = model.baseline_m * model.focal_px;
    const cv::Mat seen = displaced(depth, model.lateral_px, random);
    const cv::Mat deviate = correlatedField(depth.size(), random);
    // Whole patches of a far surface come and go together.
    cv::Mat fading;
    cv::resize(normalField(depth.size() / 4, random), fading, depth.size(), 0, 0, cv::INTER_LINEAR);
    cv::Mat readings(depth.size(), CV_32FC1, cv::Scalar(0));
    for (int v = 0; v + 1 < depth.rows; ++v)
        for (int u = 0; u + 1 < depth.cols; ++u) {
            const double z = seen.at<float>(v, u);
            const double share = (z - model.fading_from_m) / (model.max_m - model.fading_from_m);
            const bool lost = random.chance(model.speckle_loss);
            if (lost || z < model.min_m || z > model.max_m) continue;
            if (share > 0.5 + 0.3 * fading.at<float>(v, u)) continue;
            if (incidenceCosine(depth, camera, u, v) < model.grazing_cosine) continue;
            readings.at<float>(v, u) =
                static_cast<float>(measured(z, deviate.at<float>(v, u), disparity_m_px, model));
        }
    dropShadows(depth, model.baseline_m * camera.pixelsPerRadian().x(), readings);
    return readings;
}

cv::Mat toDepthUnits(const cv::Mat& depth_m) {
    cv::Mat units(depth_m.size(), CV_16UC1);
    for (int v = 0; v < units.rows; ++v)
        for (int u = 0; u < units.cols; ++u) {
            const long value = std::lround(5000.0 * depth_m.at<float>(v, u));
            units.at<std::uint16_t>(v, u) = value > 65535 ? 0 : static_cast<std::uint16_t>(value);
        }
    return units;
}

cv::Mat senseColor(const cv::Mat& picture, double exposure, double gain,
                   const ColorSensorModel& model, Random random) {
    cv::Mat light;
    picture.convertTo(light, CV_32FC3, exposure / gain);
    const FastNormal& normal = fastNormal();
    float deviation[256];
    for (int level = 0; level < 256; ++level)
        deviation[level] = static_cast<float>(std::sqrt(
            model.read_noise * model.read_noise + model.shot_noise * model.shot_noise * level));
    cv::Mat sensed(picture.size(), CV_8UC3);
    const int values = picture.cols * 3;
    for (int v = 0; v < picture.rows; ++v) {
        const float* from = light.ptr<float>(v);
        auto* to = sensed.ptr<uchar>(v);
        for (int i = 0; i < values; ++i) {
            const int level = std::min(255, static_cast<int>(from[i]));
            const float value = from[i] + deviation[level] * normal(random);
            to[i] = cv::saturate_cast<uchar>(static_cast<float>(gain) * value);
        }
    }
    return sensed;
}

}  // namespace rgbd_graphslam::synth
