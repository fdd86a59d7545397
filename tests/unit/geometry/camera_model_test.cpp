/** Every camera model against OpenCV's and against numbers, all over its image. */
#include "rgbd_graphslam/geometry/camera_model.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace rgbd_graphslam {
namespace {

struct Model {
    const char* name;
    Intrinsics intrinsics;
};

void PrintTo(const Model& model, std::ostream* out) {
    *out << model.name;
}

const Model models[] = {
    {"pinhole", {640, 480, 525, 520, 319.5, 239.5, {}}},
    {"plumbBob",
     {640, 480, 517.3, 516.5, 318.6, 255.3, BrownLens{{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}}}},
    {"rational",  // an Azure Kinect's color camera
     {1280, 720, 605.3, 605.1, 637.2, 366.5,
      BrownLens{{0.52, -2.74, 0.0004, -0.0003, 1.59, 0.40, -2.55, 1.51}}}},
    {"strongRational",
     {640, 480, 300, 301, 322, 237, BrownLens{{0.9, 0.35, 0.002, -0.001, 0.02, 1.25, 0.55, 0.08}}}},
    {"kannalaBrandt",
     {848, 800, 286.2, 286.3, 421.5, 399.8, KannalaBrandtLens{{-0.0027, 0.0387, -0.0365, 0.0062}}}},
    {"equidistant", {640, 480, 200, 200, 319.5, 239.5, KannalaBrandtLens{}}},
};

class CameraModels : public ::testing::TestWithParam<Model> {
  protected:
    /** Calls `visit` for pixels all over the image, borders included. */
    template <class Visit>
    void everywhere(const Visit& visit) const {
        constexpr int steps = 20;
        for (int row = 0; row <= steps; ++row) {
            for (int column = 0; column <= steps; ++column) {
                visit(Eigen::Vector2d((camera.width - 1.) * column / steps,
                                      (camera.height - 1.) * row / steps));
            }
        }
    }

