#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slam {

/// An input of an ONNX model as its file states it.
struct OnnxInput {
  std::string name;
  std::vector<int> shape;  ///< 0: left open
};

/// The inputs of a model, initializers (which older files list as inputs too) left out. Reads
/// no more of the file's protocol buffers than that takes; OpenCV reads the rest and does not
/// tell what shape the file states.
///
/// @param bytes  the whole file
/// @throws InputError, without a file's name, when the bytes are no ONNX model or cut off.
/// Source: onnx.proto3, field numbers in the code.
std::vector<OnnxInput> ReadOnnxInputs(std::string_view bytes);

}  // namespace slam
