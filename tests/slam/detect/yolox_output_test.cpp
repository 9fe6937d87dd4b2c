#include "slam/detect/yolox_output.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "io/input_error.h"
#include "slam/base/random.h"
#include "slam/detect/class_table.h"

namespace slam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const cv::Size kInput(96, 64);  // grids of 12 x 8, 6 x 4 and 3 x 2 cells
constexpr int kCells = 96 + 24 + 6;

YoloxConfig ThreeClasses() {
  YoloxConfig config;
  config.classes = {"book", "cup", "tv"};
  return config;
}

cv::Mat1f Silence() { return cv::Mat1f(kCells, 8, 0.0f); }

void Say(cv::Mat1f& output, int row, const std::vector<float>& values) {
  std::copy(values.begin(), values.end(), output[row]);
}

TEST(YoloxOutput, HasACellForEachStepOfEachStride) {
  EXPECT_EQ(YoloxCells(kInput), kCells);
  EXPECT_EQ(YoloxCells({640, 640}), 8400);
  EXPECT_EQ(YoloxCells({416, 416}), 3549);
}

// By hand: cell (column 5, row 2) of the second grid is row 96 + 2 * 6 + 5 = 113, stride 16.
TEST(YoloxOutput, PutsABoxWhereTheCellOfItsRowLies) {
  cv::Mat1f output = Silence();
  Say(output, 113, {0.5f, 0.25f, std::log(2.0f), std::log(3.0f), 0.8f, 0.1f, 0.75f, 0.2f});
  const std::vector<YoloxBox> boxes = DecodeYolox(output, kInput, ThreeClasses());
  ASSERT_EQ(boxes.size(), 1u);
  constexpr double kFloat_px = 1e-4;  // float logarithms of sizes below 100
  EXPECT_NEAR(boxes[0].box.min.x(), 5.5 * 16 - 16, kFloat_px);
  EXPECT_NEAR(boxes[0].box.max.x(), 5.5 * 16 + 16, kFloat_px);
  EXPECT_NEAR(boxes[0].box.min.y(), 2.25 * 16 - 24, kFloat_px);
  EXPECT_NEAR(boxes[0].box.max.y(), 2.25 * 16 + 24, kFloat_px);
  EXPECT_EQ(boxes[0].class_index, 1);
  EXPECT_NEAR(boxes[0].score, 0.6, 1e-6);
}

TEST(YoloxOutput, TakesBoxesAsTheyAreFromAModelThatComputesThem) {
  cv::Mat1f output = Silence();
  Say(output, 113, {40, 30, 20, 10, 1, 1, 0, 0});
  YoloxConfig config = ThreeClasses();
  config.decoded = true;
  const std::vector<YoloxBox> boxes = DecodeYolox(output, kInput, config);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].box.min, Eigen::Vector2d(30, 25));
  EXPECT_EQ(boxes[0].box.max, Eigen::Vector2d(50, 35));
}

TEST(YoloxOutput, TellsDecodedBoxesFromOffsetsByWhereTheirCentresLie) {
  cv::Mat1f offsets = Silence(), decoded = Silence();
  Random random{4};
  int i = 0;
  for (const int stride : {8, 16, 32}) {
    for (int row = 0; row < kInput.height / stride; ++row) {
      for (int column = 0; column < kInput.width / stride; ++column, ++i) {
        for (int k = 0; k < 2; ++k) {  // within a cell of the middle of its own
          offsets(i, k) = static_cast<float>(2.0 * random.Uniform() - 0.5);
          decoded(i, k) =
              static_cast<float>(stride) * (offsets(i, k) + float(k == 0 ? column : row));
        }
      }
    }
  }
  EXPECT_FALSE(LooksDecoded(offsets, kInput));
  EXPECT_TRUE(LooksDecoded(decoded, kInput));
  EXPECT_FALSE(LooksDecoded(Silence(), kInput));
}

// Each row is held against its own cell: a centre that lies nearer to it than to the corner of
// the image was decoded.
TEST(YoloxOutput, TellsDecodedBoxesEvenWhereTheyAreFarFromTheirCells) {
  const auto looks_decoded = [](float part) {
    cv::Mat1f output = Silence();
    int i = 0;
    for (const int stride : {8, 16, 32}) {
      for (int row = 0; row < kInput.height / stride; ++row) {
        for (int column = 0; column < kInput.width / stride; ++column, ++i) {
          output(i, 0) = part * static_cast<float>(stride * column);
          output(i, 1) = part * static_cast<float>(stride * row);
        }
      }
    }
    return LooksDecoded(output, kInput);
  };
  EXPECT_TRUE(looks_decoded(0.55f));
  EXPECT_FALSE(looks_decoded(0.45f));
}

