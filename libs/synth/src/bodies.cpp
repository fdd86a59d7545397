#include "bodies.h"

#include <algorithm>
#include <cmath>

#include "rgbd_graphslam/synth/textures.h"

namespace rgbd_graphslam::synth {

namespace {
using Eigen::Vector3d;

const double kPi = std::acos(-1.0);

double lowest(const MovingBody& body) {
    double z = 0;
    for (const Quad& quad : body.quads)
        for (const Vector3d& corner : quad.corners) z = std::min(z, corner.z());
    return z;
}

Skin paintedMetal(Scene& scene, double gray, Random& random) {
    return {scene.addMaterial(paintMetal(Bgr::all(gray), random), 0.4)};
}
}  // namespace

void lightFiguresAt(Scene& scene, double x, double y) {
    for (MovingBody& figure : scene.figures)
        figure.lit_at.translation() = Vector3d(x, y, -lowest(figure));
}

MovingBody doorLeaf(Scene& scene, double width, double height, Random& random) {
    MovingBody leaf;
    const Skin wood{scene.addMaterial(paintDoor(Bgr(70, 110, 160), random))};
    addBox(scene, leaf.quads, standing(0, width / 2, 0, 0), {0.04, width, height}, BoxSkin(wood));
    for (double side : {-1.0, 1.0})
        for (double z : {0.55, 1.2}) {
            const Skin poster{scene.addMaterial(paintPoster(random))};
            const SE3 frame = standing(0.022 * side, width / 2 - 0.3 * side, z, side > 0 ? 0 : kPi);
            addRectangle(scene, leaf.quads, frame, 0.6, 0.55, poster);
        }
    label(leaf.quads, Label::Door);
    return leaf;
}

MovingBody cart(Scene& scene, Random& random) {
    MovingBody body;
    const Skin metal = paintedMetal(scene, 90, random);
    addBox(scene, body.quads, standing(0, 0, 0.15, 0), {0.9, 0.56, 0.04}, BoxSkin(metal));
    for (double x : {-0.4, 0.4})
        for (double y : {-0.24, 0.24})
            addBox(scene, body.quads, standing(x, y, 0, 0), {0.06, 0.05, 0.15}, BoxSkin(metal));
    for (double y : {-0.25, 0.25})
        addBox(scene, body.quads, standing(-0.43, y, 0.19, 0), {0.03, 0.03, 0.8}, BoxSkin(metal));
    addBox(scene, body.quads, standing(-0.43, 0, 0.96, 0), {0.03, 0.53, 0.03}, BoxSkin(metal));
    for (double x : {-0.2, 0.22})
        for (double z = 0.19; z < 0.8;) {
            const double tall = random.uniform(0.2, 0.34);
            const Skin parcel{scene.addMaterial(random.chance(0.5) ? paintCardboard(random)
                                                                   : paintPackage(random))};
            addBox(scene, body.quads, standing(x, 0, z, random.uniform(-0.1, 0.1)),
                   {0.38, 0.48, tall}, BoxSkin(parcel));
            z += tall;
        }
    label(body.quads, Label::Cart);
    return body;
}

MovingBody armSegment(Scene& scene, double length, double thickness, Random& random) {
    MovingBody bar;
    const Skin metal = paintedMetal(scene, 150, random);
    const SE3 upright = standing(length / 2, 0, -thickness / 2, 0);
    addBox(scene, bar.quads, upright, {length, thickness, thickness}, BoxSkin(metal));
    const double sticker = 0.8 * thickness;
    for (double x = 0.1 * length; x + sticker < length; x += 1.6 * sticker) {
        const Skin print{scene.addMaterial(paintPackage(random))};
        addBox(scene, bar.quads, standing(x + sticker / 2, 0, -0.51 * thickness, 0),
               {sticker, 1.02 * thickness, 1.02 * thickness}, BoxSkin(print));
    }
    label(bar.quads, Label::Robot);
    return bar;
}

MovingBody gripper(Scene& scene, Random& random) {
    MovingBody hand;
    const Skin metal = paintedMetal(scene, 60, random),
               print{scene.addMaterial(paintPaper(random))};
    addBox(scene, hand.quads, standing(0.03, 0, -0.04, 0), {0.06, 0.2, 0.08},
           BoxSkin(print, metal));
    for (double y : {-0.08, 0.08})
        addBox(scene, hand.quads, standing(0.12, y, -0.02, 0), {0.14, 0.025, 0.04}, BoxSkin(metal));
    label(hand.quads, Label::Robot);
    return hand;
}

}  // namespace rgbd_graphslam::synth
