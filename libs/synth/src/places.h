/** The places that scenarios play in. */
#pragma once
#include <cstdint>

#include "rgbd_graphslam/synth/scene.h"

namespace rgbd_graphslam::synth {

enum class Office {
    Furnished,  // four workplaces around a table in the middle
    DeskFree,   // nothing in front of the desk at (1.5, 0.5), and more on it
    OpenMiddle  // room to walk in the middle
};

/** An office of 6.4 x 5.2 m; origin in a corner. */
Scene officeRoom(Office layout, std::uint64_t seed);

/** Living room and study side by side, 10 x 5 m, joined by doorways at y = 1 and y = 4; a way of
 *  1.6 m along those lines and between them is free. */
Scene apartment(std::uint64_t seed);

/** A storey of 24 x 15 m: corridor, lounge, library, study, meeting room and copy room in a ring.
 *  Free along the lines y = 1.1, x = 21.8, y = 12.5, x = 2.2. */
Scene storey(std::uint64_t seed);

/** Plain walls with pillars, steps and boxes, hardly any texture; 6 x 5 m. */
Scene plainRoom(std::uint64_t seed);

/** One wall, 12 x 4 m, covered with pictures, in the plane x = 0; seen from x > 0. */
Scene paintedWall(std::uint64_t seed);

/** The office with an open middle and people, whose figures are in addWalker's order. */
Scene officeWithPeople(int people, std::uint64_t seed);

}  // namespace rgbd_graphslam::synth
