/** An ONNX model of one layer, written byte by byte. */
#pragma once
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace rgbd_graphslam {

/** Fields of protocol buffers: https://protobuf.dev/programming-guides/encoding. */
class ProtoMessage {
  public:
    ProtoMessage& number(int field, std::uint64_t value) {
        varint(static_cast<std::uint64_t>(field) << 3);
        varint(value);
        return *this;
    }
    ProtoMessage& bytes(int field, const std::string& value) {
        varint(static_cast<std::uint64_t>(field) << 3 | 2);
        varint(value.size());
        text_ += value;
        return *this;
    }
    ProtoMessage& message(int field, const ProtoMessage& value) {
        return bytes(field, value.text_);
    }
    const std::string& text() const { return text_; }

  private:
    void varint(std::uint64_t value) {
        for (; value >= 128; value >>= 7) text_ += static_cast<char>((value & 127) | 128);
        text_ += static_cast<char>(value);
    }
    std::string text_;
};

inline ProtoMessage onnxTensor(const std::string& name, const std::vector<int>& dims,
                               const std::vector<float>& values) {
    ProtoMessage tensor;
    for (const int dim : dims) tensor.number(1, static_cast<std::uint64_t>(dim));
    tensor.number(2, 1).bytes(8, name);
    return tensor.bytes(9, std::string(reinterpret_cast<const char*>(values.data()),
                                       values.size() * sizeof(float)));
}

inline ProtoMessage onnxImage(const std::string& name, int channels, int height, int width) {
    ProtoMessage shape, tensor, type, value;
    for (const int dim : {1, channels, height, width}) {
        shape.message(1, ProtoMessage().number(1, static_cast<std::uint64_t>(dim)));
    }
    tensor.number(1, 1).message(2, shape);
    return value.bytes(1, name).message(2, type.message(1, tensor));
}

/** Writes a model that scores each pixel by itself: a convolution of one pixel.
 *  \param weights of red, green and blue for each class, and \param biases */
inline void writeSmallOnnx(const std::string& path, int width, int height,
                           const std::vector<float>& weights, const std::vector<float>& biases) {
    const int classes = static_cast<int>(biases.size());
    ProtoMessage kernel, node, graph, opset, model;
    kernel.bytes(1, "kernel_shape").number(8, 1).number(8, 1).number(20, 7);
    node.bytes(1, "image")
        .bytes(1, "w")
        .bytes(1, "b")
        .bytes(2, "scores")
        .bytes(4, "Conv")
        .message(5, kernel);
    graph.message(1, node).bytes(2, "colors");
    graph.message(5, onnxTensor("w", {classes, 3, 1, 1}, weights));
    graph.message(5, onnxTensor("b", {classes}, biases));
    graph.message(11, onnxImage("image", 3, height, width));
    graph.message(12, onnxImage("scores", classes, height, width));
    opset.bytes(1, "").number(2, 11);
    model.number(1, 7).message(7, graph).message(8, opset);
    std::ofstream(path, std::ios::binary) << model.text();
}

}  // namespace rgbd_graphslam
