#include "slam/detect/onnx_inputs.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>

#include "io/input_error.h"

namespace slam {
namespace {

/// A field of a message of protocol buffers: a number, or bytes (text, or a message inside).
struct Field {
  int number = 0;
  std::uint64_t value = 0;
  std::string_view bytes;
};

/// Goes through the fields of one message.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  /// @returns false at the end. @throws InputError for what is no message.
  bool Next(Field& field) {
    if (rest_.empty()) return false;
    const std::uint64_t key = Varint();
    field = {};
    field.number = static_cast<int>(key >> 3 & 0x1fffffff);
    if (field.number == 0) Fail();
    switch (key & 7) {
      case 0:
        field.value = Varint();
        break;
      case 1:
        field.bytes = Take(8);
        break;
      case 2:
        field.bytes = Take(Varint());
        break;
      case 5:
        field.bytes = Take(4);
        break;
      default:
        Fail();
    }
    return true;
  }

 private:
  [[noreturn]] static void Fail() { throw io::InputError("not an ONNX model, or cut off"); }
  std::string_view Take(std::uint64_t count) {
    if (count > rest_.size()) Fail();
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(count));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::uint64_t Varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(Take(1).front());
      value |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) return value;
    }
    Fail();
  }
  std::string_view rest_;
};

/// The first field of that number; an empty one if there is none.
Field Find(std::string_view message, int number) {
  Fields fields(message);
  for (Field field; fields.Next(field);) {
    if (field.number == number) return field;
  }
  return {};
}

/// A side of a TensorShapeProto: dim_value = 1; open when it has a name (dim_param = 2)
/// instead.
int Side(std::string_view dimension) {
  const std::uint64_t value = Find(dimension, 1).value;
  constexpr std::uint64_t kMaxSide = std::numeric_limits<int>::max();
  return value <= kMaxSide ? static_cast<int>(value) : 0;
}

/// A ValueInfoProto: name = 1, type = 2 { tensor_type = 1 { shape = 2 { dim = 1 } } }.
OnnxInput ReadInput(std::string_view value_info) {
  OnnxInput input;
  input.name = Find(value_info, 1).bytes;
  const std::string_view tensor = Find(Find(value_info, 2).bytes, 1).bytes;
  Fields sides(Find(tensor, 2).bytes);
  for (Field side; sides.Next(side);) {
    if (side.number == 1) input.shape.push_back(Side(side.bytes));
  }
  return input;
}

}  // namespace

std::vector<OnnxInput> ReadOnnxInputs(std::string_view bytes) {
  // Field numbers of onnx.proto3.
  constexpr int kGraph = 7, kInitializer = 5, kTensorName = 8, kGraphInput = 11;
  std::string_view graph;
  Fields model(bytes);
  for (Field field; model.Next(field);) {
    if (field.number == kGraph) graph = field.bytes;
  }
  if (graph.empty()) throw io::InputError("not an ONNX model: it has no graph");
  // Older files list the initializers among the inputs.
  std::vector<OnnxInput> inputs;
  std::set<std::string_view> initializers;
  Fields parts(graph);
  for (Field field; parts.Next(field);) {
    if (field.number == kInitializer) initializers.insert(Find(field.bytes, kTensorName).bytes);
    if (field.number == kGraphInput) inputs.push_back(ReadInput(field.bytes));
  }
  std::erase_if(inputs,
                [&](const OnnxInput& input) { return initializers.contains(input.name); });
  return inputs;
}

}  // namespace slam
