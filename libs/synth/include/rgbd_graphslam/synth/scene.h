/** What there is to be seen: textured quadrilaterals, in meters, z up, floor at z = 0. */
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "rgbd_graphslam/geometry/se3.h"
#include "rgbd_graphslam/synth/labels.h"

namespace rgbd_graphslam::synth {

/** A picture laid over surfaces. */
struct Material {
    cv::Mat image;  // CV_8UC3, BGR
    /** Side of the square that the image covers when it repeats (m); 0: the image is fitted to
     *  each face. */
    double tile_m = 0;
    /** Share of the light that it gives off by itself, e.g. 1 for a lamp. */
    double glow = 0;
};

/** A plane face with corners counter-clockwise seen from the front. */
struct Quad {
    std::array<Eigen::Vector3d, 4> corners;
    std::array<Eigen::Vector2d, 4> uv;  // (0, 0) top left of the image, (1, 1) bottom right
    int material = 0;
    Label label = Label::None;

    Eigen::Vector3d normal() const {
        return (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
    }
};

/** A part of a material's image, (0, 0)-(1, 1) is all of it. */
struct Skin {
    int material = 0;
    Eigen::Vector2d uv_min{0, 0}, uv_max{1, 1};
};

/** The skin of a face that nobody can see, which is left out. */
const Skin kHidden{-1};

/** Skins of a box whose front looks along +x of its own frame. */
struct BoxSkin {
    Skin front, back, sides, top, bottom;
    BoxSkin(const Skin& all) : front(all), back(all), sides(all), top(all), bottom(all) {}
    BoxSkin(const Skin& front_skin, const Skin& others) : BoxSkin(others) { front = front_skin; }
};

/** A point light. */
struct Lamp {
    Eigen::Vector3d position;
    double intensity = 1;           // irradiance at 1 m straight below
    Eigen::Vector3d tint{1, 1, 1};  // blue, green, red
};

/** Faces that move together, in a frame of their own. */
struct MovingBody {
    std::vector<Quad> quads;
    /** Where its faces take their light from the scene: light is baked and does not change as the
     *  body moves. Maps the body's coordinates to the world. */
    Eigen::Affine3d lit_at = Eigen::Affine3d::Identity();
};

/** All that a renderer needs. */
struct Scene {
    std::vector<Material> materials;
    std::vector<Quad> quads;
    std::vector<Lamp> lamps;
    std::vector<MovingBody> figures;
    /** Light from everywhere; small in a dark room. */
    double ambient = 0.55;

    int addMaterial(const cv::Mat& image, double tile_m = 0, double glow = 0);
};

/** Gives a label to all faces from `first` on that have none. */
void label(std::vector<Quad>& quads, Label label, std::size_t first = 0);

/** Labels the faces that are appended during its life and have no label at its end: what is put
 *  together of things with labels of their own keeps those. */
class Labeling {
  public:
    Labeling(std::vector<Quad>& quads, Label label)
        : quads_(quads), label_(label), first_(quads.size()) {}
    ~Labeling() { label(quads_, label_, first_); }
    Labeling(const Labeling&) = delete;
    Labeling& operator=(const Labeling&) = delete;

  private:
    std::vector<Quad>& quads_;
    Label label_;
    std::size_t first_;
};

/** Appends a rectangle. `frame` maps its own coordinates to the scene: it spans y in [0, width]
 *  to the left seen from behind, z in [0, height], and looks along +x. */
void addRectangle(const Scene& scene, std::vector<Quad>& quads, const SE3& frame, double width,
                  double height, const Skin& skin);

/** Appends a box standing on z = 0 of `frame`, centerd in x and y. \param size (m) along x, y, z */
void addBox(const Scene& scene, std::vector<Quad>& quads, const SE3& frame,
            const Eigen::Vector3d& size, const BoxSkin& skin);

/** Appends an upright cylinder (or cone frustum) standing on z = 0 of `frame`, of flat sides. */
void addCylinder(std::vector<Quad>& quads, const SE3& frame, double radius, double top_radius,
                 double height, const Skin& side, const Skin& cap, int sides = 16);

/** Frame at a position, turned about the vertical. \param yaw_rad 0 looks along +x */
SE3 standing(double x, double y, double z, double yaw_rad);

}  // namespace rgbd_graphslam::synth
