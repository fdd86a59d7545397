#include "image_list.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "scan_list.h"
#include "stamp_unit.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::string withoutQuotes(const std::string& text) {
    const bool quoted = text.size() > 2 && (text.front() == '"' || text.front() == '\'') &&
                        text.back() == text.front();
    return quoted ? text.substr(1, text.size() - 2) : text;
}

std::string withSlashes(std::string text) {
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

std::vector<StampedVector> readVectors(const std::string& path, const std::string& form) {
    std::vector<StampedVector> result;
    if (!fs::exists(path)) return result;
    forEachLine(path, [&](Line& line) {
        StampedVector sample;
        sample.stamp_s = line.realNumber(form);
        for (int i = 0; i < 3; ++i) sample.value[i] = line.realNumber(form);
        if (!line.rest().empty()) line.refuse("too many values", form);
        result.push_back(sample);
    });
    return result;
}

template <class Entry>
std::vector<double> stampsOf(const std::vector<Entry>& list) {
    std::vector<double> stamps;
    stamps.reserve(list.size());
    for (const auto& entry : list) stamps.push_back(entry.stamp_s);
    return stamps;
}

template <class Entry>
void scale(std::vector<Entry>& list, const StampUnit& unit) {
    if (unit.seconds == 1) return;
    for (auto& entry : list) entry.stamp_s *= unit.seconds;
}

/** rawlogs hold stamps from 1601 on in 100 ns. */
void checkRange(const std::string& list, const std::vector<double>& stamps) {
    constexpr double latest_s = 1e11;
    for (const double stamp : stamps) {
        if (std::abs(stamp) <= latest_s && stamp > -1e10) continue;
        throw Error(list + " have the stamp " + shortest(stamp) + ", which is no time in any unit",
                    "stamps are UNIX time or time since the start, in s");
    }
}

/** Another sensor's list next to the images. */
template <class Entry>
void unifyBeside(const std::string& list, double first_s, double last_s,
                 std::vector<Entry>& entries, std::vector<std::string>& notes) {
    if (entries.empty()) return;
    const auto unit = unitToOverlap(stampsOf(entries), first_s, last_s);
    if (!unit) {
        notes.push_back(list + " do not overlap the images in time");
    } else if (unit->seconds != 1) {
        notes.push_back("stamps of " + list + " look like " + unit->name + ": taken as such");
        scale(entries, *unit);
    }
    checkRange(list, stampsOf(entries));
}

}  // namespace

std::string listedFile(const std::string& folder, const std::string& entry,
                       std::set<std::string>& what_was_done) {
    const auto exists = [&](const std::string& name) {
        return !name.empty() && fs::is_regular_file(fs::path(folder) / name);
    };
    if (exists(entry)) return entry;
    const std::string plain = withoutQuotes(entry);
    if (exists(plain)) return plain;
    if (exists(withSlashes(plain))) {
        what_was_done.insert("backslashes in file names are taken as slashes");
        return withSlashes(plain);
    }
    const std::string first = withoutQuotes(entry.substr(0, entry.find(' ')));
    for (const std::string& name : {first, withSlashes(first)}) {
        if (name == plain || !exists(name)) continue;
        what_was_done.insert("columns after the file name are ignored");
        return name;
    }
    return entry;
}

std::vector<ListedImage> readImageList(const std::string& folder, const std::string& name,
                                       std::vector<std::string>& notes) {
    const std::string form = "stamp file", path = fs::path(folder) / name;
    std::vector<ListedImage> images;
    std::set<std::string> what_was_done;
    forEachLine(path, [&](Line& line) {
        const double stamp = line.realNumber(form);
        const std::string entry = line.rest();
        if (entry.empty()) line.refuse("no file name", form);
        images.push_back({stamp, listedFile(folder, entry, what_was_done)});
        if (line.had_decimal_commas) what_was_done.insert("commas are taken as decimal points");
    });
    if (images.empty()) throw Error("'" + path + "' lists no image", "fetch the sequence again");
    for (const std::string& line : what_was_done) notes.push_back(name + ": " + line);
    return images;
}

void readMotionFiles(const std::string& folder, RgbdSequence& sequence) {
    const fs::path path(folder);
    if (fs::exists(path / "groundtruth.txt")) {
        sequence.truth = readTumTrajectory(path / "groundtruth.txt");
    }
    sequence.acceleration = readVectors(path / "accelerometer.txt", "stamp ax ay az");
    sequence.angular_velocity = readVectors(path / "gyroscope.txt", "stamp wx wy wz");
    sequence.odometry = readVectors(path / "odometry.txt", "stamp x y theta");
    const auto scans = readScanList((path / "scans.txt").string());
    sequence.others.insert(sequence.others.end(), scans.begin(), scans.end());
}

void unifyStamps(RgbdSequence& sequence, bool images_in_seconds, const ImageListNames& names) {
    if (sequence.color.empty()) return;
    const StampUnit unit =
        images_in_seconds ? stampUnits().front() : unitOfStamps(stampsOf(sequence.color));
    if (unit.seconds != 1) {
        sequence.notes.push_back(std::string("stamps of ") + names.color + " look like " +
                                 unit.name + ": taken as such");
        scale(sequence.color, unit);
    }
    const auto stamps = stampsOf(sequence.color);
    checkRange(names.color, stamps);
    const auto [first, last] = std::minmax_element(stamps.begin(), stamps.end());
    const auto beside = [&, first_s = *first, last_s = *last](const char* list, auto& entries) {
        unifyBeside(list, first_s, last_s, entries, sequence.notes);
    };
    if (!images_in_seconds) beside(names.depth, sequence.depth);
    beside("the ground truth", sequence.truth);
    beside("the accelerometer's readings", sequence.acceleration);
    beside("the gyroscope's readings", sequence.angular_velocity);
    beside("the odometry's readings", sequence.odometry);
}

}  // namespace rgbd_graphslam
