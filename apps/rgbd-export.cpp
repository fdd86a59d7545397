/** rgbd-export: a finished run in the formats of other programs. */
#include <cstdio>

#include "command_line.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/printable_text.h"
#include "rgbd_graphslam/export/exporter.h"

using namespace rgbd_graphslam;

namespace {

/** One line per format, for --help. */
std::string listOfFormats() {
    std::string list = "Formats:";
    for (const auto& exporter : exporters()) {
        char line[160];
        std::snprintf(line, sizeof(line), "\n  %-11s %s", exporter->name(), exporter->about());
        list += line;
    }
    return list;
}

}  // namespace

int main(int argc, char** argv) {
    std::string folder, output;
    std::vector<std::string> formats;
    ExportOptions options;
    CLI::App app("Writes a finished rgbd-slam run in the formats of other programs", "rgbd-export");
    app.footer(listOfFormats());
    app.add_option("OUT", folder, "Output folder of rgbd-slam")->required();
    app.add_option("--to", formats, "Format, see below; may be repeated")
        ->required()
        ->delimiter(',')
        ->expected(1)
        ->take_all()
        ->type_name("FORMAT");
    app.add_option(
        "-o,--output", output,
        "File or folder to write, or existing folder to write into (default: OUT/export)");
    app.add_option("--rawlog", options.rawlog, "Where the rawlog is now, if it was moved");
    app.add_flag("--frames", options.all_frames,
                 "Images of all frames with a pose, not only of keyframes");
    app.add_flag("--vertex-colors", options.vertex_colors,
                 "Meshes with vertex colors instead of a texture (quick)");
    app.add_option("--texture-size", options.texture_size,
                   "Maximum width and height of the texture [px]")
        ->check(between(256, 16384))
        ->capture_default_str();
    declareCommonOptions(app);
    return runProgram(app, argc, argv, [&] {
        for (const ExportedFile& file : exportRun(folder, formats, options, output)) {
            if (verbosity() != Verbosity::Quiet)
                std::printf("%s: %s\n", printableLine(file.path).c_str(), file.summary.c_str());
        }
        return 0;
    });
}
