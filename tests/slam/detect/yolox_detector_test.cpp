#include "slam/detect/yolox_detector.h"

#include <gmock/gmock.h>
#include <cmath>
#include <fstream>

#include "io/input_error.h"
#include "tests/support/onnx_writer.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int kBook = 73, kCup = 41;  // COCO's columns

/// A model with the form of YOLOX and an answer by hand. Each cell's objectness is the mean
/// blue of its block of the input and its class probabilities are mean green (book) and mean
/// red (cup), all over 255; x = y = 0.5 and w = h = ln 2: a box twice as large as the cell.
struct BlockNetwork {
  std::vector<std::int64_t> input = {1, 3, 64, 96};
  int classes = 80;
  std::vector<int> strides = {8, 16, 32};
  double gain = 1.0;  ///< 1: means in [0, 1]

  std::string Model() const {
    onnx::Graph graph;
    graph.inputs = {onnx::Value("images", input)};
    std::vector<std::string> grids;
    for (const int stride : strides) grids.push_back(AddGrid(graph, stride));
    graph.nodes.push_back(onnx::Node("Concat", grids, "cells", {onnx::Integer("axis", 2)}));
    graph.nodes.push_back(
        onnx::Node("Transpose", {"cells"}, "output", {onnx::Integers("perm", {0, 2, 1})}));
    graph.outputs = {onnx::Value("output", {1, 0, 5 + classes})};
    return onnx::Model(graph);
  }

 private:
  /// Convolution over blocks, then a column a cell. @returns the name of its output.
  std::string AddGrid(onnx::Graph& graph, int stride) const {
    const int channels = 5 + classes, depth = static_cast<int>(input[1]);
    const auto block = static_cast<std::size_t>(stride * stride);
    std::vector<float> weights(static_cast<std::size_t>(channels * depth) * block, 0.0f);
    const auto mean = [&](int row, int colour) {
      if (row >= channels || colour >= depth) return;
      const auto start = static_cast<std::size_t>(row * depth + colour) * block;
      for (std::size_t k = 0; k < block; ++k)
        weights[start + k] = static_cast<float>(gain / 255.0 / static_cast<double>(block));
    };
    mean(4, 0), mean(5 + kBook, 1), mean(5 + kCup, 2);
    std::vector<float> bias(static_cast<std::size_t>(channels), 0.0f);
    bias[0] = bias[1] = 0.5f;
    bias[2] = bias[3] = std::log(2.0f);
    const std::string s = std::to_string(stride);
    graph.initializers.push_back(
        onnx::Tensor("w" + s, {channels, depth, stride, stride}, weights));
    graph.initializers.push_back(onnx::Tensor("b" + s, {channels}, bias));
    graph.initializers.push_back(
        onnx::Tensor<std::int64_t>("shape" + s, {3}, {1, channels, -1}));
    graph.nodes.push_back(onnx::Node(
        "Conv", {"images", "w" + s, "b" + s}, "conv" + s,
        {onnx::Integers("kernel_shape", {stride, stride}),
         onnx::Integers("strides", {stride, stride}), onnx::Integers("pads", {0, 0, 0, 0})}));
    graph.nodes.push_back(onnx::Node("Reshape", {"conv" + s, "shape" + s}, "grid" + s, {}));
    return "grid" + s;
  }
};

/// A file of this test alone, and a camera of 192 x 96 pixels: half as large in the network's
/// input of 96 x 64, with 16 rows of padding.
class YoloxModel : public ::testing::Test {
 protected:
  void SetUp() override { camera_.width = 192, camera_.height = 96; }

  void Write(const std::string& model) { std::ofstream(file_, std::ios::binary) << model; }
  std::unique_ptr<Detector> Load(const YoloxConfig& config = {}) {
    return MakeDetector("yolox:" + file_.string(), "", camera_, CocoClassTable(), config);
  }
  auto FailsWith(const std::string& what) {
    return ThrowsMessage<io::InputError>(AllOf(HasSubstr(file_.string()), HasSubstr(what)));
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path file_ = temporary_ / "model.onnx";
  Camera camera_;
};

TEST_F(YoloxModel, FindsWhatIsPaintedWhereItIsPainted) {
  Write(BlockNetwork().Model());
  const auto detector = Load();
  // Nothing in the grey of the padding: 0.2 at most, as objectness and class are 114 / 255.
  cv::Mat3b bgr(96, 192, cv::Vec3b(0, 0, 0));
  EXPECT_TRUE(detector->Detect(0, bgr).empty());

  // Input pixels 24 to 31 by 16 to 23: cell (3, 2) of stride 8, which is a quarter of cell
  // (1, 1) of stride 16: objectness and class a quarter there, a score of a sixteenth.
  bgr(cv::Rect(48, 32, 16, 16)).setTo(cv::Vec3b(255, 204, 0));
  const auto books = detector->Detect(0, bgr);
  ASSERT_EQ(books.size(), 1u);
  EXPECT_EQ(books[0].class_name, "book");
  EXPECT_EQ(books[0].kind, ClassKind::kRegular);
  constexpr double kFloat = 1e-4;  // sums of 64 floats
  EXPECT_NEAR(books[0].score, 0.8, kFloat);
  // Centre (28, 20) of the input and 16 wide: 20 to 36 by 12 to 28, doubled, half a pixel off.
  EXPECT_NEAR(books[0].box_px.min.x(), 39.5, kFloat);
  EXPECT_NEAR(books[0].box_px.max.x(), 71.5, kFloat);
  EXPECT_NEAR(books[0].box_px.min.y(), 23.5, kFloat);
  EXPECT_NEAR(books[0].box_px.max.y(), 55.5, kFloat);
}

TEST_F(YoloxModel, TakesChannelsInTheOrderBlueGreenRed) {
  Write(BlockNetwork().Model());
  cv::Mat3b bgr(96, 192, cv::Vec3b(0, 0, 0));
  bgr(cv::Rect(48, 32, 16, 16)).setTo(cv::Vec3b(255, 0, 255));
  const auto found = Load()->Detect(0, bgr);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].class_name, "cup");
}