TEST(YoloxOutput, ScoresByObjectnessTimesClassAndKeepsTheThresholdItself) {
  cv::Mat1f output = Silence();
  Say(output, 0, {0, 0, 0, 0, 0.5f, 0.5f, 0.25f, 0});  // 0.25: kept
  Say(output, 1, {0, 0, 0, 0, 0.5f, 0, 0.46875f, 0});  // 0.234: each factor is above
  Say(output, 2, {0, 0, 0, 0, 1, 0, 0.5f, 0.5f});      // equal: the first class
  YoloxConfig config = ThreeClasses();
  config.min_score = 0.25;
  const std::vector<YoloxBox> boxes = DecodeYolox(output, kInput, config);
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_EQ(boxes[0].score, 0.25);
  EXPECT_EQ(boxes[0].class_index, 0);
  EXPECT_EQ(boxes[1].class_index, 1);
}

TEST(YoloxOutput, RefusesWhatNoSigmoidGives) {
  for (const float bad : {1.5f, -0.25f, std::nanf("")}) {
    for (const int column : {4, 5, 7}) {
      cv::Mat1f output = Silence();
      output(kCells - 1, column) = bad;
      EXPECT_THAT([&] { DecodeYolox(output, kInput, ThreeClasses()); },
                  ThrowsMessage<io::InputError>(HasSubstr("outside [0, 1]")));
    }
  }
  for (const int column : {0, 1, 2, 3}) {
    cv::Mat1f output = Silence();
    Say(output, 3, {0, 0, 0, 0, 1, 1, 0, 0});
    output(3, column) = column < 2 ? std::nanf("") : INFINITY;
    EXPECT_THAT([&] { DecodeYolox(output, kInput, ThreeClasses()); },
                ThrowsMessage<io::InputError>(HasSubstr("no finite rectangle")));
  }
  EXPECT_THROW(DecodeYolox(cv::Mat1f(kCells, 9, 0.0f), kInput, ThreeClasses()),
               std::invalid_argument);
  YoloxConfig no_classes;
  no_classes.classes.clear();
  EXPECT_THROW(DecodeYolox(cv::Mat1f(kCells, 5, 0.0f), kInput, no_classes),
               std::invalid_argument);
}

// A size of exp(h) is never negative; one that a model computes itself can be.
TEST(YoloxOutput, RefusesADecodedBoxOfNegativeSize) {
  YoloxConfig config = ThreeClasses();
  config.decoded = true;
  for (const int column : {2, 3}) {
    cv::Mat1f output = Silence();
    Say(output, 113, {40, 30, 20, 10, 1, 1, 0, 0});
    output(113, column) = -8;
    EXPECT_THAT([&] { DecodeYolox(output, kInput, config); },
                ThrowsMessage<io::InputError>(HasSubstr("no finite rectangle")));
  }
}

TEST(YoloxOutput, SuppressesOverlapsWithinAClassOnly) {
  const Box here{{0, 0}, {10, 10}}, beside{{2, 0}, {12, 10}}, far{{30, 0}, {40, 10}};
  // Intersection 80 of 120.
  const std::vector<YoloxBox> boxes = {
      {here, 0.5, 0}, {beside, 0.9, 0}, {far, 0.7, 0}, {here, 0.6, 1}};
  const auto scores = [&](double most) {
    std::vector<double> left;
    for (const YoloxBox& box : SuppressOverlaps(boxes, most)) left.push_back(box.score);
    return left;
  };
  EXPECT_THAT(scores(0.66), ElementsAre(0.9, 0.7, 0.6));
  EXPECT_THAT(scores(0.67), ElementsAre(0.9, 0.7, 0.6, 0.5));
}

TEST(YoloxOutput, LetsABoxLiveWhoseSuppressorHasGoneItself) {
  // Each overlaps the next by 7 of 13; the first and the third by 4 of 16.
  const std::vector<YoloxBox> chain = {
      {{{0, 0}, {10, 1}}, 0.9, 0}, {{{3, 0}, {13, 1}}, 0.8, 0}, {{{6, 0}, {16, 1}}, 0.7, 0}};
  const std::vector<YoloxBox> left = SuppressOverlaps(chain, 0.5);
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[1].score, 0.7);
}

TEST(YoloxOutput, KeepsTheEarlierOfEqualBoxes) {
  const std::vector<YoloxBox> twins = {{{{0, 0}, {10, 10}}, 0.5, 0},
                                       {{{1, 0}, {11, 10}}, 0.5, 0}};
  const std::vector<YoloxBox> left = SuppressOverlaps(twins, 0.45);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].box.min.x(), 0);
}

