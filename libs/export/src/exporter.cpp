#include "rgbd_graphslam/export/exporter.h"

#include <algorithm>
#include <filesystem>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/console.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/temporary_folder.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

std::vector<std::unique_ptr<const Exporter>> makeExporters() {
    std::vector<std::unique_ptr<const Exporter>> all;
    all.push_back(nerfstudioExporter());
    all.push_back(colmapExporter());
    all.push_back(glbExporter());
    all.push_back(objExporter());
    all.push_back(ros2BagExporter());
    all.push_back(metricMapExporter());
    all.push_back(tumExporter());
    all.push_back(kittiExporter());
    all.push_back(eurocExporter());
    all.push_back(g2oExporter());
    all.push_back(kmlExporter());
    all.push_back(geoJsonExporter());
    return all;
}

const Exporter& exporterOf(const std::string& name) {
    for (const auto& exporter : exporters()) {
        if (name == exporter->name()) return *exporter;
    }
    std::string names;
    for (const std::string& known : exportFormats()) names += (names.empty() ? "" : ", ") + known;
    throw Error("'" + name + "' is not a known format", "use one of " + names);
}

/** Where things go, and whether what is there may be replaced. */
struct Destination {
    fs::path path;
    bool replace = false;
};

Destination destinationOf(const Exporter& exporter, const std::string& run_folder,
                          const std::string& output, bool single) {
    if (output.empty()) return {fs::path(run_folder) / "export" / exporter.fileName(), true};
    if (single && !fs::is_directory(output)) return {output};
    return {fs::path(output) / exporter.fileName()};
}

/** A folder of someone else's must not be lost to a slip of the keyboard. */
void refuseToReplaceFolder(const fs::path& path) {
    if (!fs::exists(path) || (fs::is_directory(path) && fs::is_empty(path))) return;
    throw Error("'" + path.string() + "' already exists", "remove it or choose another -o");
}

std::string writeOne(const Exporter& exporter, const std::string& run_folder,
                     const ExportOptions& options, const Destination& destination) {
    makeWritableFolder(fs::absolute(destination.path).parent_path().string());
    if (!exporter.writesFolder()) return exporter.write(run_folder, options, destination.path);
    if (!destination.replace) refuseToReplaceFolder(destination.path);
    const TemporaryFolder temporary(destination.path.string());
    const std::string summary = exporter.write(run_folder, options, temporary.path());
    temporary.moveToFinalName();
    return summary;
}

}  // namespace

const std::vector<std::unique_ptr<const Exporter>>& exporters() {
    static const auto all = makeExporters();
    return all;
}

std::vector<std::string> exportFormats() {
    std::vector<std::string> names;
    for (const auto& exporter : exporters()) names.emplace_back(exporter->name());
    return names;
}

std::vector<ExportedFile> exportRun(const std::string& run_folder,
                                    const std::vector<std::string>& formats,
                                    const ExportOptions& options, const std::string& output) {
    if (!fs::is_directory(run_folder)) {
        throw Error("'" + run_folder + "' is not a folder", "give the output folder of rgbd-slam");
    }
    std::vector<const Exporter*> chosen;
    for (const std::string& name : formats) {
        const Exporter* const exporter = &exporterOf(name);
        if (std::find(chosen.begin(), chosen.end(), exporter) == chosen.end())
            chosen.push_back(exporter);
    }
    std::vector<ExportedFile> written;
    for (const Exporter* exporter : chosen) {
        const auto destination = destinationOf(*exporter, run_folder, output, chosen.size() == 1);
        sayDetail(std::string("writing ") + exporter->name());
        written.push_back(
            {destination.path.string(), writeOne(*exporter, run_folder, options, destination)});
    }
    return written;
}

}  // namespace rgbd_graphslam