TEST_F(YoloxModel, FindsLargeThingsOnTheCoarseGridAndClipsThemToTheImage) {
  Write(BlockNetwork().Model());
  YoloxConfig config;
  config.max_nms_iou = 0.2;
  cv::Mat3b bgr(96, 192, cv::Vec3b(0, 0, 0));
  bgr(cv::Rect(0, 0, 64, 64)).setTo(cv::Vec3b(255, 255, 0));
  // Cell (0, 0) of stride 32 is full, and so are those of the finer grids inside; boxes of 64
  // by 64 about (16, 16), clipped. All score 1: the finer ones come first.
  const auto found = Load(config)->Detect(0, bgr);
  const auto large = std::find_if(found.begin(), found.end(), [](const Detection& d) {
    return std::abs(d.box_px.max.x() - 95.5) < 1e-3 && d.box_px.min.x() == 0;
  });
  ASSERT_NE(large, found.end());
  EXPECT_EQ(large->box_px.min, Eigen::Vector2d(0, 0));
  EXPECT_EQ(large->box_px.max.y(), 95);  // 95.5 lies outside
  EXPECT_EQ(Load(config)->Detect(0, bgr).size(), found.size());
}

TEST_F(YoloxModel, BelievesWhatTheConfigurationSays) {
  Write(BlockNetwork().Model());
  cv::Mat3b bgr(96, 192, cv::Vec3b(0, 0, 0));
  bgr(cv::Rect(48, 32, 16, 16)).setTo(cv::Vec3b(255, 204, 0));
  YoloxConfig strict;
  strict.min_score = 0.81;
  EXPECT_TRUE(Load(strict)->Detect(0, bgr).empty());
  YoloxConfig lax;
  lax.min_score = 0.04;
  const auto found = Load(lax)->Detect(0, bgr);  // boxes about the grey padding as well
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const Detection& d) {
    return std::abs(d.score - 0.05) < 1e-4 && d.class_name == "book";  // stride 16: a sixteenth
  }));
}

// Halved, the image fills the network's input: 96 + 24 + 6 cells.
TEST_F(YoloxModel, FindsNoMoreThanTheHundredBest) {
  Write(BlockNetwork().Model());
  camera_.height = 128;
  YoloxConfig config;
  config.max_nms_iou = 1.0;
  cv::Mat3b bgr(128, 192, cv::Vec3b(255, 204, 0));
  // In the last rows of each grid: four cells of stride 8 and one of stride 16.
  bgr(cv::Rect(160, 96, 32, 32)).setTo(cv::Vec3b(255, 255, 0));
  const auto found = Load(config)->Detect(0, bgr);
  ASSERT_EQ(found.size(), 100u);
  constexpr double kFloat = 1e-4;  // sums of 1024 floats
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(found[i].score, 1.0, kFloat);
  EXPECT_NEAR(found.back().score, 0.8, kFloat);
}

TEST_F(YoloxModel, FindsNothingThatLiesInThePaddingAlone) {
  Write(BlockNetwork().Model());
  YoloxConfig config;
  config.min_score = 0.15;  // the grey of the padding scores 0.2
  config.max_nms_iou = 1.0;
  const auto found = Load(config)->Detect(0, cv::Mat3b(96, 192, cv::Vec3b(0, 0, 0)));
  // The padding is rows 6 and 7 of stride 8 and row 3 of stride 16. Boxes are twice as high as
  // their cells: those of row 7 begin at 52 of the input, four below the image.
  EXPECT_EQ(found.size(), 12u + 6u);
  for (const Detection& d : found) EXPECT_GT(d.box_px.area(), 0);
}

