#include "rgbd_graphslam/mapping/map_scene.h"

#include <gtest/gtest.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CText.h>

namespace rgbd_graphslam {
namespace {

/** Four keyframes in a row, 1 m and 1 s apart, with a loop from the last to the first. */
MapInputs fourInARow() {
    MapInputs inputs;
    for (int k = 0; k < 4; ++k) {
        inputs.keyframes.push_back(
            {1.0 * k, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(k, 0, 1)}});
    }
    inputs.keyframes_before_loops = inputs.trajectory = inputs.keyframes;
    inputs.loops = {{3, 0, 87}};
    return inputs;
}

std::size_t linesOf(mrpt::opengl::COpenGLScene scene, const char* name) {
    const auto object = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(scene.getByName(name));
    return object ? object->getLineCount() : 0;
}

TEST(MapScene, loopsTellTheirInliersAtTheirMiddle) {
    auto scene = makeScene(fourInARow(), {}, CameraModel());
    const auto texts = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(
        scene.getByName(scene_names::loop_inliers));
    ASSERT_TRUE(texts);
    const auto text = texts->getByClass<mrpt::opengl::CText>();
    ASSERT_TRUE(text);
    EXPECT_EQ(text->getString(), "87");
    EXPECT_EQ(text->getName(), "loop 3-0");
    EXPECT_DOUBLE_EQ(text->getPoseX(), 1.5);
    EXPECT_EQ(linesOf(scene, scene_names::loops), 1u);
}

TEST(MapScene, pathsAreNotDrawnFromOneSessionToTheNext) {
    MapInputs inputs = fourInARow();
    EXPECT_EQ(linesOf(makeScene(inputs, {}, CameraModel()), scene_names::graph_before_loops), 3u);
    inputs.earlier = {{"first.rawlog", 2}};
    EXPECT_EQ(linesOf(makeScene(inputs, {}, CameraModel()), scene_names::graph_before_loops), 2u);
    inputs.unplaced_s = {0.5, 2.5};  // of the second session
    EXPECT_EQ(linesOf(makeScene(inputs, {}, CameraModel()), scene_names::graph_before_loops), 1u);
}

}  // namespace
}  // namespace rgbd_graphslam