    const CameraModel camera = GetParam().intrinsics;
};

Eigen::Vector2d projectedByOpenCv(const Intrinsics& in, const Eigen::Vector3d& p) {
    const cv::Matx33d K(in.fx, 0, in.cx, 0, in.fy, in.cy, 0, 0, 1);
    const std::vector<cv::Point3d> points = {{p.x(), p.y(), p.z()}};
    const cv::Vec3d zero(0, 0, 0);
    std::vector<cv::Point2d> pixels;
    if (std::holds_alternative<KannalaBrandtLens>(in.lens)) {
        cv::fisheye::projectPoints(points, pixels, zero, zero, K, lensCoefficients(in.lens));
    } else {
        cv::projectPoints(points, zero, zero, K, lensCoefficients(in.lens), pixels);
    }
    return {pixels[0].x, pixels[0].y};
}

TEST_P(CameraModels, projectAsOpenCvDoes) {
    everywhere([&](const Eigen::Vector2d& pixel) {
        const Eigen::Vector3d p = 1.7 * camera.bearing(pixel);
        if (p.z() < 0.05) return;
        EXPECT_LT((camera.project(p) - projectedByOpenCv(GetParam().intrinsics, p)).norm(), 1e-8)
            << pixel.transpose();
    });
}

TEST_P(CameraModels, invertTheirProjection) {
    EXPECT_TRUE(camera.isInvertible());
    everywhere([&](const Eigen::Vector2d& pixel) {
        const Eigen::Vector3d ray = camera.bearing(pixel);
        EXPECT_NEAR(ray.norm(), 1, 1e-12);
        EXPECT_LT((camera.project(2.5 * ray) - pixel).norm(), 0.01) << pixel.transpose();
        EXPECT_TRUE(camera.isValid(ray)) << pixel.transpose();
        if (ray.z() < 0.1) return;
        const Eigen::Vector3d p = camera.unproject(pixel.x(), pixel.y(), 2.5);
        EXPECT_EQ(p.z(), 2.5);
        EXPECT_LT(p.normalized().cross(ray).norm(), 1e-12);
    });
}

TEST_P(CameraModels, haveTheJacobianOfTheirProjection) {
    constexpr double step = 1e-6;
    everywhere([&](const Eigen::Vector2d& pixel) {
        const Eigen::Vector3d p = 2 * camera.bearing(pixel);
        Matrix23d numeric;
        for (int i = 0; i < 3; ++i) {
            const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(i);
            numeric.col(i) = (camera.project(p + d) - camera.project(p - d)) / (2 * step);
        }
        const Matrix23d J = camera.projectionJacobian(p);
        EXPECT_LT((J - numeric).norm(), 1e-6 * J.norm()) << pixel.transpose();
        EXPECT_LT((camera.projectionJacobian(p, 3) - 3 * J).norm(), 1e-12 * J.norm());
        const Eigen::Vector2d g(0.3, -0.7);
        EXPECT_LT((camera.pointGradient(g, p) - J.transpose() * g).norm(), 1e-12 * J.norm());
        EXPECT_LT((camera.project(p) - camera.project(p, 1 / p.z())).norm(), 1e-9);
    });
}

TEST_P(CameraModels, haveTheJacobianOfUnproject) {
    constexpr double step = 1e-3;
    everywhere([&](const Eigen::Vector2d& pixel) {
        if (camera.bearing(pixel).z() < 0.2) return;
        Eigen::Matrix<double, 3, 2> numeric;
        for (int i = 0; i < 2; ++i) {
            const Eigen::Vector2d a = pixel + step * Eigen::Vector2d::Unit(i),
                                  b = pixel - step * Eigen::Vector2d::Unit(i);
            numeric.col(i) =
                (camera.unproject(a.x(), a.y(), 2) - camera.unproject(b.x(), b.y(), 2)) /
                (2 * step);
        }
        const auto J = camera.unprojectionJacobian(pixel, 2);
        EXPECT_LT((J - numeric).norm(), 1e-3 * J.norm()) << pixel.transpose();
    });
}

TEST_P(CameraModels, knowTheSizeOfTheirPixels) {
    everywhere([&](const Eigen::Vector2d& pixel) {
        const auto bearing = [&](double u, double v) {
            return camera.bearing(pixel + Eigen::Vector2d(u, v));
        };
        const Eigen::Vector3d across = bearing(0.5, 0) - bearing(-0.5, 0);
        const Eigen::Vector3d down = bearing(0, 0.5) - bearing(0, -0.5);
        const double angle = std::sqrt(across.cross(down).norm());
        EXPECT_NEAR(camera.pixelAngle(pixel), angle, 1e-3 * angle) << pixel.transpose();
    });
}

TEST_P(CameraModels, rectifyWhatAPlaneCanHold) {
    const CameraModel rectified = camera.rectified();
    everywhere([&](const Eigen::Vector2d& pixel) {
        const Eigen::Vector2d ideal = camera.rectify(pixel);
        EXPECT_LT((camera.unrectify(ideal) - pixel).norm(), 0.01);
        EXPECT_LT(rectified.bearing(ideal).cross(camera.bearing(pixel)).norm(), 1e-12);
    });
    EXPECT_EQ(rectified.hasDistortion(),
              std::holds_alternative<KannalaBrandtLens>(GetParam().intrinsics.lens));
}

TEST_P(CameraModels, survivePlainNumbers) {
    const Lens& lens = GetParam().intrinsics.lens;
    EXPECT_TRUE(makeLens(lensModel(lens), lensCoefficients(lens)) == lens);
    EXPECT_TRUE(camera.intrinsics() == GetParam().intrinsics);
}

INSTANTIATE_TEST_SUITE_P(All, CameraModels, ::testing::ValuesIn(models),
                         [](const auto& param_info) { return param_info.param.name; });

TEST(CameraModel, seesBehindItselfOnlyThroughAFisheye) {
    const Eigen::Vector3d behind = Eigen::Vector3d(1, 0, -0.2);
    EXPECT_FALSE(CameraModel().isValid(behind));
    const CameraModel fisheye = Intrinsics{1000, 1000, 250, 250, 499.5, 499.5, KannalaBrandtLens{}};
    EXPECT_TRUE(fisheye.isValid(behind));
    const Eigen::Vector2d pixel = fisheye.project(behind);
    EXPECT_LT(fisheye.bearing(pixel).cross(behind.normalized()).norm(), 1e-12);
    EXPECT_TRUE(std::isnan(fisheye.unproject(pixel.x(), pixel.y(), 1).x())) << "it has no depth";
}

TEST(CameraModel, tellsWhereALensFolds) {
    Intrinsics barrel;
    barrel.fx = barrel.fy = 1200;
    barrel.lens = BrownLens{{-0.5}};  // grows up to r = sqrt(2 / 3)
    const CameraModel narrow = barrel;
    EXPECT_TRUE(narrow.isInvertible());
    EXPECT_TRUE(narrow.isValid({0.8, 0, 1}));
    EXPECT_FALSE(narrow.isValid({0.83, 0, 1}));
    barrel.fx = barrel.fy = 400;
    EXPECT_FALSE(CameraModel(barrel).isInvertible());
    Intrinsics fisheye{640, 480, 300, 300, 319.5, 239.5, KannalaBrandtLens{{-0.2}}};
    EXPECT_TRUE(CameraModel(fisheye).isValid({std::tan(1.28), 0, 1}));
    EXPECT_FALSE(CameraModel(fisheye).isValid({std::tan(1.30), 0, 1})) << "1 / sqrt(0.6) = 1.291";
    fisheye.fx = fisheye.fy = 200;
    EXPECT_FALSE(CameraModel(fisheye).isInvertible());
}

TEST(CameraModel, polesOfARationalLensAreOutsideOfItsView) {
    Intrinsics camera;
    camera.lens = BrownLens{{0, 0, 0, 0, 0, -1, 0, 0}};  // no number at r = 1
    EXPECT_TRUE(CameraModel(camera).isValid({0.9, 0, 1}));
    EXPECT_FALSE(CameraModel(camera).isValid({1.1, 0, 1}));
}

TEST(CameraModel, smallerImagesShowTheSamePoints) {
    const CameraModel camera = models[1].intrinsics;
    const Eigen::Vector3d p(0.3, -0.2, 1.5);
    const Eigen::Vector2d pixel = camera.project(p), half = Eigen::Vector2d::Constant(0.5);
    EXPECT_LT((camera.shrunk(4).project(p) - ((pixel + half) / 4 - half)).norm(), 1e-9);
    EXPECT_LT((camera.subsampled(4).project(p) - pixel / 4).norm(), 1e-9);
    EXPECT_LT((CameraModel(scaled(camera.intrinsics(), 2, 1280, 960)).project(p) -
               (2 * (pixel + half) - half))
                  .norm(),
              1e-9);
    EXPECT_EQ(camera.shrunk(4).width, 160);
    EXPECT_EQ(camera.subsampled(3).height, 160);
}

TEST(Lens, unknownModelsAreRefused) {
    EXPECT_THROW(makeLens("omnidirectional", {}), std::invalid_argument);
    EXPECT_THROW(makeLens("kannala_brandt", {1, 2, 3, 4, 5}), std::invalid_argument);
    EXPECT_TRUE(isNone(makeLens("plumb_bob", {})));
    EXPECT_FALSE(isNone(makeLens("kannala_brandt", {})));
}

}  // namespace
}  // namespace rgbd_graphslam
