// Plots of runs: which there are, that they show the runs, and that they are the same bytes each
// time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace eval
