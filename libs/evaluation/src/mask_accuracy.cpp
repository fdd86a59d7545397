#include "rgbd_graphslam/evaluation/mask_accuracy.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/metrics/statistics.h"

namespace rgbd_graphslam {
namespace {
namespace fs = std::filesystem;

using FilesByStamp = std::map<double, std::string>;

/** Stamp that a file is named after; files of other names are none of a sequence's. */
bool stampOf(const fs::path& file, double& stamp_s) {
    if (file.extension() != ".png") return false;
    const std::string name = file.stem().string();
    char* end = nullptr;
    stamp_s = std::strtod(name.c_str(), &end);
    return !name.empty() && *end == '\0';
}

FilesByStamp masksOf(const std::string& folder) {
    FilesByStamp files;
    double stamp_s = 0;
    if (fs::is_directory(folder)) {
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (stampOf(entry.path(), stamp_s)) files[stamp_s] = entry.path().string();
        }
    }
    if (files.empty()) {
        throw Error("'" + folder + "' holds no masks", "name a folder of PNG files named by stamp");
    }
    return files;
}

/** Empty when there is none near enough. */
std::string nearest(const FilesByStamp& files, double stamp_s, double max_difference_s) {
    const auto after = files.lower_bound(stamp_s - max_difference_s);
    std::string best;
    for (auto it = after; it != files.end() && it->first <= stamp_s + max_difference_s; ++it) {
        const double difference_s = std::abs(it->first - stamp_s);
        if (difference_s > max_difference_s) continue;
        max_difference_s = difference_s;
        best = it->second;
    }
    return best;
}

cv::Mat readMask(const std::string& path) {
    const cv::Mat mask = cv::imread(path, cv::IMREAD_GRAYSCALE);
    if (mask.empty()) throw Error("cannot read the mask '" + path + "'", "make it again");
    return mask;
}

/** Whether the fastest mover of a stamp is fast enough; what is not known, or is carried along and
 *  so always in view, is. */
bool fastEnough(const std::vector<MoverBox>& movers, double stamp_s, double min_speed_m_s) {
    const auto first =
        std::lower_bound(movers.begin(), movers.end(), stamp_s - 1e-4,
                         [](const MoverBox& box, double stamp) { return box.stamp_s < stamp; });
    bool known = false;
    for (auto box = first; box != movers.end() && box->stamp_s < stamp_s + 1e-4; ++box) {
        if (box->carried || box->speed_m_s >= min_speed_m_s) return true;
        known = true;
    }
    return !known;
}

}  // namespace

void MaskScore::add(const cv::Mat& estimated, const cv::Mat& truth, bool fast_enough) {
    if (estimated.size() != truth.size()) {
        throw Error("an estimated mask has another size than the true one",
                    "compare masks of the same pictures");
    }
    const cv::Mat found = estimated != 0, moving = truth != 0;
    const double total = static_cast<double>(truth.total());
    const double true_count = cv::countNonZero(moving), found_count = cv::countNonZero(found);
    const double common = cv::countNonZero(found & moving);
    const double together = true_count + found_count - common;
    ++pictures_;
    still_ += total - true_count;
    false_ += found_count - common;
    if (!fast_enough || true_count < options_.min_share * total) return;
    ious_.push_back(common / together);
    common_ += common;
    together_ += together;
}

MaskAccuracy MaskScore::result() const {
    MaskAccuracy accuracy;
    accuracy.pictures = pictures_;
    accuracy.missing = missing_;
    accuracy.scored = ious_.size();
    accuracy.falsely_masked = still_ > 0 ? false_ / still_ : 0;
    if (ious_.empty()) return accuracy;
    const Statistics statistics = statisticsOf(ious_);
    accuracy.mean_iou = statistics.mean;
    accuracy.median_iou = statistics.median;
    accuracy.total_iou = common_ / together_;
    const auto good = std::count_if(ious_.begin(), ious_.end(),
                                    [&](double iou) { return iou >= options_.good_iou; });
    accuracy.good = static_cast<double>(good) / static_cast<double>(ious_.size());
    return accuracy;
}

MaskAccuracy evaluateMasks(const std::string& estimated_folder, const std::string& true_folder,
                           const std::vector<MoverBox>& movers,
                           const MaskAccuracyOptions& options) {
    const FilesByStamp estimated = masksOf(estimated_folder), truth = masksOf(true_folder);
    MaskScore score(options);
    for (const auto& [stamp_s, path] : truth) {
        const std::string partner = nearest(estimated, stamp_s, options.max_difference_s);
        if (partner.empty()) {
            score.addMissing();
            continue;
        }
        score.add(readMask(partner), readMask(path),
                  fastEnough(movers, stamp_s, options.min_speed_m_s));
    }
    if (score.result().pictures == 0) {
        throw Error(
            "no mask of '" + estimated_folder + "' has the stamp of one of '" + true_folder + "'",
            "check that they belong together");
    }
    return score.result();
}

Report reportOf(const std::string& masks, const MaskAccuracy& accuracy) {
    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    return {masks,
            {{"pictures", count(accuracy.pictures), "pictures", 0},
             {"missing_masks", count(accuracy.missing), "pictures", 0},
             {"scored_pictures", count(accuracy.scored), "pictures", 0},
             {"iou.mean", accuracy.mean_iou, "", 4},
             {"iou.median", accuracy.median_iou, "", 4},
             {"iou.total", accuracy.total_iou, "", 4},
             {"good_pictures", 100 * accuracy.good, "%", 2},
             {"falsely_masked", 100 * accuracy.falsely_masked, "%", 3}}};
}

}  // namespace rgbd_graphslam
