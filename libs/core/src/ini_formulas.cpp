#include "rgbd_graphslam/core/ini_formulas.h"

#include <algorithm>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {

void refuseFormulas(const std::string& text, const std::string& name) {
    for (const char* formula : {"$env", "$eval"}) {
        const auto found = text.find(formula);
        if (found == std::string::npos) continue;
        const auto line = 1 + std::count(text.begin(), text.begin() + found, '\n');
        throw Error(name + ":" + std::to_string(line) + ": '" + formula +
                        "{}' is not evaluated in the files of this program",
                    "write the value itself");
    }
}

}  // namespace rgbd_graphslam
