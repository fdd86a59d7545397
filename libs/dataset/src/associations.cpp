#include "associations.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "image_list.h"
#include "number_text.h"
#include "rgbd_graphslam/core/error.h"
#include "stamp_unit.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr const char* form = "stamp file stamp file";

bool speaksOfDepth(std::string file) {
    std::transform(file.begin(), file.end(), file.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return file.find("depth") != std::string::npos;
}

std::string nextFile(Line& line) {
    std::string file;
    if (!(line.words >> file)) line.refuse("too few values", form);
    return file;
}

void takeLine(Line& line, const std::string& folder, RgbdSequence& sequence,
              std::set<std::string>& what_was_done) {
    ListedImage first, second;
    first.stamp_s = line.realNumber(form);
    first.file = nextFile(line);
    std::string word = nextFile(line);
    const auto own_stamp = numberIn(word);
    second.stamp_s = own_stamp.value_or(first.stamp_s);
    second.file = own_stamp ? nextFile(line) : word;
    if (!line.rest().empty()) line.refuse("too many values", form);
    if (speaksOfDepth(first.file) == speaksOfDepth(second.file)) {
        line.refuse("cannot tell color from depth: one of '" + first.file + "' and '" +
                        second.file + "' must have depth in its name",
                    form);
    }
    if (line.had_decimal_commas) what_was_done.insert("commas are taken as decimal points");
    for (ListedImage* image : {&first, &second}) {
        const bool is_depth = speaksOfDepth(image->file);
        image->file = listedFile(folder, image->file, what_was_done);
        (is_depth ? sequence.depth : sequence.color).push_back(*image);
    }
}

RgbdSequence readLines(const std::string& folder) {
    const std::string name = associationsIn(folder), path = fs::path(folder) / name;
    RgbdSequence sequence;
    std::set<std::string> what_was_done;
    forEachLine(path, [&](Line& line) { takeLine(line, folder, sequence, what_was_done); });
    if (sequence.color.empty()) throw Error("'" + path + "' lists no image", "make it again");
    for (const std::string& line : what_was_done) sequence.notes.push_back(name + ": " + line);
    return sequence;
}

bool isNumbered(const RgbdSequence& sequence) {
    std::vector<double> stamps;
    for (const auto& image : sequence.color) stamps.push_back(image.stamp_s);
    return areFrameNumbers(stamps);
}

}  // namespace

std::string associationsIn(const std::string& folder) {
    for (const char* name : {"associations.txt", "association.txt", "associate.txt",
                             "associated.txt", "assoc.txt", "rgbd_assoc.txt"}) {
        if (fs::is_regular_file(fs::path(folder) / name)) return name;
    }
    return "";
}

RgbdSequence readAssociations(const std::string& folder, double rate_hz) {
    RgbdSequence sequence = readLines(folder);
    const bool numbered = isNumbered(sequence);
    if (numbered) {
        for (auto* images : {&sequence.color, &sequence.depth}) {
            for (auto& image : *images) image.stamp_s /= rate_hz;
        }
        sequence.notes.push_back("images are numbered: taken at " + shortest(rate_hz) +
                                 " frames/s (--rate)");
    }
    readMotionFiles(folder, sequence);
    unifyStamps(sequence, numbered);
    return sequence;
}

bool associationsAreNumbered(const std::string& folder) {
    return isNumbered(readLines(folder));
}

}  // namespace rgbd_graphslam
