// Plots of runs: which there are, that they show the runs, and that they are the same bytes each
// time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "eval/plot/plotted_run.h"
#include "io/image/decode_image.h"
#include "tests/eval/report/evaluated_world.h"

namespace eval {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class PlotsOfTinyWorld : public EvaluateTinyWorld {
 protected:
  /// A faultless run, and one whose positions are off by up to a centimetre.
  static std::vector<PlottedRun> Runs() {
    TinyRun shaken(*world_);
    for (auto& [stamp_s, T_wc] : shaken.trajectory) T_wc.t.x() += 0.01 * std::sin(20 * stamp_s);
    std::vector<PlottedRun> runs;
    runs.push_back({"faultless", EvaluationOf(TinyRun(*world_))});
    runs.push_back({"shaken", EvaluationOf(shaken)});
    return runs;
  }
  static int PixelsOf(const SeriesStyle& style, const std::string& png) {
    const cv::Mat3b image = io::DecodeImage(png);
    const cv::Vec3b colour(cv::saturate_cast<unsigned char>(255 * style.blue),
                           cv::saturate_cast<unsigned char>(255 * style.green),
                           cv::saturate_cast<unsigned char>(255 * style.red));
    return static_cast<int>(std::count(image.begin(), image.end(), colour));
  }
};

/// Whether a pixel is of a series: its colour, or that with some white in it, as of a bar.
bool IsOf(const SeriesStyle& style, const cv::Vec3b& pixel) {
  const cv::Vec3d ink(255 * (1 - style.blue), 255 * (1 - style.green), 255 * (1 - style.red));
  const cv::Vec3d seen = cv::Vec3d::all(255) - cv::Vec3d(pixel);
  const double share = seen.dot(ink) / ink.dot(ink);
  return share > 0.5 && cv::norm(seen - share * ink) < 12;
}

/// The most pixels of a series that stand one over the other without a gap.
int HeightOf(const SeriesStyle& style, const cv::Mat3b& image) {
  int most = 0;
  for (int u = 0; u < image.cols; ++u) {
    for (int v = 0, height = 0; v < image.rows; ++v) {
      height = IsOf(style, image(v, u)) ? height + 1 : 0;
      most = std::max(most, height);
    }
  }
  return most;
}

/// The last row in which a series is; what is in the legend is above.
int LastRowOf(const SeriesStyle& style, const cv::Mat3b& image) {
  int last = -1;
  for (int v = 0; v < image.rows; ++v) {
    for (const cv::Vec3b& pixel : image.row(v)) {
      if (IsOf(style, pixel)) last = v;
    }
  }
  return last;
}

using Plot = std::vector<PlotFile> (*)(const std::vector<PlottedRun>& runs);
constexpr Plot kAll[] = {PlotTrajectories, PlotErrors, PlotSteps, PlotTimes};

TEST_F(PlotsOfTinyWorld, AreSvgPdfAndPngAndTheSameBytesEachTime) {
  const std::vector<PlottedRun> runs = Runs();
  for (const Plot plot : kAll) {
    const std::vector<PlotFile> files = plot(runs), again = plot(runs);
    ASSERT_EQ(files.size(), 3u);
    EXPECT_THAT(files[0].bytes, StartsWith("<?xml"));
    EXPECT_THAT(files[1].bytes, StartsWith("%PDF"));
    EXPECT_THAT(files[2].bytes, StartsWith("\x89PNG"));
    EXPECT_THAT(files[1].bytes, HasSubstr("/CreationDate (20000101000000Z)"));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(files[i].bytes == again[i].bytes) << files[i].name;
      EXPECT_THAT(files[i].bytes, Not(HasSubstr("ModDate")));
    }
  }
}

TEST_F(PlotsOfTinyWorld, ShowEveryRunInItsColour) {
  const std::vector<PlottedRun> runs = Runs();
  constexpr int kLegend = 150;  // pixels of a legend's sample, at most
  EXPECT_GT(PixelsOf(StyleOfTruth(), PlotTrajectories(runs)[2].bytes), kLegend);
  for (const Plot plot : {PlotTrajectories, PlotErrors}) {
    EXPECT_GT(PixelsOf(StyleOfSeries(1), plot(runs)[2].bytes), kLegend);
    EXPECT_EQ(PixelsOf(StyleOfSeries(2), plot(runs)[2].bytes), 0) << "there are two runs";
  }
}

TEST_F(PlotsOfTinyWorld, ShowTheShareOfThePosesThatHaveAnError) {
  std::vector<PlottedRun> runs = Runs();
  const std::vector<PlotFile> known = PlotErrors(runs);
  for (PlottedRun& run : runs) {
    PoseError unknown;  // later poses, of which there is no truth
    unknown.stamp_s = run.evaluation.trajectory.errors.back().stamp_s;
    for (int i = 0; i < 30; ++i) run.evaluation.trajectory.errors.push_back(unknown);
  }
  EXPECT_TRUE(PlotErrors(runs)[0].bytes == known[0].bytes);
}