/// The published demo written down as it stands: all grids first, then all rows, then
/// suppression class by class on what is left of a sorted list.
std::vector<YoloxBox> AsPublished(const cv::Mat1f& output, cv::Size input,
                                  const YoloxConfig& config) {
  std::vector<double> grid_x, grid_y, stride;
  for (const int s : {8, 16, 32}) {
    for (int k = 0; k < (input.width / s) * (input.height / s); ++k) {
      grid_x.push_back(k % (input.width / s));
      grid_y.push_back(k / (input.width / s));
      stride.push_back(s);
    }
  }
  std::vector<YoloxBox> kept;
  for (std::size_t c = 0; c < config.classes.size(); ++c) {
    std::vector<YoloxBox> of_class;
    for (int i = 0; i < output.rows; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const cv::Mat1f classes = output.row(i).colRange(5, output.cols);
      if (std::max_element(classes.begin(), classes.end()) - classes.begin() !=
          static_cast<std::ptrdiff_t>(c)) {
        continue;
      }
      const double score = static_cast<double>(output(i, 4)) *
                           static_cast<double>(output(i, 5 + static_cast<int>(c)));
      if (score < config.min_score) continue;
      const double x = (static_cast<double>(output(i, 0)) + grid_x[k]) * stride[k];
      const double y = (static_cast<double>(output(i, 1)) + grid_y[k]) * stride[k];
      const double w = std::exp(static_cast<double>(output(i, 2))) * stride[k];
      const double h = std::exp(static_cast<double>(output(i, 3))) * stride[k];
      of_class.push_back(
          {{{x - w / 2, y - h / 2}, {x + w / 2, y + h / 2}}, score, static_cast<int>(c)});
    }
    while (!of_class.empty()) {
      const auto best = std::max_element(
          of_class.begin(), of_class.end(),
          [](const YoloxBox& a, const YoloxBox& b) { return a.score < b.score; });
      const YoloxBox top = *best;
      kept.push_back(top);
      std::erase_if(of_class, [&](const YoloxBox& other) {
        const double w = std::max(0.0, std::min(top.box.max.x(), other.box.max.x()) -
                                           std::max(top.box.min.x(), other.box.min.x()));
        const double h = std::max(0.0, std::min(top.box.max.y(), other.box.max.y()) -
                                           std::max(top.box.min.y(), other.box.min.y()));
        const double both =
            top.box.width() * top.box.height() + other.box.width() * other.box.height() - w * h;
        return w * h / both > config.max_nms_iou;
      });
    }
  }
  return kept;
}

TEST(YoloxOutput, AgreesWithThePublishedDemoOnRandomOutputs) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random{seed};
    const auto between = [&](double low, double high) {
      return static_cast<float>(low + (high - low) * random.Below(100000) / 1e5);
    };
    cv::Mat1f output = Silence();
    for (int i = 0; i < kCells; ++i) {
      for (int c = 0; c < 8; ++c) output(i, c) = c < 4 ? between(-1, 2) : between(0, 1);
    }
    const YoloxConfig config = ThreeClasses();
    const auto found =
        SuppressOverlaps(DecodeYolox(output, kInput, config), config.max_nms_iou);
    const auto expected = AsPublished(output, kInput, config);
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_GT(found.size(), 3u);
    std::set<double> kept, published;
    for (const YoloxBox& box : found) kept.insert(box.score + 10 * box.class_index);
    for (const YoloxBox& box : expected) published.insert(box.score + 10 * box.class_index);
    EXPECT_EQ(kept, published);
    for (const YoloxBox& box : expected) {
      EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const YoloxBox& other) {
        return other.score == box.score && other.box.min.isApprox(box.box.min, 1e-12) &&
               other.box.max.isApprox(box.box.max, 1e-12);
      }));
    }
  }
}

TEST(YoloxOutput, NamesCocosEightyClassesAsTheClassTableDoes) {
  const std::vector<std::string> names = CocoNames();
  ASSERT_EQ(names.size(), 80u);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 80u);
  EXPECT_EQ(names[0], "person");
  EXPECT_EQ(names[62], "tv");
  EXPECT_EQ(names[73], "book");
  EXPECT_EQ(names[79], "toothbrush");
  const ClassTable table = CocoClassTable();
  std::set<std::string> known;
  for (const auto* list : {&table.regular, &table.unstructured, &table.other})
    known.insert(list->begin(), list->end());
  for (const std::string& name : names) EXPECT_TRUE(known.contains(name)) << name;
}

}  // namespace
}  // namespace slam
