#include "rgbd_graphslam/core/input_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "rgbd_graphslam/core/error.h"

namespace rgbd_graphslam {
namespace {

bool isText(const std::string& text) {
    return std::none_of(text.begin(), text.end(),
                        [](unsigned char c) { return c < ' ' && !std::isspace(c); });
}

}  // namespace

void refuseFolder(const std::string& path, const std::string& kind) {
    std::error_code none;
    if (!std::filesystem::is_directory(path, none)) return;
    throw Error("'" + path + "' is a folder, not " + kind, "name the file");
}

std::string readTextFile(const std::string& path, const std::string& kind,
                         const std::string& remedy) {
    refuseFolder(path, kind);
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error("cannot read '" + path + "' as " + kind, remedy);
    std::ostringstream text;
    text << in.rdbuf();
    if (!isText(text.str())) throw Error("'" + path + "' is not a text file", remedy);
    return text.str();
}

}  // namespace rgbd_graphslam
