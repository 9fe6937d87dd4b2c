#include "slam/detect/onnx_inputs.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/onnx_writer.h"

namespace slam {
namespace {

// An open side may be written as -1, a number of ten bytes in protocol buffers.
TEST(OnnxInputs, OfNegativeSidesAreLeftOpen) {
  onnx::Message sides;
  for (const std::int64_t side : {std::int64_t{-1}, std::int64_t{3},
                                  std::numeric_limits<std::int64_t>::min(), std::int64_t{416}})
    sides.Part(1, onnx::Message().Number(1, static_cast<std::uint64_t>(side)));
  const onnx::Message tensor = onnx::Message().Number(1, 1).Part(2, sides);
  onnx::Graph graph;
  graph.inputs = {onnx::Message().Bytes(1, "images").Part(2, onnx::Message().Part(1, tensor))};
  const auto inputs = ReadOnnxInputs(onnx::Model(graph));
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].name, "images");
  EXPECT_EQ(inputs[0].shape, (std::vector<int>{0, 3, 0, 416}));
}

}  // namespace
}  // namespace slam
