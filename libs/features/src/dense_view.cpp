#include "rgbd_graphslam/features/dense_view.h"

#include <algorithm>
#include <cmath>

namespace rgbd_graphslam {

double DenseView::depthShare() const {
    const auto seen = std::count_if(depth_m.begin(), depth_m.end(), [](float z) { return z > 0; });
    return empty() ? 0 : static_cast<double>(seen) / static_cast<double>(depth_m.size());
}

double DenseView::contrast() const {
    double sum = 0, squares = 0;
    for (const float g : gray) {
        sum += g;
        squares += g * g;
    }
    const double count = std::max<double>(1, static_cast<double>(gray.size()));
    return std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
}

DenseView halved(const DenseView& view) {
    DenseView half;
    half.camera = view.camera.shrunk(2);
    for (int y = 0; y < half.camera.height; ++y) {
        for (int x = 0; x < half.camera.width; ++x) {
            float gray = 0, nearest = 0;
            for (const int offset : {0, 1, view.camera.width, view.camera.width + 1}) {
                const int i = 2 * y * view.camera.width + 2 * x + offset;
                gray += 0.25f * view.gray[i];
                const float z = view.depth_m[i];
                if (z > 0 && (nearest == 0 || z < nearest)) nearest = z;
            }
            half.gray.push_back(gray);
            half.depth_m.push_back(nearest);
        }
    }
    return half;
}

}  // namespace rgbd_graphslam
