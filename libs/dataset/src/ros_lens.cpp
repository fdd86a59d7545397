#include "ros_lens.h"

#include <algorithm>

#include "lower_case.h"

namespace rgbd_graphslam {
namespace {

bool namesOneOf(const std::string& model, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return contains(model, name); });
}

bool isFisheye(const std::string& model) {
    return namesOneOf(model, {"equidistant", "fisheye", "kannala"});
}

bool isForeign(const std::string& model) {
    return namesOneOf(model, {"inverse", "theta", "omni", "eucm", "fov", "double", "thin_prism"});
}

}  // namespace

std::optional<Lens> lensByRosName(const std::string& model, std::vector<double> coefficients) {
    while (!coefficients.empty() && coefficients.back() == 0) coefficients.pop_back();
    const std::string name = lowerCase(model);
    if (isForeign(name) && !coefficients.empty()) return std::nullopt;
    if (isFisheye(name)) {
        if (coefficients.size() > 4) return std::nullopt;
        return makeLens("kannala_brandt", coefficients);
    }
    if (coefficients.size() <= 5) return makeLens("plumb_bob", coefficients);
    const bool is_brown = name.empty() || namesOneOf(name, {"rational", "plumb", "brown"});
    if (!is_brown || coefficients.size() > 8) return std::nullopt;
    return makeLens("rational", coefficients);
}

}  // namespace rgbd_graphslam
