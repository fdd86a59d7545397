#include "rgbd_graphslam/calibration/camera_calibration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

constexpr std::size_t fewest_views = 3;

using ObjectPoints = std::vector<std::vector<cv::Point3f>>;
using ImagePoints = std::vector<std::vector<cv::Point2f>>;

ObjectPoints objectPoints(const std::vector<BoardView>& views) {
    ObjectPoints points;
    for (const BoardView& view : views) {
        points.emplace_back();
        for (const Eigen::Vector2d& p : view.board_m) {
            points.back().emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.f);
        }
    }
    return points;
}

ImagePoints imagePoints(const std::vector<BoardView>& views) {
    ImagePoints points;
    for (const BoardView& view : views) {
        points.emplace_back();
        for (const Eigen::Vector2d& p : view.pixel) {
            points.back().emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
        }
    }
    return points;
}

Intrinsics intrinsicsOf(const cv::Mat1d& K, const std::vector<double>& coefficients, int width,
                        int height, const std::string& lens) {
    Intrinsics camera;
    camera.width = width;
    camera.height = height;
    camera.fx = K(0, 0);
    camera.fy = K(1, 1);
    camera.cx = K(0, 2);
    camera.cy = K(1, 2);
    camera.lens = makeLens(lens, coefficients);
    return camera;
}

Intrinsics fisheyeFrom(const std::vector<BoardView>& views, int width, int height) {
    // A guess that is too narrow diverges: fisheyes see about 110 degrees of their width.
    const double focal = 0.5 * width;
    cv::Mat1d K = (cv::Mat1d(3, 3) << focal, 0, 0.5 * width, 0, focal, 0.5 * height, 0, 0, 1);
    cv::Mat1d D = cv::Mat1d::zeros(4, 1);
    std::vector<cv::Mat> rotations, translations;
    constexpr int flags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW |
                          cv::fisheye::CALIB_USE_INTRINSIC_GUESS;
    std::vector<std::vector<cv::Point3d>> object;
    std::vector<std::vector<cv::Point2d>> image;
    for (const BoardView& view : views) {
        object.emplace_back();
        image.emplace_back();
        for (std::size_t i = 0; i < view.pixel.size(); ++i) {
            object.back().emplace_back(view.board_m[i].x(), view.board_m[i].y(), 0);
            image.back().emplace_back(view.pixel[i].x(), view.pixel[i].y());
        }
    }
    cv::fisheye::calibrate(object, image, {width, height}, K, D, rotations, translations, flags,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-10});
    return intrinsicsOf(K, {D(0), D(1), D(2), D(3)}, width, height, "kannala_brandt");
}

Intrinsics brownFrom(const std::vector<BoardView>& views, int width, int height,
                     const std::string& lens, Eigen::Vector4d& sigma) {
    cv::Mat1d K = cv::Mat1d::eye(3, 3), deviations;
    cv::Mat D, extrinsic_deviations, errors;
    std::vector<cv::Mat> rotations, translations;
    int flags = 0;
    if (lens == "rational") flags = cv::CALIB_RATIONAL_MODEL;
    if (lens == "none") {
        flags =
            cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST;
    }
    cv::calibrateCamera(objectPoints(views), imagePoints(views), {width, height}, K, D, rotations,
                        translations, deviations, extrinsic_deviations, errors, flags,
                        {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-12});
    for (int i = 0; i < 4; ++i) sigma[i] = deviations(i);
    cv::Mat1d coefficients;
    D.reshape(1, 1).convertTo(coefficients, CV_64F);
    const int count = lens == "rational" ? 8 : lens == "none" ? 0 : 5;
    return intrinsicsOf(K, {coefficients.begin(), coefficients.begin() + count}, width, height,
                        lens);
}

/** A pose to start from: of the corners' rays on the plane z = 1. */
SE3 roughPose(const BoardView& view, const CameraModel& model) {
    std::vector<cv::Point3d> object;
    std::vector<cv::Point2d> image;
    for (std::size_t i = 0; i < view.pixel.size(); ++i) {
        const Eigen::Vector3d ray = model.bearing(view.pixel[i]);
        if (!(ray.z() > 0.05)) continue;
        object.emplace_back(view.board_m[i].x(), view.board_m[i].y(), 0);
        image.emplace_back(ray.x() / ray.z(), ray.y() / ray.z());
    }
    cv::Mat1d r, t;
    if (object.size() < 4 || !cv::solvePnP(object, image, cv::Mat1d::eye(3, 3), cv::noArray(), r, t,
                                           false, cv::SOLVEPNP_IPPE)) {
        throw Error("a view of the board has no pose", "leave that part of the recording out");
    }
    return {rotationExp({r(0), r(1), r(2)}), {t(0), t(1), t(2)}};
}

