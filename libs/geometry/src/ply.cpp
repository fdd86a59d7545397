#include "rgbd_graphslam/geometry/ply.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "rgbd_graphslam/core/atomic_file.h"
#include "rgbd_graphslam/core/error.h"
#include "rgbd_graphslam/core/input_file.h"

namespace rgbd_graphslam {
namespace {

enum class Type { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

struct Property {
    std::string name;
    Type type;
    bool is_list = false;
    Type count_type = Type::Uint8;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    bool binary = false;
    std::vector<Element> elements;
};

template <class T>
double binaryNumber(std::istream& in) {
    char bytes[sizeof(T)] = {};
    in.read(bytes, sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

double binaryNumber(std::istream& in, Type type) {
    switch (type) {
        case Type::Int8:
            return binaryNumber<std::int8_t>(in);
        case Type::Uint8:
            return binaryNumber<std::uint8_t>(in);
        case Type::Int16:
            return binaryNumber<std::int16_t>(in);
        case Type::Uint16:
            return binaryNumber<std::uint16_t>(in);
        case Type::Int32:
            return binaryNumber<std::int32_t>(in);
        case Type::Uint32:
            return binaryNumber<std::uint32_t>(in);
        case Type::Float:
            return binaryNumber<float>(in);
        case Type::Double:
            break;
    }
    return binaryNumber<double>(in);
}

/** One pass over a file. */
class PlyReader {
  public:
    explicit PlyReader(const std::string& path) : path_(path), in_(path, std::ios::binary) {
        refuseFolder(path, "a PLY file");
        if (!in_) throw Error("cannot read '" + path + "'", "check the name");
    }

    PlyModel read() {
        header_ = readHeader();
        for (const auto& element : header_.elements) readElement(element);
        if (model_.vertices.empty()) refuse("holds no vertex");
        checkTriangles();
        if (model_.normals.size() != model_.vertices.size()) model_.normals.clear();
        return std::move(model_);
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw Error("'" + path_ + "' " + why, "give an ASCII or little-endian PLY file");
    }

    Header readHeader() {
        Header header;
        std::string line;
        std::getline(in_, line);
        if (line.rfind("ply", 0) != 0) refuse("is not a PLY file");
        while (std::getline(in_, line)) {
            std::istringstream words(line);
            std::string key;
            words >> key;
            if (key == "end_header") return header;
            if (key == "format") header.binary = isBinary(words);
            if (key == "element") header.elements.push_back(elementOf(words));
            if (key == "property") addProperty(words, header);
        }
        refuse("is cut off in its header");
    }

    bool isBinary(std::istream& words) const {
        std::string format;
        words >> format;
        if (format != "ascii" && format != "binary_little_endian") {
            refuse("is of format '" + format + "'");
        }
        return format != "ascii";
    }

    Element elementOf(std::istream& words) const {
        Element element;
        if (!(words >> element.name >> element.count)) refuse("has a damaged header");
        return element;
    }

    void addProperty(std::istream& words, Header& header) const {
        Property property;
        std::string type;
        words >> type;
        if (type == "list") {
            property.is_list = true;
            words >> type;
            property.count_type = typeOf(type);
            words >> type;
        }
        property.type = typeOf(type);
        words >> property.name;
        if (!words || header.elements.empty()) refuse("has a damaged header");
        header.elements.back().properties.push_back(property);
    }

    Type typeOf(const std::string& name) const {
        static const std::map<std::string, Type> types = {
            {"char", Type::Int8},     {"int8", Type::Int8},     {"uchar", Type::Uint8},
            {"uint8", Type::Uint8},   {"short", Type::Int16},   {"int16", Type::Int16},
            {"ushort", Type::Uint16}, {"uint16", Type::Uint16}, {"int", Type::Int32},
            {"int32", Type::Int32},   {"uint", Type::Uint32},   {"uint32", Type::Uint32},
            {"float", Type::Float},   {"float32", Type::Float}, {"double", Type::Double},
            {"float64", Type::Double}};
        const auto found = types.find(name);
        if (found == types.end()) refuse("has a property of unknown type '" + name + "'");
        return found->second;
    }

    double number(Type type) {
        double value = 0;
        if (header_.binary) {
            value = binaryNumber(in_, type);
        } else {
            in_ >> value;
        }
        if (!in_) refuse("is cut off or damaged");
        return value;
    }

    void readElement(const Element& element) {
        const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
        if (is_vertex && header_.binary && isPacked(element)) return readPacked(element.count);
        for (std::uint64_t k = 0; k < element.count; ++k) {
            if (is_vertex) {
                readVertex(element);
            } else {
                for (const auto& property : element.properties) readProperty(property, is_face);
            }
        }
    }

    /** Whether vertices are colored points and nothing else, as most maps are. */
    static bool isPacked(const Element& element) {
        static const std::vector<std::pair<std::string, Type>> packed = {
            {"x", Type::Float},   {"y", Type::Float},     {"z", Type::Float},
            {"red", Type::Uint8}, {"green", Type::Uint8}, {"blue", Type::Uint8}};
        const auto same = [](const Property& property, const auto& expected) {
            return !property.is_list && property.name == expected.first &&
                   property.type == expected.second;
        };
        return std::equal(element.properties.begin(), element.properties.end(), packed.begin(),
                          packed.end(), same);
    }

    /** Millions of points in a fraction of the time that looking at each number takes. */
    void readPacked(std::uint64_t count) {
        constexpr std::size_t place_bytes = 12, record_bytes = 15, records_a_block = 4096;
        std::vector<char> block(records_a_block * record_bytes);
        while (count > 0) {
            const auto records = std::min<std::uint64_t>(count, records_a_block);
            if (!in_.read(block.data(), static_cast<std::streamsize>(records * record_bytes))) {
                refuse("is cut off or damaged");
            }
            for (std::size_t k = 0; k < records; ++k) {
                const char* record = block.data() + k * record_bytes;
                Eigen::Vector3f place;
                std::memcpy(place.data(), record, place_bytes);
                if (!place.allFinite()) refuse("has a vertex that is nowhere");
                model_.vertices.push_back(place);
                model_.colors.emplace_back();
                std::memcpy(model_.colors.back().data(), record + place_bytes, 3);
            }
            count -= records;
        }
    }

    void readVertex(const Element& element) {
        Eigen::Vector3f place = Eigen::Vector3f::Constant(NAN), normal = place;
        std::array<std::uint8_t, 3> color{};
        bool colored = false;
        for (const auto& property : element.properties) {
            if (property.is_list) {
                readProperty(property, false);
                continue;
            }
            const double value = number(property.type);
            const int axis = axisOf(property.name), normal_axis = normalAxisOf(property.name);
            if (axis >= 0) place[axis] = static_cast<float>(value);
            if (normal_axis >= 0) normal[normal_axis] = static_cast<float>(value);
            const int channel = channelOf(property.name);
            if (channel >= 0) color[channel] = static_cast<std::uint8_t>(value);
            colored |= channel >= 0;
        }
        if (!place.allFinite()) refuse("has a vertex that is nowhere");
        model_.vertices.push_back(place);
        if (normal.allFinite()) model_.normals.push_back(normal);
        if (colored) model_.colors.push_back(color);
    }

    static int axisOf(const std::string& name) {
        return name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : -1;
    }
    static int normalAxisOf(const std::string& name) {
        return name == "nx" ? 0 : name == "ny" ? 1 : name == "nz" ? 2 : -1;
    }
    static int channelOf(const std::string& name) {
        return name == "red" ? 0 : name == "green" ? 1 : name == "blue" ? 2 : -1;
    }

    void readProperty(const Property& property, bool of_face) {
        const double count = property.is_list ? number(property.count_type) : 1;
        std::vector<double> values;
        for (double k = 0; k < count; ++k) values.push_back(number(property.type));
        const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
        if (of_face && corners) addFan(values);
    }

    void addFan(const std::vector<double>& corners) {
        for (const double corner : corners) {
            if (corner < 0) refuse("has a face without vertex");
        }
        const auto index = [&](std::size_t k) { return static_cast<std::uint32_t>(corners[k]); };
        for (std::size_t k = 2; k < corners.size(); ++k) {
            model_.triangles.push_back({index(0), index(k - 1), index(k)});
        }
    }

    void checkTriangles() const {
        for (const auto& triangle : model_.triangles) {
            for (const auto corner : triangle) {
                if (corner >= model_.vertices.size()) refuse("has a face without vertex");
            }
        }
    }

    std::string path_;
    std::ifstream in_;
    Header header_;
    PlyModel model_;
};

std::string headerOf(const PlyModel& model) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(model.vertices.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!model.normals.empty()) {
        text += "property float nx\nproperty float ny\nproperty float nz\n";
    }
    if (!model.colors.empty()) {
        text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    if (!model.triangles.empty()) {
        text += "element face " + std::to_string(model.triangles.size()) +
                "\nproperty list uchar int vertex_indices\n";
    }
    return text + "end_header\n";
}

template <class T>
void writeBytes(std::ostream& out, const T& value) {
    out.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

bool writeModel(std::ostream& out, const PlyModel& model) {
    out << headerOf(model);
    for (std::size_t k = 0; k < model.vertices.size(); ++k) {
        writeBytes(out, model.vertices[k]);
        if (!model.normals.empty()) writeBytes(out, model.normals[k]);
        if (!model.colors.empty()) writeBytes(out, model.colors[k]);
    }
    for (const auto& triangle : model.triangles) {
        out.put(3);
        writeBytes(out, triangle);
    }
    return out.good();
}

}  // namespace

PlyModel readPly(const std::string& path) {
    return PlyReader(path).read();
}

void writePly(const std::string& path, const PlyModel& model) {
    writeAtomically(path, [&](const std::string& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        const bool written = writeModel(out, model);
        out.close();
        return written && out.good();
    });
}

}  // namespace rgbd_graphslam
