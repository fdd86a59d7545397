#include "frame_pairs.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/geometry/associate.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** Images whose file exists, in order of time, each stamp once. */
std::vector<ListedImage> usableImages(const RgbdSequence& sequence,
                                      const std::vector<ListedImage>& images, bool strict,
                                      ImageTally& tally) {
    tally.listed = images.size();
    tally.backwards = stampOrder(images).backwards;
    std::set<long long> seen;
    std::vector<ListedImage> usable;
    for (const auto& image : images) {
        const fs::path file = fs::path(sequence.folder) / image.file;
        if (!fs::is_regular_file(file)) {
            if (strict) {
                throw Error("the listed image '" + file.string() + "' is missing",
                            "fetch the sequence again, or leave out --strict to go on without it");
            }
            if (tally.missing++ == 0) tally.first_missing = image.file;
        } else if (!seen.insert(microseconds(image.stamp_s)).second) {
            ++tally.repeated;
        } else {
            usable.push_back(image);
        }
    }
    std::stable_sort(usable.begin(), usable.end(),
                     [](const auto& a, const auto& b) { return a.stamp_s < b.stamp_s; });
    return usable;
}

std::vector<double> stampsOf(const std::vector<ListedImage>& images) {
    std::vector<double> stamps;
    stamps.reserve(images.size());
    for (const auto& image : images) stamps.push_back(image.stamp_s);
    return stamps;
}

/** Where all files of a list are missing: that, and the first of them. */
std::string missingText(const ImportReport& report) {
    for (const ImageTally* tally : {&report.color, &report.depth}) {
        if (tally->missing == tally->listed && tally->listed > 0) {
            return ", the listed files are missing (the first: '" + tally->first_missing + "')";
        }
    }
    return "";
}

/** Tells images that had nobody near from those whose partners went to others.
 *  \param own, other ascending stamps */
void tallyLeftOver(const std::vector<double>& own, const std::vector<bool>& paired,
                   const std::vector<double>& other, double max_difference, ImageTally& tally) {
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (paired[i]) continue;
        const auto next = std::lower_bound(other.begin(), other.end(), own[i]);
        const bool near = (next != other.end() && *next - own[i] < max_difference) ||
                          (next != other.begin() && own[i] - *(next - 1) < max_difference);
        ++(near ? tally.partner_taken : tally.no_partner);
    }
}

void refuseLoss(std::size_t pairs, const RgbdSequence& sequence, const ImportOptions& options,
                const ImportReport& report) {
    const std::size_t possible = std::min(report.color.listed, report.depth.listed);
    if (2 * pairs >= possible) return;
    const std::size_t missing = report.color.missing + report.depth.missing;
    throw Error("only " + std::to_string(pairs) + " of " + std::to_string(possible) +
                    " frames of '" + sequence.folder + "' have color and depth within " +
                    shortest(options.max_difference_s) + " s of each other" +
                    (missing > 0 ? " (" + std::to_string(missing) + " listed files are missing)"
                                 : std::string()),
                "check stamps and files, raise --max-difference, or pass --allow-loss to import "
                "what there is");
}

}  // namespace

std::vector<FramePair> pairUp(const RgbdSequence& sequence, const ImportOptions& options,
                              ImportReport& report) {
    const auto color = usableImages(sequence, sequence.color, options.strict, report.color);
    auto depth = usableImages(sequence, sequence.depth, options.strict, report.depth);
    for (ListedImage& image : depth) image.stamp_s += options.depth_offset_s;
    const auto color_stamps = stampsOf(color), depth_stamps = stampsOf(depth);
    std::vector<bool> color_paired(color.size()), depth_paired(depth.size());
    std::vector<FramePair> pairs;
    for (const auto& [i, j] : associate(color_stamps, depth_stamps, options.max_difference_s)) {
        pairs.push_back({color[i], depth[j]});
        color_paired[i] = depth_paired[j] = true;
    }
    tallyLeftOver(color_stamps, color_paired, depth_stamps, options.max_difference_s, report.color);
    tallyLeftOver(depth_stamps, depth_paired, color_stamps, options.max_difference_s, report.depth);
    if (pairs.empty()) {
        throw Error("no color and depth image of '" + sequence.folder + "' are within " +
                        shortest(options.max_difference_s) + " s of each other" +
                        missingText(report),
                    "check rgb.txt and depth.txt, or raise --max-difference");
    }
    if (!options.allow_loss) refuseLoss(pairs.size(), sequence, options, report);
    return pairs;
}

}  // namespace rgbd_graphslam
