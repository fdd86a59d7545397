#include "rgbd_graphslam/synth/labels.h"

namespace rgbd_graphslam::synth {

const std::vector<LabelClass>& labelClasses() {
    static const std::vector<LabelClass> classes{
        {Label::Wall, "wall", {190, 190, 200}},
        {Label::Floor, "floor", {130, 100, 80}},
        {Label::Ceiling, "ceiling", {235, 235, 235}},
        {Label::Door, "door", {150, 75, 0}},
        {Label::Window, "window", {120, 190, 255}},
        {Label::Lamp, "lamp", {255, 250, 120}},
        {Label::Picture, "picture", {230, 110, 180}},
        {Label::Table, "table", {200, 150, 60}},
        {Label::Chair, "chair", {0, 130, 60}},
        {Label::Shelf, "shelf", {95, 60, 150}},
        {Label::Cabinet, "cabinet", {60, 60, 120}},
        {Label::Sofa, "sofa", {0, 160, 160}},
        {Label::Plant, "plant", {60, 200, 60}},
        {Label::Screen, "screen", {20, 60, 200}},
        {Label::Object, "object", {255, 150, 0}},
        {Label::Box, "box", {170, 130, 90}},
        {Label::Bin, "bin", {90, 90, 90}},
        {Label::Radiator, "radiator", {210, 225, 170}},
        {Label::Rug, "rug", {160, 40, 90}},
        {Label::Pillar, "pillar", {150, 150, 120}},
        {Label::Person, "person", {255, 0, 0}},
        {Label::Cart, "cart", {255, 90, 90}},
        {Label::Mirror, "mirror", {0, 255, 255}},
        {Label::Robot, "robot", {255, 0, 255}},
        {Label::Outside, "outside", {170, 255, 60}},
    };
    return classes;
}

}  // namespace rgbd_graphslam::synth
