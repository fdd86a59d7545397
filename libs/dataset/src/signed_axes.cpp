#include "rgbd_graphslam/dataset/signed_axes.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>

namespace rgbd_graphslam {
namespace {

std::vector<Eigen::Matrix3d> rotationsByAngle() {
    std::vector<Eigen::Matrix3d> rotations;
    std::array<int, 3> column = {0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
            for (int row = 0; row < 3; ++row) axes(row, column[row]) = signs >> row & 1 ? -1 : 1;
            if (!mirrored(axes)) rotations.push_back(axes);
        }
    } while (std::next_permutation(column.begin(), column.end()));
    std::stable_sort(rotations.begin(), rotations.end(),
                     [](const auto& a, const auto& b) { return a.trace() > b.trace(); });
    return rotations;
}

}  // namespace

const std::vector<Eigen::Matrix3d>& signedAxes() {
    static const std::vector<Eigen::Matrix3d> all = [] {
        const auto rotations = rotationsByAngle();
        std::vector<Eigen::Matrix3d> axes = {rotations[0], -rotations[0]};
        axes.insert(axes.end(), rotations.begin() + 1, rotations.end());
        for (std::size_t i = 1; i < rotations.size(); ++i) axes.push_back(-rotations[i]);
        return axes;
    }();
    return all;
}

bool mirrored(const Eigen::Matrix3d& axes) {
    return axes.determinant() < 0;
}

}  // namespace rgbd_graphslam