/** Gauss and Newton on the six numbers of a pose, corners weighing alike. */
SE3 refinedPose(const BoardView& view, const CameraModel& model, SE3 T) {
    constexpr int iterations = 15;
    for (int k = 0; k < iterations; ++k) {
        Matrix6d A = Matrix6d::Identity() * 1e-9;
        Vector6d b = Vector6d::Zero();
        for (std::size_t i = 0; i < view.pixel.size(); ++i) {
            const Eigen::Vector3d p =
                T * Eigen::Vector3d(view.board_m[i].x(), view.board_m[i].y(), 0);
            Eigen::Matrix<double, 3, 6> by_pose;
            by_pose << Eigen::Matrix3d::Identity(), -skew(p);
            const Eigen::Matrix<double, 2, 6> J = model.projectionJacobian(p) * by_pose;
            A += J.transpose() * J;
            b += J.transpose() * (view.pixel[i] - model.project(p));
        }
        const Vector6d step = A.ldlt().solve(b);
        T = T.retract(step);
        if (step.norm() < 1e-12) break;
    }
    return T;
}

void addResiduals(const BoardView& view, const CameraModel& model, const SE3& T,
                  CameraCalibration& result) {
    for (std::size_t i = 0; i < view.pixel.size(); ++i) {
        const Eigen::Vector3d p = T * Eigen::Vector3d(view.board_m[i].x(), view.board_m[i].y(), 0);
        result.residuals.push_back({view.pixel[i], view.pixel[i] - model.project(p)});
    }
}

}  // namespace

CameraCalibration evaluateCamera(const std::vector<BoardView>& views, const Intrinsics& camera) {
    CameraCalibration result;
    result.camera = camera;
    const CameraModel model(camera);
    double squares = 0;
    for (const BoardView& view : views) {
        result.T_cam_board.push_back(refinedPose(view, model, roughPose(view, model)));
        addResiduals(view, model, result.T_cam_board.back(), result);
    }
    for (const CornerResidual& r : result.residuals) squares += r.residual_px.squaredNorm();
    const auto count = static_cast<double>(std::max<std::size_t>(1, result.residuals.size()));
    result.rms_px = std::sqrt(squares / count);
    return result;
}

CameraCalibration calibrateCamera(const std::vector<BoardView>& views, int width, int height,
                                  const std::string& lens) {
    const std::string remedy = "show the board near and far, tilted, and in every corner";
    if (views.size() < fewest_views) {
        throw Error(std::to_string(views.size()) + " views of the board are too few", remedy);
    }
    Intrinsics camera;
    Eigen::Vector4d sigma = Eigen::Vector4d::Zero();
    try {
        camera = lens == "kannala_brandt" ? fisheyeFrom(views, width, height)
                                          : brownFrom(views, width, height, lens, sigma);
    } catch (const cv::Exception&) {
        throw Error("these views of the board do not determine the camera", remedy);
    }
    if (!CameraModel(camera).isInvertible()) {
        throw Error("the lens '" + lens + "' that fits best folds the image over",
                    remedy + ", or choose a lens with fewer coefficients");
    }
    CameraCalibration result = evaluateCamera(views, camera);
    result.sigma = sigma;
    return result;
}

CameraDifference difference(const Intrinsics& a, const Intrinsics& b) {
    constexpr int cells = 16;
    const CameraModel first(a), second(b);
    std::vector<Eigen::Vector2d> pixels;
    std::vector<Eigen::Vector3d> rays;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            pixels.emplace_back(i * (a.width - 1.0) / cells, j * (a.height - 1.0) / cells);
            rays.push_back(first.bearing(pixels.back()));
        }
    }
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    CameraDifference result;
    for (int k = 0; k < 10; ++k) {
        Eigen::Matrix3d A = Eigen::Matrix3d::Identity() * 1e-9;
        Eigen::Vector3d g = Eigen::Vector3d::Zero();
        double squares = 0;
        result.largest_px = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Eigen::Vector3d p = R * rays[i];
            const Eigen::Vector2d e = pixels[i] - second.project(p);
            const Eigen::Matrix<double, 2, 3> J = -second.projectionJacobian(p) * skew(p);
            A += J.transpose() * J;
            g += J.transpose() * e;
            squares += e.squaredNorm();
            result.largest_px = std::max(result.largest_px, e.norm());
        }
        result.rms_px = std::sqrt(squares / static_cast<double>(rays.size()));
        R = rotationExp(A.ldlt().solve(g)) * R;
    }
    return result;
}

}  // namespace rgbd_graphslam