TEST_F(PlotsOfTinyWorld, ThatNoRunCanFillAreNotMade) {
  TinyRun bare(*world_);
  bare.trajectory.clear();
  bare.info["tracked"] = 0;
  bare.frames.clear();
  bare.segmentation.clear();
  bare.Write(RunFolder());
  std::filesystem::remove(RunFolder() / "frame_planes.jsonl");
  std::filesystem::remove(RunFolder() / "map.json");
  std::filesystem::remove(RunFolder() / "timing.csv");
  const eval::Run run = ReadRun(RunFolder());
  const std::vector<PlottedRun> runs = {
      {"bare", Evaluate(run, ReadSequence(SequenceFolder()))}};
  for (const Plot plot : kAll) EXPECT_TRUE(plot(runs).empty());
}

TEST_F(PlotsOfTinyWorld, CountTopsByTheHeightOfTheirStep) {
  TinyRun run(*world_);
  int wrong = 0;
  for (std::size_t i = 40; i < 43; ++i) {  // the thin book, 3 cm, is put on the desk
    nlohmann::json* plane = FramePlane(run, i, TinyWorld::kThinTop);
    ASSERT_NE(plane, nullptr);
    (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
    ++wrong;
  }
  const Evaluation evaluation = EvaluationOf(run);
  const std::vector<StepScore>& steps = evaluation.planes->steps;
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_LE(steps[0].min_mm, 30.0);
  EXPECT_GE(steps[0].max_mm, 30.0);
  EXPECT_EQ(steps[0].wrong_planes, wrong);
  EXPECT_EQ(steps[0].right, steps[0].seen - wrong);
  EXPECT_GE(steps[0].right_planes, steps[0].right);
  EXPECT_EQ(steps[1].min_mm, 60.0);
  EXPECT_EQ(steps[1].wrong_planes, 0);
  EXPECT_EQ(steps[1].right, steps[1].seen);
}

// Else a right angle is none, and a circle is not round.
TEST(PlotTrajectories, HasOneScaleOnBothAxesWhateverTheShapeOfThePath) {
  for (const double y_m : {2.0, 4.0, 8.0}) {
    std::vector<PlottedRun> runs(1);
    const std::array<Eigen::Vector3d, 4> corners{
        {{0, 0, 0}, {4, 0, 0}, {4, y_m, 0}, {0, y_m, 0}}};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      PoseError pose;
      pose.stamp_s = 0.1 * static_cast<double>(i);
      pose.position_g = corners[i];
      runs[0].evaluation.trajectory.errors.push_back(pose);
    }
    const cv::Mat3b image = io::DecodeImage(PlotTrajectories(runs)[2].bytes);
    cv::Mat3b on_its_side;
    cv::transpose(image, on_its_side);
    const double width = HeightOf(StyleOfSeries(0), on_its_side),
                 height = HeightOf(StyleOfSeries(0), image);
    ASSERT_GT(std::min(width, height), 100);               // more than a sample in the legend
    EXPECT_NEAR(height / width, y_m / 4, 0.02 * y_m / 4);  // two pixels of a hundred
  }
}

// Whiskers and scores speak of means; medians of the same times can be anything.
TEST(PlotTimes, DrawsBarsAsHighAsTheMeansAre) {
  std::vector<PlottedRun> runs(2);
  runs[0].evaluation.timing = TimingScore{{{"orb", 8.0, 3.0, 10.0}}, {}, {}};
  runs[1].evaluation.timing = TimingScore{{{"orb", 4.0, 4.0, 10.0}}, {}, {}};
  const cv::Mat3b image = io::DecodeImage(PlotTimes(runs)[2].bytes);
  const double high = HeightOf(StyleOfSeries(0), image),
               low = HeightOf(StyleOfSeries(1), image);
  ASSERT_GT(low, 50);
  EXPECT_NEAR(high / low, 2.0, 0.05);  // two rows of some hundred
}

TEST(PlotSteps, PutsSharesOfPlanesAtTheLeftAndOfTopsAtTheRightOnAScaleFromNoneToAll) {
  // Planes: none, all and one of four are right. Tops: all, none and three of four.
  std::vector<PlottedRun> runs(3);
  for (PlottedRun& run : runs) run.evaluation.planes.emplace();
  runs[0].evaluation.planes->steps = {{10, 20, 8, 8, 0, 4}};
  runs[1].evaluation.planes->steps = {{10, 20, 8, 0, 4, 0}};
  runs[2].evaluation.planes->steps = {{10, 20, 8, 6, 1, 3}};
  const cv::Mat3b image = io::DecodeImage(PlotSteps(runs)[2].bytes);
  const int middle = image.cols / 2;
  const auto share = [&](const cv::Mat3b& panel, std::size_t none, std::size_t all) {
    const double bottom = LastRowOf(StyleOfSeries(none), panel);
    return (bottom - LastRowOf(StyleOfSeries(2), panel)) /
           (bottom - LastRowOf(StyleOfSeries(all), panel));
  };
  constexpr double kPixel = 0.01;  // two of them, of 400 rows, with some to spare
  EXPECT_NEAR(share(image.colRange(0, middle), 0, 1), 0.25, kPixel);
  EXPECT_NEAR(share(image.colRange(middle, image.cols), 1, 0), 0.75, kPixel);
}

}  // namespace
}  // namespace eval
