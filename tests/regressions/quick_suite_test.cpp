// The quick regression suite: three scenes, their figures against a stored baseline. After a
// change that is meant to move them: PAS_UPDATE_BASELINE=1
// build/release/tests/regressions_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "eval/regression/baseline.h"
#include "sim/families/families.h"
#include "tests/support/pipeline.h"

namespace {

using nlohmann::json;

const std::filesystem::path kBaseline =
    std::filesystem::path(PAS_SOURCE_DIR) / "tests/regressions/quick_suite.json";

constexpr std::uint64_t kSceneSeeds[] = {11, 12, 13};  // not those of any figure in the README
constexpr pipeline::Recording kRecording{.frames = 90, .sensor = sim::SensorKind::kKinect1};

/// scene -> watched figures.
json RunSuite(slam::Variant variant) {
  json figures = json::object();
  for (const std::uint64_t seed : kSceneSeeds) {
    const std::string scene = "desk-" + std::to_string(seed);
    const pipeline::TemporaryFolder folder("suite");
    pipeline::Record(sim::MakeScene("desk", seed), kRecording, folder / "seq");
    pipeline::Run(folder / "seq", folder / "run", variant);
    figures[scene] = eval::WatchedFigures(pipeline::Score(folder / "run", folder / "seq"));
  }
  return figures;
}

json ReadBaseline() {
  std::ifstream in(kBaseline);
  return json::parse(in).at("scenes");
}

TEST(QuickSuite, HoldsItsBaseline) {
  const json now = RunSuite(slam::Variant::kFull);
  if (std::getenv("PAS_UPDATE_BASELINE") != nullptr) {
    std::ofstream(kBaseline) << json{{"format", "pas-baseline/1"}, {"scenes", now}}.dump(1)
                             << "\n";
    GTEST_SKIP() << "wrote " << kBaseline;
  }
  for (const eval::Regression& regression : eval::CompareWithBaseline(ReadBaseline(), now)) {
    ADD_FAILURE() << eval::Describe(regression);
  }
}

// The suite must be able to fail: the fault planted here, association by parameters alone, is
// the very one that the project exists for.
TEST(QuickSuite, TurnsRedWhenPlanesAreAssociatedByTheirParametersAlone) {
  if (std::getenv("PAS_UPDATE_BASELINE") != nullptr) GTEST_SKIP() << "updating";
  const auto found =
      eval::CompareWithBaseline(ReadBaseline(), RunSuite(slam::Variant::kNoAssociation));
  EXPECT_THAT(found, testing::Contains(testing::Field(&eval::Regression::metric,
                                                      "/association/decision/precision")));
}

}  // namespace
