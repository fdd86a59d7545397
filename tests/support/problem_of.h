/** What a function complains of. */
#pragma once
#include <string>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

/** \return the message of the Error that `function` throws; empty when it throws none */
template <class Function>
std::string problemOf(Function function) {
    try {
        function();
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

}  // namespace rgbd_graphslam
