#include "rgbd_graphslam/synth/contact_sheet.h"

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam::synth {

namespace {
namespace fs = std::filesystem;

constexpr int kColumns = 6;
const cv::Size kThumb(200, 150);

std::vector<std::string> pictures(const fs::path& folder) {
    std::vector<std::string> paths;
    if (fs::is_directory(folder))
        for (const auto& entry : fs::directory_iterator(folder))
            paths.push_back(entry.path().string());
    if (paths.empty()) throw Error("no pictures in " + folder.string(), "name a sequence's folder");
    std::sort(paths.begin(), paths.end());
    return paths;
}

cv::Mat thumbnail(const cv::Mat& picture) {
    cv::Mat small;
    cv::resize(picture, small, kThumb, 0, 0, cv::INTER_AREA);
    return small;
}

/** Near is red, far (5 m) is blue, none is black. */
cv::Mat depthThumbnail(const std::string& path) {
    const cv::Mat depth = cv::imread(path, cv::IMREAD_UNCHANGED);
    cv::Mat gray, colored;
    depth.convertTo(gray, CV_8UC1, -255.0 / 25000, 255);
    cv::applyColorMap(gray, colored, cv::COLORMAP_JET);
    colored.setTo(0, depth == 0);
    return thumbnail(colored);
}

std::string sequenceName(fs::path folder) {
    if (folder.filename().empty()) folder = folder.parent_path();
    const std::string name = folder.filename().string(),
                      parent = folder.parent_path().filename().string();
    return name.size() < 3 && !parent.empty() ? parent + "/" + name : name;
}

void addName(const std::string& folder, cv::Mat& row) {
    const std::string name = sequenceName(folder);
    cv::rectangle(row, cv::Rect(0, 0, 14 + 9 * static_cast<int>(name.size()), 22), {30, 30, 30},
                  cv::FILLED);
    cv::putText(row, name, {6, 16}, cv::FONT_HERSHEY_SIMPLEX, 0.5, {255, 255, 255}, 1, cv::LINE_AA);
}

/** Color pictures over time, then depth and, if wanted, the mask of the last. */
cv::Mat sequenceRow(const std::string& folder, bool with_mask) {
    const auto colors = pictures(fs::path(folder) / "rgb");
    std::vector<cv::Mat> thumbs;
    for (int i = 0; i < kColumns; ++i)
        thumbs.push_back(thumbnail(cv::imread(colors[(colors.size() - 1) * i / (kColumns - 1)])));
    thumbs.push_back(depthThumbnail(pictures(fs::path(folder) / "depth").back()));
    if (with_mask)
        thumbs.push_back(thumbnail(cv::imread(pictures(fs::path(folder) / "movers").back())));
    cv::Mat row;
    cv::hconcat(thumbs, row);
    addName(folder, row);
    return row;
}
}  // namespace

void writeContactSheet(const std::vector<std::string>& folders, const std::string& path) {
    std::vector<cv::Mat> rows;
    rows.reserve(folders.size());
    const bool masks = std::all_of(folders.begin(), folders.end(), [](const std::string& folder) {
        return fs::is_directory(fs::path(folder) / "movers");
    });
    for (const std::string& folder : folders) rows.push_back(sequenceRow(folder, masks));
    cv::Mat sheet;
    cv::vconcat(rows, sheet);
    writeAtomically(path, [&](const std::string& temporary) {
        return cv::imwrite(temporary, sheet, {cv::IMWRITE_JPEG_QUALITY, 66});
    });
}

}  // namespace rgbd_graphslam::synth
