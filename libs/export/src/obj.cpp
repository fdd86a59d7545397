#include <filesystem>
#include <fstream>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/formatted.h"
#include "rgbd_graphslam/export/mesh_files.h"
#include "run_images.h"
#include "run_mesh.h"
#include "run_texture.h"

namespace rgbd_graphslam {
namespace fs = std::filesystem;
namespace {

constexpr const char* head = "# rgbd-graphslam; meters, z up\n";
constexpr const char* material =
    "newmtl map\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd mesh.jpg\n";

/** Line by line: the text is several times as large as the mesh. */
void writeLines(const fs::path& path, const std::function<void(std::ostream&)>& write) {
    writeAtomically(path.string(), [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << head;
        write(out);
        out.close();
        return out.good();
    });
}

class ObjExporter : public Exporter {
  public:
    const char* name() const override { return "obj"; }
    const char* about() const override { return "textured mesh (Wavefront OBJ, MTL, JPEG)"; }
    const char* fileName() const override { return "obj"; }
    bool writesFolder() const override { return true; }

    std::string write(const std::string& run_folder, const ExportOptions& options,
                      const std::string& path) const override {
        if (options.vertex_colors) {
            const PlyModel mesh = readRunMesh(run_folder);
            writeObj(path, mesh);
            return std::to_string(mesh.triangles.size()) + " triangles with vertex colors";
        }
        const RunTexture textured = textureOf(run_folder, options);
        writeObj(path, textured.mesh);
        return describe(textured);
    }
};

}  // namespace

void writeObj(const std::string& folder, const TexturedMesh& mesh) {
    const fs::path root(folder);
    writeImage((root / "mesh.jpg").string(), mesh.texture);
    writeTextAtomically((root / "mesh.mtl").string(), material);
    writeLines(root / "mesh.obj", [&](std::ostream& out) {
        out << "mtllib mesh.mtl\nusemtl map\n";
        for (const auto& p : mesh.vertices)
            out << formatted("v %.5f %.5f %.5f\n", p.x(), p.y(), p.z());
        for (const auto& uv : mesh.uv) out << formatted("vt %.7f %.7f\n", uv.x(), 1 - uv.y());
        for (const auto& t : mesh.triangles) {
            out << formatted("f %u/%u %u/%u %u/%u\n", t[0] + 1, t[0] + 1, t[1] + 1, t[1] + 1,
                             t[2] + 1, t[2] + 1);
        }
    });
}

void writeObj(const std::string& folder, const PlyModel& mesh) {
    writeLines(fs::path(folder) / "mesh.obj", [&](std::ostream& out) {
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            const auto& p = mesh.vertices[i];
            const auto& rgb = mesh.colors[i];
            out << formatted("v %.5f %.5f %.5f %.4f %.4f %.4f\n", p.x(), p.y(), p.z(),
                             rgb[0] / 255., rgb[1] / 255., rgb[2] / 255.);
        }
        for (const auto& t : mesh.triangles)
            out << formatted("f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
    });
}

std::unique_ptr<const Exporter> objExporter() {
    return std::make_unique<ObjExporter>();
}

}  // namespace rgbd_graphslam
