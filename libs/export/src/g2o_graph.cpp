#include <filesystem>
#include <fstream>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/export/pose_graph_text.h"

namespace rgbd_graphslam {
namespace {

class G2oExporter : public Exporter {
  public:
    const char* name() const override { return "g2o"; }
    const char* about() const override { return "pose graph with loops, g2o"; }
    const char* fileName() const override { return "graph.g2o"; }

    std::string write(const std::string& run_folder, const ExportOptions&,
                      const std::string& path) const override {
        const std::string source = (std::filesystem::path(run_folder) / "graph.graph").string();
        std::ifstream in(source, std::ios::binary);
        if (!in) {
            throw Error("cannot read '" + source + "'",
                        "give the output folder of a finished rgbd-slam run");
        }
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        const PoseGraphText graph = parseMrptGraph(text, source);
        writeTextAtomically(path, toG2oText(graph));
        return std::to_string(graph.nodes.size()) + " vertices, " +
               std::to_string(graph.edges.size()) + " edges";
    }
};

}  // namespace

std::unique_ptr<const Exporter> g2oExporter() {
    return std::make_unique<G2oExporter>();
}

}  // namespace rgbd_graphslam
