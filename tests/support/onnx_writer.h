#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

// Writes small ONNX models: protocol buffers by hand, for the few messages that a graph needs
// (onnx.proto3, field numbers beside them).
namespace onnx {

/// A message of protocol buffers under construction.
class Message {
 public:
  Message& Number(int field, std::uint64_t value) {
    Varint(static_cast<std::uint64_t>(field) << 3);
    Varint(value);
    return *this;
  }
  Message& Bytes(int field, const std::string& bytes) {
    Varint(static_cast<std::uint64_t>(field) << 3 | 2);
    Varint(bytes.size());
    text_ += bytes;
    return *this;
  }
  Message& Part(int field, const Message& part) { return Bytes(field, part.text_); }
  const std::string& text() const { return text_; }

 private:
  void Varint(std::uint64_t value) {
    for (; value >= 128; value >>= 7) text_ += static_cast<char>(value | 128);
    text_ += static_cast<char>(value);
  }
  std::string text_;
};

/// AttributeProto of type INTS.
inline Message Integers(const std::string& name, const std::vector<std::int64_t>& values) {
  Message attribute;
  attribute.Bytes(1, name);
  for (const std::int64_t value : values)
    attribute.Number(8, static_cast<std::uint64_t>(value));
  return attribute.Number(20, 7);
}

/// AttributeProto of type INT.
inline Message Integer(const std::string& name, std::int64_t value) {
  return Message().Bytes(1, name).Number(3, static_cast<std::uint64_t>(value)).Number(20, 2);
}

inline Message Node(const std::string& type, const std::vector<std::string>& inputs,
                    const std::string& output, const std::vector<Message>& attributes) {
  Message node;
  for (const std::string& input : inputs) node.Bytes(1, input);
  node.Bytes(2, output).Bytes(3, output).Bytes(4, type);
  for (const Message& attribute : attributes) node.Part(5, attribute);
  return node;
}

/// TensorProto with raw data; T is float or std::int64_t.
template <typename T>
Message Tensor(const std::string& name, const std::vector<std::int64_t>& shape,
               const std::vector<T>& values) {
  Message tensor;
  for (const std::int64_t side : shape) tensor.Number(1, static_cast<std::uint64_t>(side));
  tensor.Number(2, sizeof(T) == sizeof(float) ? 1 : 7).Bytes(8, name);
  std::string raw(values.size() * sizeof(T), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return tensor.Bytes(9, raw);
}

/// ValueInfoProto of floats; a side of 0 is left open, under a name.
inline Message Value(const std::string& name, const std::vector<std::int64_t>& shape) {
  Message sides;
  for (const std::int64_t side : shape) {
    sides.Part(1, side > 0 ? Message().Number(1, static_cast<std::uint64_t>(side))
                           : Message().Bytes(2, "open"));
  }
  const Message tensor = Message().Number(1, 1).Part(2, sides);
  return Message().Bytes(1, name).Part(2, Message().Part(1, tensor));
}

struct Graph {
  std::vector<Message> nodes, initializers, inputs, outputs;
};

/// ModelProto with operator set 11, that of YOLOX's export.
inline std::string Model(const Graph& graph) {
  Message body;
  for (const Message& node : graph.nodes) body.Part(1, node);
  body.Bytes(2, "graph");
  for (const Message& tensor : graph.initializers) body.Part(5, tensor);
  for (const Message& input : graph.inputs) body.Part(11, input);
  for (const Message& output : graph.outputs) body.Part(12, output);
  return Message()
      .Number(1, 6)
      .Part(7, body)
      .Part(8, Message().Bytes(1, "").Number(2, 11))
      .text();
}

}  // namespace onnx
