/** A 2-D laser scanner on the planar robot. */
#pragma once
#include <vector>

#include "rgbd_graphslam/synth/random.h"
#include "rgbd_graphslam/synth/scenario.h"

namespace rgbd_graphslam::synth {

/** Field of view, rate and errors of a common scanner. */
struct ScannerModel {
    double field_deg = 270, step_deg = 0.25;
    double hertz = 40;
    double noise_m = 0.01, max_range_m = 30;
    /** Glass throws back only beams that meet it this steeply; others pass. */
    double pane_deg = 45;

    std::size_t beams() const { return static_cast<std::size_t>(field_deg / step_deg + 1.5); }
};

/** Where it sits on the robot: level, looking ahead. */
SE3 robotScanner();

/** Cuts the scene at the height of the scanner and measures along its beams. */
class LaserScanner {
  public:
    /** \param world of a planar robot; it and `scene` must outlive the scanner */
    LaserScanner(const World& world, const Scene& scene, const ScannerModel& model,
                 std::uint64_t seed);

    /** Ranges from right to left, m; 0 where nothing is met. All beams of a scan are of the same
     *  moment. \param index of the scan, which its noise depends on */
    std::vector<double> scan(double t, std::uint64_t index) const;

  private:
    struct Segment {
        Eigen::Vector2d from, to;
        bool is_pane = false;
    };

    void cut(const std::vector<Quad>& quads, const SE3& T_world_body, bool is_pane,
             std::vector<Segment>& segments) const;
    double range(const Eigen::Vector2d& origin, const Eigen::Vector2d& beam,
                 const std::vector<Segment>& segments) const;

    const World& world_;
    const Scene& scene_;
    ScannerModel model_;
    std::uint64_t seed_;
    std::vector<Segment> still_;
};

}  // namespace rgbd_graphslam::synth
