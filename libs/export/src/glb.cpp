#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "formats.h"
#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/byte_stream.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/export/mesh_files.h"
#include "run_mesh.h"
#include "run_texture.h"

namespace rgbd_graphslam {
namespace {

using nlohmann::json;

// Numbers of glTF 2.0.
constexpr int unsigned_short = 5123, unsigned_int = 5125, float_32 = 5126;
constexpr int vertex_data = 34962, index_data = 34963;
constexpr int linear = 9729, linear_mipmap_linear = 9987, clamp_to_edge = 33071;

/** The binary buffer and what the JSON part says of it. */
class GltfBuffer {
  public:
    /** \return number of the view */
    int addView(std::string_view bytes, int target = 0) {
        json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}};
        if (target) view["target"] = target;
        views_.push_back(view);
        bytes_ += bytes;
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return static_cast<int>(views_.size()) - 1;
    }

    /** \return number of the accessor */
    int addAccessor(std::string_view bytes, int target, int component, const char* type,
                    std::size_t count, const json& more = json::object()) {
        json accessor = {{"bufferView", addView(bytes, target)},
                         {"componentType", component},
                         {"type", type},
                         {"count", count}};
        accessor.update(more);
        accessors_.push_back(accessor);
        return static_cast<int>(accessors_.size()) - 1;
    }

    void describe(json& gltf) const {
        gltf["buffers"] = {{{"byteLength", bytes_.size()}}};
        gltf["bufferViews"] = views_;
        gltf["accessors"] = accessors_;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
    json views_ = json::array(), accessors_ = json::array();
};

Eigen::Vector3f yUp(const Eigen::Vector3f& p) {
    return {p.x(), p.z(), -p.y()};
}

int addPositions(const std::vector<Eigen::Vector3f>& vertices, GltfBuffer& buffer) {
    Eigen::Array3f low = yUp(vertices.front()), high = low;
    ByteWriter bytes;
    for (const Eigen::Vector3f& vertex : vertices) {
        const Eigen::Vector3f p = yUp(vertex);
        for (int i = 0; i < 3; ++i) bytes.put(p[i]);
        low = low.min(p.array());
        high = high.max(p.array());
    }
    return buffer.addAccessor(
        bytes.bytes(), vertex_data, float_32, "VEC3", vertices.size(),
        {{"min", {low.x(), low.y(), low.z()}}, {"max", {high.x(), high.y(), high.z()}}});
}

int addIndices(const std::vector<std::array<std::uint32_t, 3>>& triangles, GltfBuffer& buffer) {
    ByteWriter bytes;
    for (const auto& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) bytes.put(vertex);
    }
    return buffer.addAccessor(bytes.bytes(), index_data, unsigned_int, "SCALAR",
                              3 * triangles.size());
}

int addUv(const std::vector<Eigen::Vector2f>& uv, GltfBuffer& buffer) {
    ByteWriter bytes;
    for (const Eigen::Vector2f& place : uv) {
        bytes.put(place.x());
        bytes.put(place.y());
    }
    return buffer.addAccessor(bytes.bytes(), vertex_data, float_32, "VEC2", uv.size());
}

/** Colors of vertices are linear in glTF, images are sRGB (IEC 61966-2-1). */
std::uint16_t linearColor(std::uint8_t srgb) {
    const double value = srgb / 255.;
    const double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(std::lround(65535 * light));
}

int addColors(const std::vector<std::array<std::uint8_t, 3>>& colors, GltfBuffer& buffer) {
    constexpr std::uint16_t opaque = 65535;
    std::array<std::uint16_t, 256> linear_of{};
    for (int i = 0; i < 256; ++i) linear_of[i] = linearColor(static_cast<std::uint8_t>(i));
    ByteWriter bytes;
    for (const auto& rgb : colors) {
        for (const std::uint8_t channel : rgb) bytes.put(linear_of[channel]);
        bytes.put(opaque);
    }
    return buffer.addAccessor(bytes.bytes(), vertex_data, unsigned_short, "VEC4", colors.size(),
                              {{"normalized", true}});
}

