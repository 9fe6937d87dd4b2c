#include "slam/detect/onnx_inputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "io/input_error.h"
#include "tests/support/onnx_writer.h"

namespace slam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<std::string> NamesOfInputs(const std::string& model) {
  std::vector<std::string> names;
  for (const OnnxInput& input : ReadOnnxInputs(model)) names.emplace_back(input.name);
  return names;
}

/// A model of one image.
std::string ModelOfAnImage() {
  onnx::Graph graph;
  graph.inputs = {onnx::Value("images", {1, 3, 64, 96})};
  return onnx::Model(graph);
}

auto IsRefused(const std::string& why) { return ThrowsMessage<io::InputError>(HasSubstr(why)); }

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

// Older exporters list the weights among the inputs.
TEST(OnnxInputs, AreNoneOfTheWeights) {
  onnx::Graph graph;
  graph.initializers = {onnx::Tensor<float>("weights", {1}, {0.5f})};
  graph.inputs = {onnx::Value("images", {1, 3, 64, 96}), onnx::Value("weights", {1})};
  EXPECT_THAT(NamesOfInputs(onnx::Model(graph)), ElementsAre("images"));
}

// A tensor may hold its numbers one by one, of four and of eight bytes, and its name after them.
TEST(OnnxInputs, AreToldFromWeightsWhoseNumbersComeOneByOne) {
  const std::string weights =
      onnx::Message().Number(1, 2).text() +
      std::string("\x25\x00\x00\x80\x3f", 5) +                  // float_data = 4
      std::string("\x51\x00\x00\x00\x00\x00\x00\xf0\x3f", 9) +  // double_data
      onnx::Message().Bytes(8, "weights").text();
  const onnx::Message graph = onnx::Message()
                                  .Bytes(5, weights)
                                  .Part(11, onnx::Value("images", {1, 3, 64, 96}))
                                  .Part(11, onnx::Value("weights", {2}));
  EXPECT_THAT(NamesOfInputs(onnx::Message().Part(7, graph).text()), ElementsAre("images"));
}

// What a later version of the format adds is no side of the image.
TEST(OnnxInputs, PassOverFieldsThatAreNotKnown) {
  const onnx::Message sides =
      onnx::Message().Part(1, onnx::Message().Number(1, 64)).Number(15, 3).Bytes(16, "new");
  const onnx::Message tensor = onnx::Message().Number(1, 1).Part(2, sides);
  onnx::Graph graph;
  graph.inputs = {onnx::Message().Bytes(1, "images").Part(2, onnx::Message().Part(1, tensor))};
  const auto inputs = ReadOnnxInputs(onnx::Model(graph));
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(inputs[0].shape, std::vector<int>{64});
}

TEST(OnnxInputs, AreRefusedOfDamagedBytes) {
  const std::string model = ModelOfAnImage();
  ASSERT_THAT(NamesOfInputs(model), ElementsAre("images"));
  const std::string of_no_kind = "\x0f", of_no_number("\0\x01", 2);
  const std::string endless = "\x08" + std::string(10, '\xff');  // an eleventh byte follows
  for (const std::string& damaged : {of_no_kind + model, of_no_number + model, endless + model,
                                     model.substr(0, model.size() - 1)}) {
    EXPECT_THAT([&] { ReadOnnxInputs(damaged); }, IsRefused("not an ONNX model, or cut off"))
        << ::testing::PrintToString(damaged);
  }
}

TEST(OnnxInputs, AreRefusedOfAModelWithoutAGraph) {
  EXPECT_THAT([] { ReadOnnxInputs(onnx::Message().Number(1, 6).text()); },
              IsRefused("it has no graph"));
}

}  // namespace
}  // namespace slam