TEST_F(YoloxModel, AsksForTheInputSizeThatAModelLeavesOpen) {
  BlockNetwork open;
  open.input = {1, 3, 0, 0};
  Write(open.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("set yolox: input_width and input_height"));
  YoloxConfig config;
  config.input_width = 96;
  EXPECT_THAT([&] { Load(config); }, FailsWith("set yolox: input_width and input_height"));
  config.input_width = 0, config.input_height = 64;
  EXPECT_THAT([&] { Load(config); }, FailsWith("set yolox: input_width and input_height"));
  config.input_width = 96;
  cv::Mat3b bgr(96, 192, cv::Vec3b(0, 0, 0));
  bgr(cv::Rect(48, 32, 16, 16)).setTo(cv::Vec3b(255, 204, 0));
  EXPECT_EQ(Load(config)->Detect(0, bgr).size(), 1u);
}

TEST_F(YoloxModel, LeavesTheBatchOpenAsExportedWithDynamic) {
  BlockNetwork open;
  open.input = {0, 3, 64, 96};
  Write(open.Model());
  cv::Mat3b bgr(96, 192, cv::Vec3b(0, 0, 0));
  bgr(cv::Rect(48, 32, 16, 16)).setTo(cv::Vec3b(255, 204, 0));
  EXPECT_EQ(Load()->Detect(0, bgr).size(), 1u);
}

TEST_F(YoloxModel, RefusesAnInputOfAnotherShape) {
  BlockNetwork odd;
  odd.input = {1, 3, 60, 96};
  Write(odd.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("input is 1 x 3 x 60 x 96; expected 1 x 3 x height"));
  odd.input = {1, 1, 64, 96};
  Write(odd.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("input is 1 x 1 x 64 x 96; expected"));
  odd.input = {2, 3, 64, 96};  // a batch of two images
  Write(odd.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("input is 2 x 3 x 64 x 96; expected"));
  onnx::Graph scalar;
  scalar.inputs = {onnx::Value("images", {})};
  Write(onnx::Model(scalar));
  EXPECT_THAT([&] { Load(); }, FailsWith("input is no shape; expected 1 x 3 x height"));
}

TEST_F(YoloxModel, RefusesAnEmptyListOfClasses) {
  Write(BlockNetwork().Model());
  YoloxConfig config;
  config.classes.clear();
  EXPECT_THAT([&] { Load(config); },
              ThrowsMessage<io::InputError>(HasSubstr("yolox: classes in --config is empty")));
}

TEST_F(YoloxModel, RefusesAModelThatAsksForMoreThanAnImage) {
  onnx::Graph graph;
  graph.inputs = {onnx::Value("images", {1, 3, 64, 96}), onnx::Value("sizes", {1, 2})};
  Write(onnx::Model(graph));
  EXPECT_THAT([&] { Load(); }, FailsWith("the model has 2 inputs; expected one image"));
  graph.inputs.clear();
  Write(onnx::Model(graph));
  EXPECT_THAT([&] { Load(); }, FailsWith("the model has 0 inputs; expected one image"));
}

TEST_F(YoloxModel, RefusesAnOutputOfAnotherShape) {
  BlockNetwork network;
  network.classes = 75;
  Write(network.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("output is 1 x 126 x 80; expected 1 x 126 x 85"));
  YoloxConfig config;
  config.classes.resize(75);
  EXPECT_NO_THROW(Load(config));
  network.classes = 80;
  network.strides = {8, 16};
  Write(network.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("output is 1 x 120 x 85; expected 1 x 126 x 85"));
}

TEST_F(YoloxModel, RefusesAnAnswerThatIsNoProbability) {
  BlockNetwork loud;
  loud.gain = 3.0;  // grey is 1.3
  Write(loud.Model());
  EXPECT_THAT([&] { Load(); }, FailsWith("outside [0, 1]"));
}

TEST_F(YoloxModel, SaysWhenTheModelIsNotDecodedAsConfigured) {
  Write(BlockNetwork().Model());
  YoloxConfig config;
  config.decoded = true;
  EXPECT_THAT([&] { Load(config); }, FailsWith("set yolox: decoded: false"));
}

TEST_F(YoloxModel, NamesAFileThatIsMissingOrNoModel) {
  EXPECT_THAT([&] { Load(); }, FailsWith("no such file"));
  EXPECT_THAT([&] { MakeDetector("yolox:", "", camera_, {}); },
              ThrowsMessage<io::InputError>(HasSubstr("names no file")));
  for (const std::string& text : {std::string(), std::string("not a model"),
                                  std::string(1000, '\xff'), std::string(1000, '\0')}) {
    Write(text);
    EXPECT_THAT([&] { Load(); }, ThrowsMessage<io::InputError>(HasSubstr(file_.string())));
  }
}

TEST_F(YoloxModel, RefusesAModelThatIsCutOffAnywhereAndIsSilentOtherwise) {
  const std::string model = BlockNetwork().Model();
  testing::internal::CaptureStderr();
  for (std::size_t part = 0; part < 60; ++part) {
    Write(model.substr(0, model.size() * part / 60));
    EXPECT_THAT([&] { Load(); }, ThrowsMessage<io::InputError>(HasSubstr(file_.string())))
        << part;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace slam
