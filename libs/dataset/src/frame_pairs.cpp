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
std::vector<ListedImage> usableImages(const std::string& folder, const ImageStream& stream,
                                      bool strict) {
    ImageTally& tally = stream.tally;
    tally.listed = stream.images.size();
    tally.backwards = stampOrder(stream.images).backwards;
    std::set<long long> seen;
    std::vector<ListedImage> usable;
    for (const auto& image : stream.images) {
        const fs::path file = fs::path(folder) / image.file;
        if (!fs::is_regular_file(file)) {
            if (strict) {
                throw Error("the listed image '" + file.string() + "' is missing",
                            "fetch the sequence again, or leave out --strict to go on without it");
            }
            if (tally.missing++ == 0) tally.first_missing = image.file;
        } else if (!seen.insert(microseconds(image.stamp_s)).second) {
            ++tally.repeated;
        } else {
            usable.push_back({image.stamp_s + stream.offset_s, image.file});
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
std::string missingText(const ImageStream& first, const ImageStream& second) {
    for (const ImageTally* tally : {&first.tally, &second.tally}) {
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

void refuseLoss(std::size_t pairs, const std::string& folder, const ImageStream& first,
                const ImageStream& second, double max_difference_s) {
    const std::size_t possible = std::min(first.tally.listed, second.tally.listed);
    if (2 * pairs >= possible) return;
    const std::size_t missing = first.tally.missing + second.tally.missing;
    throw Error("only " + std::to_string(pairs) + " of " + std::to_string(possible) +
                    " frames of '" + folder + "' have " + first.name + " and " + second.name +
                    " within " + shortest(max_difference_s) + " s of each other" +
                    (missing > 0 ? " (" + std::to_string(missing) + " listed files are missing)"
                                 : std::string()),
                "check stamps and files, raise --max-difference, or pass --allow-loss to import "
                "what there is");
}

}  // namespace

std::vector<ImagePair> pairUp(const std::string& folder, const ImageStream& first,
                              const ImageStream& second, const ImportOptions& options) {
    const double nearest_s = options.max_difference_s;
    const auto a = usableImages(folder, first, options.strict),
               b = usableImages(folder, second, options.strict);
    const auto a_stamps = stampsOf(a), b_stamps = stampsOf(b);
    std::vector<bool> a_paired(a.size()), b_paired(b.size());
    std::vector<ImagePair> pairs;
    for (const auto& [i, j] : associate(a_stamps, b_stamps, nearest_s)) {
        pairs.push_back({a[i], b[j]});
        a_paired[i] = b_paired[j] = true;
    }
    tallyLeftOver(a_stamps, a_paired, b_stamps, nearest_s, first.tally);
    tallyLeftOver(b_stamps, b_paired, a_stamps, nearest_s, second.tally);
    if (pairs.empty()) {
        throw Error("no " + first.name + " and " + second.name + " image of '" + folder +
                        "' are within " + shortest(nearest_s) + " s of each other" +
                        missingText(first, second),
                    "check the stamps of both lists, or raise --max-difference");
    }
    if (!options.allow_loss) refuseLoss(pairs.size(), folder, first, second, nearest_s);
    return pairs;
}

std::string tallyText(const std::string& name, const std::string& other, const ImageTally& tally) {
    std::string text = name + ": " + std::to_string(tally.listed) + " listed, " +
                       std::to_string(tally.leftOver()) + " unpaired";
    std::string reasons;
    const auto reason = [&](std::size_t count, const std::string& why) {
        if (count > 0) reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + why;
    };
    reason(tally.no_partner, "without " + other + " near enough");
    reason(tally.partner_taken, "whose " + other + " went to a nearer one");
    reason(tally.missing, "files missing, the first: '" + tally.first_missing + "'");
    reason(tally.repeated, "with a repeated timestamp");
    if (!reasons.empty()) text += " (" + reasons + ")";
    if (tally.backwards > 0) text += "; " + std::to_string(tally.backwards) + " out of order";
    return text + "\n";
}

std::vector<FramePair> pairUp(const RgbdSequence& sequence, const ImportOptions& options,
                              ImportReport& report) {
    std::vector<FramePair> frames;
    for (auto& [color, depth] :
         pairUp(sequence.folder, {"color", sequence.color, report.color},
                {"depth", sequence.depth, report.depth, options.depth_offset_s}, options)) {
        frames.push_back({std::move(color), std::move(depth)});
    }
    return frames;
}

}  // namespace rgbd_graphslam
