/** Furnishes a scene: walls, furniture and clutter, placed by frames on the floor. */
#pragma once
#include <vector>

#include "rgbd_graphslam/synth/random.h"
#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

/** A doorway or passage in a wall. */
struct Opening {
    double along_m = 0;  // of its middle, from where the wall begins
    double width_m = 1;
    double height_m = 2.1;
};

/** Ground plan of a room, meters. */
struct Floor {
    double min_x = 0, max_x = 1, min_y = 0, max_y = 1;
    double height = 2.7;
};

/** Builds furniture with a stock of materials of its own. Frames stand on the floor unless said
 *  otherwise, and furniture looks along their +x, with its back at x = 0 or its middle there. */
class Furnisher {
  public:
    /** Every picture is painted from the seed.
     *  \param variety multiplies the number of different prints; a large place needs more, lest its
     *         rooms look alike */
    Furnisher(Scene& scene, std::uint64_t seed, int variety = 1);

    // The building.
    enum class Covering { Parquet, Carpet, Tiles };
    void floorAndCeiling(const Floor& floor, Covering covering);
    /** A wall of 12 cm between two points of the ground plan, with skirting boards and door
     *  frames. \param paint material of the wall, e.g. plaster() */
    void wall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height, int paint,
              const std::vector<Opening>& openings = {});
    int plaster(int style) const { return plaster_[style % plaster_.size()]; }
    int bricks() const { return bricks_; }
    void ceilingLamp(double x, double y, double ceiling_z, double intensity);

    // On a wall: frames at the middle of the lower edge, looking into the room.
    void poster(const SE3& frame, double width, double height);
    void art(const SE3& frame, double width, double height);
    void whiteboard(const SE3& frame);
    void window(const SE3& frame, double width, double height, double intensity);
    void door(const SE3& frame);
    void clock(const SE3& frame);
    void radiator(const SE3& frame, double width);
    /** A row of posters, pictures and notes. */
    void wallClutter(const SE3& frame, double width);

    // On the floor.
    void table(const SE3& frame, const Eigen::Vector3d& size);
    /** Table with drawers, screens, keyboard, papers, cups and a chair in front (+x). */
    void workplace(const SE3& frame, double width, bool chair_too = true);
    void chair(const SE3& frame);
    void shelf(const SE3& frame, double width, double height, int boards);
    void cabinet(const SE3& frame, double width, double height);
    void sofa(const SE3& frame, double width);
    void plant(const SE3& frame, double height);
    void floorLamp(const SE3& frame);
    void bin(const SE3& frame);
    void rug(const SE3& frame, double length, double width);
    void cardboardPile(const SE3& frame, int count);

    // On a table top: `frame` at its surface.
    void monitor(const SE3& frame);
    void cup(const SE3& frame);
    void bookPile(const SE3& frame, int count);
    void papers(const SE3& frame, int count);
    void package(const SE3& frame);
    /** Small things scattered over a rectangle centerd on the frame. */
    void clutter(const SE3& frame, double length, double width, int count);

    /** Appends the figures of a person: the trunk with its head, standing at its origin, and two
     *  legs and two arms, hanging down from theirs. */
    void person();

  private:
    void box(const SE3& frame, const Eigen::Vector3d& size, const BoxSkin& skin);
    void cylinder(const SE3& frame, double radius, double top_radius, double height,
                  const Skin& side, const Skin& cap);
    void panel(const SE3& frame, double width, double height, double depth, const Skin& front);
    void bookRow(const SE3& frame, double width, double headroom);
    void packageRow(const SE3& frame, double width, double headroom);
    MovingBody trunk(const Skin& shirt);
    MovingBody limb(double length, double thickness, const Skin& cloth, bool with_shoe);
    Skin anyOf(const std::vector<int>& materials);
    Skin spine();

    Scene& scene_;
    Random random_;
    std::vector<int> plaster_, woods_, fabrics_, posters_, arts_, papers_, screens_, boxes_,
        packages_, clothes_, metals_, spines_, doors_, windows_, rugs_, floors_;
    int bricks_, ceiling_, lamp_, keyboard_, leaves_, whiteboard_, clock_, white_, black_, face_;
};

}  // namespace rgbd_graphslam::synth
