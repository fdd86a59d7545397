#include "rgbd_graphslam/benchmark/sequence_search.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/dataset/sequence_archive.h"
#include "rgbd_graphslam/dataset/sequence_layout.h"
#include "rgbd_graphslam/dataset/unpacked_bag.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

/** What is preferred where names agree, best first. */
enum class Kind { Folder, Archive, Rawlog, None };

Kind kindOf(const fs::path& path) {
    if (layoutOf(path)) return Kind::Folder;
    if (isSequenceArchive(path) || isBag(path)) return Kind::Archive;
    return fs::is_regular_file(path) && path.extension() == ".rawlog" ? Kind::Rawlog : Kind::None;
}

/** The sequences below one root by name. */
class Search {
  public:
    Search(fs::path root, const fs::path& leave_out) : root_(std::move(root)), seen_{leave_out} {
        look(root_);
    }

    std::map<std::string, std::pair<Kind, std::string>> found;

  private:
    void look(const fs::path& path) {
        const Kind kind = kindOf(path);
        if (kind != Kind::None) {
            const auto entry = std::make_pair(kind, path.string());
            const auto known = found.emplace(nameOf(path, kind), entry).first;
            known->second = std::min(known->second, entry);
        } else if (fs::is_directory(path) && seen_.insert(fs::canonical(path)).second) {
            const auto skip = fs::directory_options::skip_permission_denied;
            for (const auto& below : fs::directory_iterator(path, skip)) look(below.path());
        }
    }

    std::string nameOf(const fs::path& path, Kind kind) const {
        const fs::path name =
            path == root_ ? fs::weakly_canonical(path).filename() : path.lexically_relative(root_);
        std::string text = kind == Kind::Folder ? name.string() : withoutEnding(name);
        std::replace(text.begin(), text.end(), '/', '_');
        return text;
    }

    static std::string withoutEnding(fs::path name) {
        const std::string unpacked = withoutArchiveEnding(name);
        return unpacked != name ? unpacked : name.replace_extension().string();
    }

    fs::path root_;
    std::set<fs::path> seen_;  // links can lead back
};

}  // namespace

std::vector<FoundSequence> findSequences(const std::vector<std::string>& roots,
                                         const std::string& leave_out) {
    std::map<std::string, std::string> all;
    for (const auto& root : roots) {
        if (!fs::exists(root)) throw Error("there is no '" + root + "'", "check the name");
        for (const auto& [name, what] :
             Search(fs::path(root).lexically_normal(), fs::weakly_canonical(leave_out)).found) {
            const auto& [other, is_new] = all.emplace(name, what.second);
            if (!is_new && other->second != what.second) {
                throw Error(
                    "'" + other->second + "' and '" + what.second + "' are both named " + name,
                    "rename one, or give them in two calls");
            }
        }
    }
    if (all.empty()) {
        throw Error("there is no sequence in '" + roots.front() + "'",
                    "give folders that hold RGB-D sequences, their archives or rawlogs");
    }
    std::vector<FoundSequence> list;
    list.reserve(all.size());
    for (const auto& [name, source] : all) list.push_back({name, source});
    return list;
}

Share parseShare(const std::string& text) {
    Share share;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%zu/%zu%c", &share.part, &share.of, &rest) != 2 ||
        text.find('-') != std::string::npos || share.part < 1 || share.part > share.of) {
        throw Error("'" + text + "' is no share of the work", "write i/n with 1 <= i <= n");
    }
    return share;
}

std::vector<FoundSequence> shareOf(const std::vector<FoundSequence>& all, const Share& share) {
    std::vector<FoundSequence> mine;
    for (std::size_t i = share.part - 1; i < all.size(); i += share.of) mine.push_back(all[i]);
    return mine;
}

}  // namespace rgbd_graphslam
