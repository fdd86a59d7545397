#include "motion_section.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/report/html.h"

namespace rgbd_graphslam {
namespace {

using Json = nlohmann::json;

/** Adds the figures that a sensor has. */
class Figures {
  public:
    Figures(const Json& sensor, const char* name, std::vector<MotionFigure>& out)
        : sensor_(sensor), name_(name), out_(out) {}

    void number(const char* key, const char* figure, const char* format) {
        const Json value = sensor_.value(key, Json());
        if (value.is_number()) add(figure, formatted(format, value.get<double>()));
    }
    void vector(const char* key, const char* sigma_key, const char* figure, const char* unit) {
        const Json value = sensor_.value(key, Json()), sigma = sensor_.value(sigma_key, Json());
        if (!value.is_array() || value.size() != 3 || !sigma.is_number()) return;
        add(figure,
            formatted("%.4f, %.4f, %.4f ± %.4f %s", value[0].get<double>(), value[1].get<double>(),
                      value[2].get<double>(), sigma.get<double>(), unit));
    }
    void spread(const char* figure) {
        const Json value = sensor_.value("residuals", Json());
        if (!value.is_object()) return;
        add(figure,
            formatted("%.2f times the expected, of %.0f",
                      std::sqrt(value.value("mean_square", 0.0)), value.value("count", 0.0)));
    }
    void slips() {
        const Json slips = sensor_.value("slips_s", Json());
        if (!slips.is_array()) return;
        double total_s = 0;
        for (const Json& slip : slips)
            total_s += slip.at(1).get<double>() - slip.at(0).get<double>();
        add("slips", formatted("%zu, %.1f s in all", slips.size(), total_s));
    }
    void add(const char* figure, const std::string& value) {
        out_.push_back({name_, figure, value});
    }

  private:
    const Json& sensor_;
    const char* name_;
    std::vector<MotionFigure>& out_;
};

}  // namespace

std::vector<MotionFigure> motionFigures(const nlohmann::json& motion) {
    std::vector<MotionFigure> figures;
    if (!motion.is_object()) return figures;
    const Json imu = motion.value("imu", Json()), wheels = motion.value("wheels", Json());
    if (imu.is_object()) {
        Figures of(imu, "IMU", figures);
        of.number("rate_hz", "rate", "%.0f Hz");
        of.number("longest_gap_s", "longest gap", "%.3f s");
        of.number("stamps_late_s", "stamps late by", "%.4f s");
        if (!imu.value("used", false)) of.add("used", "no: it never fitted the camera's motion");
        of.vector("gyro_bias_rad_s", "gyro_bias_sigma_rad_s", "gyroscope's bias", "rad/s");
        of.vector("accelerometer_bias_m_s2", "accelerometer_bias_sigma_m_s2",
                  "accelerometer's bias", "m/s²");
        of.spread("camera against prediction");
    }
    if (wheels.is_object()) {
        Figures of(wheels, "wheels", figures);
        of.number("rate_hz", "rate", "%.0f Hz");
        of.number("longest_gap_s", "longest gap", "%.3f s");
        of.number("scale", "true way per way told", "%.4f");
        of.spread("wheels against camera and IMU");
        of.slips();
    }
    return figures;
}

std::string motionSection(const RunRecord& run) {
    if (run.motion.empty()) return {};
    std::string html =
        "<table class=\"quality\"><tr><th>sensor</th><th>figure</th><th>value</th></tr>\n";
    for (const MotionFigure& figure : run.motion) {
        html += "<tr><td>" + htmlEscaped(figure.sensor) + "</td><td>" + htmlEscaped(figure.figure) +
                "</td><td>" + htmlEscaped(figure.value) + "</td></tr>\n";
    }
    return html +
           "</table><p class=\"note\">Spreads far from 1 tell of noise that is not as "
           "supposed, of vibration, or of clocks that differ.</p>\n";
}

}  // namespace rgbd_graphslam
