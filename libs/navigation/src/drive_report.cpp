#include "rgbd_graphslam/navigation/drive_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

namespace rgbd_graphslam {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

const cv::Scalar orange(20, 120, 240), blue(200, 90, 30), green(70, 150, 40), dark(60, 60, 60);
constexpr int longer_side_px = 1400, margin_px = 20;

/** The part of the grid that is known, enlarged, with meters on it. */
class Paper {
  public:
    explicit Paper(const mrpt::maps::COccupancyGridMap2D& grid)
        : left_m_(grid.getXMin()), top_m_(grid.getYMax()) {
        const int cells = std::max<int>(grid.getSizeX(), grid.getSizeY());
        const int zoom = std::max(1, (longer_side_px - 2 * margin_px) / std::max(cells, 1));
        pixels_per_m_ = zoom / grid.getResolution();
        const int height = static_cast<int>(grid.getSizeY()),
                  width = static_cast<int>(grid.getSizeX());
        cv::Mat1b shades(height, width);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x)
                shades(height - 1 - y, x) =
                    cv::saturate_cast<std::uint8_t>(60 + 195 * grid.getCell(x, y));
        }
        cv::resize(shades, shades, {}, zoom, zoom, cv::INTER_NEAREST);
        cv::cvtColor(shades, picture, cv::COLOR_GRAY2BGR);
        cv::copyMakeBorder(picture, picture, margin_px, margin_px, margin_px, margin_px,
                           cv::BORDER_CONSTANT, cv::Scalar::all(158));
    }

    cv::Point at(double x, double y) const {
        return {margin_px + static_cast<int>(std::lround((x - left_m_) * pixels_per_m_)),
                margin_px + static_cast<int>(std::lround((top_m_ - y) * pixels_per_m_))};
    }
    double pixelsPerMetre() const { return pixels_per_m_; }

    cv::Mat3b picture;

  private:
    double left_m_, top_m_, pixels_per_m_;
};

void drawObstacles(Paper& paper, const PointMap& obstacles) {
    const cv::Rect bounds({}, paper.picture.size());
    for (const auto& [p, rgb] : obstacles) {
        const cv::Point pixel = paper.at(p.x(), p.y());
        if (bounds.contains(pixel)) paper.picture(pixel) = {rgb[2], rgb[1], rgb[0]};
    }
}

template <class Pose>
std::vector<cv::Point> pixelsOf(const Paper& paper, const std::vector<Pose>& poses) {
    std::vector<cv::Point> pixels;
    pixels.reserve(poses.size());
    for (const auto& p : poses) pixels.push_back(paper.at(p.x, p.y));
    return pixels;
}

void drawBody(Paper& paper, const RobotBody& body, const TPose2D& pose) {
    const double c = std::cos(pose.phi), s = std::sin(pose.phi);
    for (const BodyLevel& level : body) {
        std::vector<cv::Point> corners;
        for (const Eigen::Vector2d& p : level.outline) {
            corners.push_back(
                paper.at(pose.x + c * p.x() - s * p.y(), pose.y + s * p.x() + c * p.y()));
        }
        cv::polylines(paper.picture, corners, true, orange, 2, cv::LINE_AA);
    }
    cv::line(paper.picture, paper.at(pose.x, pose.y), paper.at(pose.x + 0.2 * c, pose.y + 0.2 * s),
             orange, 2, cv::LINE_AA);
}

void drawScale(Paper& paper) {
    const cv::Point left(margin_px, paper.picture.rows - margin_px / 2);
    const cv::Point bar(static_cast<int>(std::lround(paper.pixelsPerMetre())), 0);
    cv::line(paper.picture, left, left + bar, dark, 3);
    cv::putText(paper.picture, "1 m", left + cv::Point(4, -6), cv::FONT_HERSHEY_SIMPLEX, 0.5, dark,
                1, cv::LINE_AA);
}

std::vector<TPose2D> posesOf(const Drive& drive) {
    std::vector<TPose2D> poses;
    for (const DrivenPose& driven : drive.path) poses.push_back(driven.pose);
    return poses;
}

}  // namespace

std::string pathCsv(const Drive& drive, const std::vector<double>& clearances_m) {
    std::string csv = "time_s,x_m,y_m,phi_rad,speed_m_s,turn_rad_s";
    csv += clearances_m.empty() ? "\n" : ",clearance_m\n";
    for (std::size_t i = 0; i < drive.path.size(); ++i) {
        const DrivenPose& p = drive.path[i];
        char line[160];
        std::snprintf(line, sizeof(line), "%.2f,%.4f,%.4f,%.4f,%.3f,%.3f", p.time_s, p.pose.x,
                      p.pose.y, p.pose.phi, p.speed_m_s, p.turn_rad_s);
        csv += line;
        if (!clearances_m.empty()) {
            std::snprintf(line, sizeof(line), ",%.3f", clearances_m[i]);
            csv += line;
        }
        csv += '\n';
    }
    return csv;
}

cv::Mat3b drivePicture(const NavigationMap& map, const Route& route,
                       const std::vector<TPose2D>& motion, const Drive& drive,
                       const RobotBody& body) {
    Paper paper(map.grid);
    drawObstacles(paper, map.obstacles);
    for (const cv::Point& p : pixelsOf(paper, route))
        cv::circle(paper.picture, p, 4, blue, cv::FILLED, cv::LINE_AA);
    cv::polylines(paper.picture, pixelsOf(paper, motion), false, green, 2, cv::LINE_AA);
    const auto poses = posesOf(drive);
    cv::polylines(paper.picture, pixelsOf(paper, poses), false, orange, 2, cv::LINE_AA);
    drawBody(paper, body, poses.front());
    drawBody(paper, body, poses.back());
    drawScale(paper);
    return paper.picture;
}

}  // namespace rgbd_graphslam
