/** Square roots of information matrices. */
#pragma once
#include <Eigen/Cholesky>
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

/** W with W^T W = information, by which residuals are whitened.
 *  \param measurement named in the error
 *  \throws Error when the matrix is not positive definite */
template <int n>
Eigen::Matrix<double, n, n> whiteningOf(const Eigen::Matrix<double, n, n>& information,
                                        const std::string& measurement) {
    const Eigen::LLT<Eigen::Matrix<double, n, n>> factor(information);
    if (factor.info() != Eigen::Success || !information.allFinite()) {
        throw Error(measurement + ": the information matrix is not positive definite",
                    "give it the inverse of a covariance");
    }
    return factor.matrixU();
}

}  // namespace rgbd_graphslam
