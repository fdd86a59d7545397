#include "bag_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "mcap_file.h"
#include "rgbd_graphslam/core/error.h"
#include "ros1_bag.h"
#include "ros2_database.h"
#include "unpacked_bytes.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr const char* metadata_name = "metadata.yaml";

bool endsWith(const std::string& text, const std::string& ending) {
    return text.size() > ending.size() &&
           text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

bool isPacked(const std::string& name) {
    return endsWith(name, ".zstd") || endsWith(name, ".zst");
}

std::string withoutPacking(const std::string& name) {
    return isPacked(name) ? fs::path(name).replace_extension().string() : name;
}

/** The parts of a split recording are numbered without leading zeros. */
bool isEarlierPart(const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
}

fs::path lastName(const std::string& path) {
    const fs::path normal = fs::absolute(path).lexically_normal();
    return normal.has_filename() ? normal.filename() : normal.parent_path().filename();
}

/** Files that are named after the folder they are in, in order. */
std::vector<std::string> partsNamedAfter(const fs::path& folder) {
    std::vector<std::string> parts;
    const std::string start = lastName(folder);
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
        const std::string name = entry.path().filename();
        const bool is_ros2 = hasBagEnding(name) && entry.path().extension() != ".bag";
        if (is_ros2 && name.rfind(start, 0) == 0) parts.push_back(entry.path().string());
    }
    std::sort(parts.begin(), parts.end(), isEarlierPart);
    return parts;
}

/** The names in metadata.yaml below `relative_file_paths`, each a line with a dash. */
std::vector<std::string> listedParts(const fs::path& metadata) {
    std::ifstream in(metadata);
    std::vector<std::string> names;
    bool listed = false;
    for (std::string line; std::getline(in, line);) {
        const auto dash = line.find_first_not_of(' ');
        const bool is_entry = dash != std::string::npos && line.compare(dash, 2, "- ") == 0;
        if (listed && is_entry) names.push_back(line.substr(dash + 2));
        if (listed && !is_entry) break;
        listed = listed || line.find("relative_file_paths:") != std::string::npos;
    }
    return names;
}

/** The files that metadata.yaml lists; those that were unpacked since have lost an ending. */
std::vector<std::string> partsListed(const fs::path& folder) {
    std::vector<std::string> parts;
    for (const std::string& name : listedParts(folder / metadata_name)) {
        const fs::path file = folder / fs::path(name).filename();
        parts.push_back(fs::exists(file) ? file.string() : withoutPacking(file));
        if (!fs::exists(parts.back())) {
            throw Error("'" + file.string() + "', which metadata.yaml lists, is missing",
                        "copy the whole folder, or give the file of one part");
        }
    }
    return parts;
}

std::unique_ptr<MessageSource> sourceOf(const std::string& file) {
    if (endsWith(file, ".mcap")) return std::make_unique<McapFile>(file);
    if (endsWith(file, ".db3")) return std::make_unique<Ros2Database>(file);
    return std::make_unique<Ros1Bag>(file);
}

/** Unpacks a message that the recorder of ROS 2 packed by itself. */
void useUnpacked(const RecordedMessage& message, double share, const UseMessage& use) {
    if (message.format == WireFormat::Ros1 || !isZstandard(message.bytes)) {
        return use(message, share);
    }
    const std::string bytes = unpackedBytes(message.bytes, 0);
    RecordedMessage unpacked = message;
    unpacked.bytes = bytes;
    use(unpacked, share);
}

void useWhole(const RecordedMessage& message, double share, const UseMessage& use) {
    try {
        useUnpacked(message, share, use);
    } catch (const std::out_of_range& e) {
        throw Error("a message of '" + message.topic + "' (" + message.type + ") is not whole (" +
                        e.what() + ")",
                    "copy the recording again");
    }
}

}  // namespace

std::string withoutMsg(std::string type) {
    const auto middle = type.find("/msg/");
    return middle == std::string::npos ? type : type.erase(middle, 4);
}

bool hasBagEnding(const std::string& name) {
    const std::string plain = withoutPacking(name);
    return endsWith(plain, ".db3") || endsWith(plain, ".mcap") || endsWith(name, ".bag") ||
           endsWith(name, ".bag.active");
}

bool isBagFolder(const std::string& folder) {
    const fs::path metadata = fs::path(folder) / metadata_name;
    return !listedParts(metadata).empty() || !partsNamedAfter(folder).empty();
}

std::string bagName(const std::string& bag) {
    std::string name = lastName(bag);
    if (fs::is_directory(bag)) return name;
    name = withoutPacking(name);
    for (const char* ending : {".active", ".bag", ".db3", ".mcap"}) {
        if (endsWith(name, ending)) name.resize(name.size() - std::string(ending).size());
    }
    return name;
}

BagFiles::BagFiles(const std::string& bag, const std::string& scratch)
    : scratch_((fs::path(scratch) / "unpacked").string()) {
    if (!fs::exists(bag)) throw Error("there is no '" + bag + "'", "check the name");
    if (!fs::is_directory(bag)) {
        open(bag);
        return;
    }
    lacks_metadata_ = !fs::exists(fs::path(bag) / metadata_name);
    for (const auto& part : lacks_metadata_ ? partsNamedAfter(bag) : partsListed(bag)) open(part);
    if (files_.empty()) {
        throw Error("'" + bag + "' holds no .db3 or .mcap file", "give the folder of a ROS 2 bag");
    }
}

void BagFiles::open(const std::string& file) {
    std::string plain = file;
    if (isPacked(file)) {
        plain = fs::path(scratch_.path()) / fs::path(withoutPacking(file)).filename();
        unpackFile(file, plain);
    }
    files_.push_back(sourceOf(plain));
    names_.push_back(file);
}

std::string BagFiles::forEachMessage(const UseMessage& use) {
    std::string missing;
    if (lacks_metadata_) missing = "there is no metadata.yaml: the recorder was killed";
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const auto use_one = [&](const RecordedMessage& message, double share) {
            const double of_all =
                (static_cast<double>(i) + share) / static_cast<double>(files_.size());
            useWhole(message, of_all, use);
        };
        const std::string problem = files_[i]->forEachMessage(use_one);
        if (problem.empty()) continue;
        missing = files_.size() > 1 ? "'" + names_[i] + "': " + problem : problem;
    }
    return missing;
}

}  // namespace rgbd_graphslam