json sceneOf(const json& attributes, int indices, const json& look) {
    json material = {{"pbrMetallicRoughness", look},
                     {"doubleSided", true},
                     {"extensions", {{"KHR_materials_unlit", json::object()}}}};
    material["pbrMetallicRoughness"]["metallicFactor"] = 0;
    return {
        {"asset", {{"version", "2.0"}, {"generator", "rgbd-graphslam"}}},
        {"extensionsUsed", {"KHR_materials_unlit"}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}, {"name", "map"}}}},
        {"meshes",
         {{{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}}},
        {"materials", {material}}};
}

std::string chunk(const char* type, std::string content, char filler) {
    content.resize((content.size() + 3) / 4 * 4, filler);
    ByteWriter out;
    out.putCount(content.size());
    out.putBytes({type, 4});
    out.putBytes(content);
    return out.take();
}

void writeFile(const std::string& path, json gltf, const GltfBuffer& buffer) {
    constexpr std::uint32_t magic = 0x46546C67, version = 2, header_bytes = 12;
    buffer.describe(gltf);
    const std::string text = chunk("JSON", gltf.dump(), ' ');
    const std::string binary = chunk("BIN\0", buffer.bytes(), '\0');
    const std::size_t size = header_bytes + text.size() + binary.size();
    if (size > UINT32_MAX) {
        throw Error("'" + path + "' would be larger than the 4 GB that glTF allows",
                    "make a coarser mesh: rgbd-map OUT --mesh 0.04");
    }
    ByteWriter head;
    head.put(magic);
    head.put(version);
    head.putCount(size);
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << head.bytes() << text << binary;
        out.close();
        return out.good();
    });
}

std::string jpegOf(const cv::Mat3b& image) {
    constexpr int quality = 92;
    std::vector<std::uint8_t> bytes;
    if (!cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality}))
        throw Error("cannot compress the texture", "give a smaller --texture-size");
    return {bytes.begin(), bytes.end()};
}

class GlbExporter : public Exporter {
  public:
    const char* name() const override { return "glb"; }
    const char* about() const override { return "textured mesh in one file (glTF 2.0)"; }
    const char* fileName() const override { return "mesh.glb"; }

    std::string write(const std::string& run_folder, const ExportOptions& options,
                      const std::string& path) const override {
        if (options.vertex_colors) {
            const PlyModel mesh = readRunMesh(run_folder);
            writeGlb(path, mesh);
            return std::to_string(mesh.triangles.size()) + " triangles with vertex colors";
        }
        const RunTexture textured = textureOf(run_folder, options);
        writeGlb(path, textured.mesh);
        return describe(textured);
    }
};

}  // namespace

void writeGlb(const std::string& path, const TexturedMesh& mesh) {
    GltfBuffer buffer;
    const json attributes = {{"POSITION", addPositions(mesh.vertices, buffer)},
                             {"TEXCOORD_0", addUv(mesh.uv, buffer)}};
    json gltf = sceneOf(attributes, addIndices(mesh.triangles, buffer),
                        {{"baseColorTexture", {{"index", 0}}}});
    gltf["images"] = {
        {{"bufferView", buffer.addView(jpegOf(mesh.texture))}, {"mimeType", "image/jpeg"}}};
    gltf["samplers"] = {{{"magFilter", linear},
                         {"minFilter", linear_mipmap_linear},
                         {"wrapS", clamp_to_edge},
                         {"wrapT", clamp_to_edge}}};
    gltf["textures"] = {{{"source", 0}, {"sampler", 0}}};
    writeFile(path, gltf, buffer);
}

void writeGlb(const std::string& path, const PlyModel& mesh) {
    GltfBuffer buffer;
    const json attributes = {{"POSITION", addPositions(mesh.vertices, buffer)},
                             {"COLOR_0", addColors(mesh.colors, buffer)}};
    writeFile(path, sceneOf(attributes, addIndices(mesh.triangles, buffer), json::object()),
              buffer);
}

std::unique_ptr<const Exporter> glbExporter() {
    return std::make_unique<GlbExporter>();
}

}  // namespace rgbd_graphslam
