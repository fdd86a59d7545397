#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <fstream>
#include <sstream>

#include "file_bytes.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/mapping/map_files.h"

namespace rgbd_graphslam {
namespace {

constexpr int tree_levels = 16;
constexpr const char* binary_magic = "# Octomap OcTree binary file";
constexpr const char* full_magic = "# Octomap OcTree file";

/** The text before the nodes: `key value` lines up to `data`. */
struct Header {
    std::string id;
    std::size_t nodes = 0;
    double resolution_m = 0;
    std::size_t length = 0;  // bytes
};

class OcTreeFile {
  public:
    OcTreeFile(const std::string& path, const std::string& magic)
        : path_(path), bytes_(readBytes(path)) {
        std::istringstream lines(bytes_.substr(0, 4096));
        std::string line;
        if (!std::getline(lines, line) || line.rfind(magic, 0) != 0)
            refuse("is no octree of OctoMap");
        while (std::getline(lines, line) && line != "data") {
            std::istringstream words(line);
            std::string key;
            words >> key;
            if (key == "id") words >> header_.id;
            if (key == "size") words >> header_.nodes;
            if (key == "res") words >> header_.resolution_m;
        }
        if (line != "data" || lines.eof()) refuse("has no complete header");
        if (!(header_.resolution_m > 0)) refuse("has no resolution");
        header_.length = static_cast<std::size_t>(lines.tellg());
    }

    /** Two bits a child: 0 unknown, 1 occupied, 2 free, 3 inner node. */
    void checkBinary(const std::string& id) {
        checkId(id);
        at_ = header_.length;
        found_ = 0;
        if (header_.nodes > 0) walkBinary(0);
        checkCount();
    }

    /** \param record bytes of a node before its byte of children */
    void checkFull(const std::string& id, std::size_t record) {
        checkId(id);
        at_ = header_.length;
        found_ = 0;
        if (header_.nodes > 0) walkFull(0, record);
        checkCount();
    }

    double resolution() const { return header_.resolution_m; }
    std::size_t nodes() const { return header_.nodes; }
    std::string nodeBytes() const { return bytes_.substr(header_.length); }

    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("'" + path_ + "' " + why, "write the map again with rgbd-map");
    }

  private:
    void checkId(const std::string& id) const {
        if (header_.id != id) refuse("holds a tree of type '" + header_.id + "', not " + id);
    }

    void checkCount() const {
        if (found_ != header_.nodes) {
            refuse("is damaged: " + std::to_string(found_) + " nodes instead of " +
                   std::to_string(header_.nodes));
        }
    }

    unsigned byte() {
        if (at_ >= bytes_.size()) refuse("is cut off");
        return static_cast<unsigned char>(bytes_[at_++]);
    }

    void checkDepth(int depth) const {
        if (depth > tree_levels) refuse("is damaged: nodes below the lowest level");
    }

    void walkBinary(int depth) {
        checkDepth(depth + 1);
        ++found_;
        const unsigned low = byte(), children = byte() << 8 | low;
        for (int i = 0; i < 8; ++i) {
            const unsigned kind = children >> (2 * i) & 3;
            if (kind == 3) {
                walkBinary(depth + 1);
            } else {
                found_ += kind != 0;
            }
        }
    }

    void walkFull(int depth, std::size_t record) {
        checkDepth(depth);
        ++found_;
        at_ += record;
        const unsigned children = byte();
        for (int i = 0; i < 8; ++i) {
            if (children >> i & 1) walkFull(depth + 1, record);
        }
    }

    std::string path_, bytes_;
    Header header_;
    std::size_t at_ = 0, found_ = 0;
};

/** As OctoMap's own writers do, which print to the terminal and do not check the stream. */
void writeHeader(std::ostream& out, const char* magic, const octomap::AbstractOcTree& tree) {
    out << magic
        << "\n# (feel free to add / change comments, but leave the first line as it is!)\n#\n"
        << "id " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
        << tree.getResolution() << "\ndata\n";
}

template <class Write>
void saveStream(const std::string& path, Write write) {
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        const bool ok = write(out);
        out.close();
        return ok && out.good();
    });
}

}  // namespace

void saveBinaryOcTree(const std::string& path, const octomap::OcTree& tree) {
    saveStream(path, [&](std::ostream& out) {
        writeHeader(out, binary_magic, tree);
        return tree.writeBinaryData(out).good();
    });
}

void saveColorOcTree(const std::string& path, const octomap::ColorOcTree& tree) {
    saveStream(path, [&](std::ostream& out) {
        writeHeader(out, full_magic, tree);
        return tree.writeData(out).good();
    });
}

std::unique_ptr<octomap::OcTree> loadBinaryOcTree(const std::string& path) {
    OcTreeFile file(path, binary_magic);
    file.checkBinary("OcTree");
    auto tree = std::make_unique<octomap::OcTree>(file.resolution());
    std::istringstream in(file.nodeBytes());
    if (file.nodes() > 0) tree->readBinaryData(in);
    return tree;
}

std::unique_ptr<octomap::ColorOcTree> loadColorOcTree(const std::string& path) {
    constexpr std::size_t log_odds_and_color = 4 + 3;
    OcTreeFile file(path, full_magic);
    file.checkFull("ColorOcTree", log_odds_and_color);
    auto tree = std::make_unique<octomap::ColorOcTree>(file.resolution());
    std::istringstream in(file.nodeBytes());
    if (file.nodes() > 0) tree->readData(in);
    return tree;
}

}  // namespace rgbd_graphslam
