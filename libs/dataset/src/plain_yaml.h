/** The part of YAML that calibration files use. */
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace rgbd_graphslam {

/** Maps by indentation, numbers, texts, lists in brackets (over several lines, too) and lists of
 *  `-` items, as a JSON value; what else there is (anchors, block texts, maps in lists, lists
 *  nested deeper than any matrix) is skipped. */
nlohmann::json parsePlainYaml(const std::string& text);

}  // namespace rgbd_graphslam
