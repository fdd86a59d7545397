/** Classes of things, as label images name them. */
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rgbd_graphslam::synth {

/** Values of label images; 0 is what has no class or is not seen. */
enum class Label : std::uint8_t {
    None,
    Wall,
    Floor,
    Ceiling,
    Door,
    Window,
    Lamp,
    Picture,
    Table,
    Chair,
    Shelf,
    Cabinet,
    Sofa,
    Plant,
    Screen,
    Object,
    Box,
    Bin,
    Radiator,
    Rug,
    Pillar,
    Person,
    Cart,
    Mirror,
    Robot,
    Outside,
};

/** A label with its name and color in pictures. */
struct LabelClass {
    Label label;
    std::string name;
    std::array<int, 3> color;  // red, green, blue
};

/** All classes but None, by value. */
const std::vector<LabelClass>& labelClasses();

}  // namespace rgbd_graphslam::synth
