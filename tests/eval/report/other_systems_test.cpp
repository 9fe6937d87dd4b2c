// Runs of other programs: each file that there is gives its figures, and none is needed but the
// trajectory; label images alone give figures of a segmentation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "eval/report/table.h"
#include "tests/eval/report/evaluated_world.h"
#include "tests/support/image_files.h"
#include "tests/support/refusal.h"

namespace eval {
namespace {

using test_support::RefusalOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class EvaluateOtherSystems : public EvaluateTinyWorld {
 protected:
  EvaluateOtherSystems() : whole_(Metrics(TinyRun(*world_))) {}

  /// Keeps these of the files of a faultless run.
  static nlohmann::json MetricsOf(const std::set<std::string>& kept) {
    for (const auto& entry : fs::directory_iterator(RunFolder())) {
      if (kept.count(entry.path().filename().string()) == 0) fs::remove_all(entry.path());
    }
    return nlohmann::json::parse(
        MetricsText(Evaluate(ReadRun(RunFolder()), ReadSequence(SequenceFolder()))));
  }
  /// Every figure of the group but the named ones.
  static void ExpectSameBut(nlohmann::json ours, nlohmann::json whole,
                            const std::vector<std::string>& but) {
    for (const std::string& key : but) {
      ours.erase(key);
      whole.erase(key);
    }
    EXPECT_TRUE(Same(ours, whole)) << ours << "\n" << whole;
  }

  nlohmann::json whole_;  ///< of the run with all files
};

TEST_F(EvaluateOtherSystems, ATrajectoryAloneIsScoredAsThatOfAWholeRun) {
  const nlohmann::json ours = MetricsOf({"trajectory.txt"});
  EXPECT_EQ(ours["trajectory"], whole_["trajectory"]);
  for (const char* group : {"extraction", "vertices", "association", "map", "timing_ms"}) {
    EXPECT_FALSE(ours.contains(group)) << group;
  }
  EXPECT_FALSE(ours.contains("warnings")) << ours["warnings"];
  EXPECT_THAT(
      RefusalOf([] { SequenceOf(ReadRun(RunFolder())); }),
      HasSubstr("has no run.json, which would name the sequence; name it with --truth"));
}

TEST_F(EvaluateOtherSystems, AMapBesideItIsMatchedByItsGeometry) {
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "map.json"});
  ExpectSameBut(ours["map"], whole_["map"], {"merged"});
  EXPECT_TRUE(ours["map"]["merged"].is_null());
  EXPECT_THAT(ours["reasons"]["map/merged"].get<std::string>(),
              HasSubstr("frame_planes.jsonl"));
  EXPECT_FALSE(ours.contains("association"));
  EXPECT_THAT(ours["rules"]["map"].get<std::string>(), HasSubstr("by shared area"));
}

TEST_F(EvaluateOtherSystems, AMapPlaneFarFromEveryTrueOneIsSpurious) {
  MetricsOf({"trajectory.txt", "map.json"});
  nlohmann::json map = nlohmann::json::parse(std::ifstream(RunFolder() / "map.json"));
  map["planes"][0]["d"] = map["planes"][0]["d"].get<double>() + 1.0;
  for (const char* outline : {"vertices", "hull"}) {
    for (auto& point : map["planes"][0][outline]) {
      for (std::size_t i = 0; i < 3; ++i) {
        point[i] = point[i].get<double>() - map["planes"][0]["normal"][i].get<double>();
      }
    }
  }
  io::WriteFile(RunFolder() / "map.json", map.dump());
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "map.json"});
  EXPECT_EQ(ours["map"]["spurious"], 1);
  EXPECT_EQ(ours["map"]["matched"], whole_["map"]["matched"].get<int>() - 1);
}

TEST_F(EvaluateOtherSystems, AMapWithItsNormalsTurnedRoundIsAWarning) {
  MetricsOf({"trajectory.txt", "map.json"});
  nlohmann::json map = nlohmann::json::parse(std::ifstream(RunFolder() / "map.json"));
  for (auto& plane : map["planes"]) {
    for (auto& component : plane["normal"]) component = -component.get<double>();
    plane["d"] = -plane["d"].get<double>();
  }
  io::WriteFile(RunFolder() / "map.json", map.dump());
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "map.json"});
  EXPECT_EQ(ours["map"]["spurious"], ours["map"]["planes"]);
  EXPECT_THAT(ours["warnings"], ::testing::ElementsAre(HasSubstr("normals turned round")));
}

TEST_F(EvaluateOtherSystems, OfAMapWithoutOutlinesOnlyDecisionsTellWhatItShows) {
  TinyRun tiny(*world_);
  for (auto& plane : tiny.map["planes"]) {
    plane.erase("hull");
    plane["vertices"] = nlohmann::json::array();
  }
  const nlohmann::json decided = Metrics(tiny);
  for (const char* figure : {"matched", "duplicates", "spurious"}) {
    EXPECT_EQ(decided["map"][figure], whole_["map"][figure]) << figure;
  }
  EXPECT_TRUE(decided["map"]["area_explained"].is_null());
  EXPECT_THAT(decided["warnings"],
              ::testing::ElementsAre(HasSubstr("/planes/0/hull: is missing")));
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "map.json"});
  for (const char* figure : {"matched", "duplicates", "spurious", "area_explained"}) {
    EXPECT_TRUE(ours["map"].at(figure).is_null()) << figure;
    EXPECT_THAT(ours["reasons"].at(std::string("map/") + figure).get<std::string>(),
                HasSubstr("no map plane has an outline"));
  }
  EXPECT_EQ(ours["map"]["planes"], whole_["map"]["planes"]);
}

TEST_F(EvaluateOtherSystems, AMapWithoutAnyPoseIsNotSpurious) {
  io::WriteFile(RunFolder() / "trajectory.txt", "");
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "map.json"});
  for (const char* figure : {"matched", "duplicates", "spurious", "area_explained"}) {
    EXPECT_TRUE(ours["map"].at(figure).is_null()) << figure;
    EXPECT_EQ(ours["reasons"].at(std::string("map/") + figure), "the run has no pose");
  }
  // Of a map without planes it is known that none is spurious.
  io::WriteFile(RunFolder() / "map.json", R"({"planes": []})");
  EXPECT_EQ(MetricsOf({"trajectory.txt", "map.json"})["map"]["spurious"], 0);
}

TEST_F(EvaluateOtherSystems, FramePlanesWithoutVerticesAreAWarning) {
  TinyRun tiny(*world_);
  for (auto& frame : tiny.frames) {
    for (auto& plane : frame["planes"]) plane.erase("vertices");
  }
  EXPECT_THAT(Metrics(tiny)["warnings"],
              ::testing::ElementsAre(HasSubstr("/planes/0/vertices: is missing")));
}

TEST_F(EvaluateOtherSystems, AMapPlaneIsOfTheFaceThatItSharesNotOfANearerOneBesideIt) {
  // The thick book's top is mapped 26 mm too low: 4 mm above the thin one's beside it, and 34 mm
  // above the desk's below it.
  MetricsOf({"trajectory.txt", "map.json"});
  nlohmann::json map = nlohmann::json::parse(std::ifstream(RunFolder() / "map.json"));
  for (auto& plane : map["planes"]) {
    if (plane["id"] != TinyRun::MapId(TinyWorld::kThickTop)) continue;
    plane["d"] = plane["d"].get<double>() + 0.026;
    for (const char* outline : {"vertices", "hull"}) {
      for (auto& point : plane[outline]) {
        for (std::size_t i = 0; i < 3; ++i) {
          point[i] = point[i].get<double>() - 0.026 * plane["normal"][i].get<double>();
        }
      }
    }
  }
  io::WriteFile(RunFolder() / "map.json", map.dump());
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "map.json"});
  EXPECT_EQ(ours["map"]["spurious"], 0);
  EXPECT_EQ(ours["map"]["matched"], whole_["map"]["matched"]);
  EXPECT_GT(ours["map"]["offset_mm"]["p95"].get<double>(), 10.0);
}

TEST_F(EvaluateOtherSystems, LabelImagesBesideItAreScoredAsASegmentation) {
  const nlohmann::json ours = MetricsOf({"trajectory.txt", "segmentation"});
  ExpectSameBut(ours["extraction"], whole_["extraction"], {"normal_deg", "offset_mm"});
  EXPECT_TRUE(ours["extraction"]["normal_deg"].is_null());
  EXPECT_THAT(ours["reasons"]["extraction/normal_deg"].get<std::string>(),
              HasSubstr("no geometry"));
  EXPECT_FALSE(ours.contains("vertices"));
  EXPECT_FALSE(ours.contains("association"));
}

TEST_F(EvaluateOtherSystems, LabelImagesAloneGiveTheSameFiguresOfAnyLabelsAndEitherDepth) {
  const Sequence sequence = ReadSequence(SequenceFolder());
  const auto figures = [&] {
    return nlohmann::json(
        LabelsJson(EvaluateLabels(RunOfLabels(RunFolder() / "segmentation"), sequence)));
  };
  const nlohmann::json ours = figures();
  ExpectSameBut(ours["extraction"], whole_["extraction"], {"normal_deg", "offset_mm"});
  EXPECT_FALSE(ours.contains("trajectory"));
  for (const auto& entry : fs::directory_iterator(RunFolder() / "segmentation")) {
    cv::Mat labels = test_support::ReadImageFile(entry.path());
    labels.convertTo(labels, CV_16U, 1000.0);
    test_support::WriteImageFile(entry.path(), labels);
  }
  EXPECT_EQ(figures(), ours);
  EXPECT_THAT(LabelsTable(EvaluateLabels(RunOfLabels(RunFolder() / "segmentation"), sequence)),
              HasSubstr("panoptic quality           1.0000"));
}

TEST_F(EvaluateOtherSystems, AFrameWithoutALabelImageFoundNothingAndIsAWarning) {
  fs::remove(fs::directory_iterator(RunFolder() / "segmentation")->path());
  const LabelEvaluation evaluation =
      EvaluateLabels(RunOfLabels(RunFolder() / "segmentation"), ReadSequence(SequenceFolder()));
  ASSERT_EQ(evaluation.label_warnings.size(), 1u);
  EXPECT_EQ(evaluation.label_warnings[0].what, "has no image of 1 of 45 frames");
  EXPECT_GT(evaluation.planes.regions->missed, 0.0);
}

TEST_F(EvaluateOtherSystems, LabelImagesThatCannotBeScoredAreRefused) {
  const fs::path labels = RunFolder() / "segmentation";
  Sequence sequence = ReadSequence(SequenceFolder());
  EXPECT_THAT(RefusalOf([] { RunOfLabels(RunFolder() / "map.json"); }),
              HasSubstr("is no folder"));
  EXPECT_THAT(RefusalOf([] { RunOfLabels(SequenceFolder() / "gt"); }),
              HasSubstr("has no label image"));
  Sequence without_truth = sequence;
  without_truth.scene.reset();
  EXPECT_THAT(RefusalOf([&] { EvaluateLabels(RunOfLabels(labels), without_truth); }),
              HasSubstr("does not tell which planes"));
  for (SequenceFrame& frame : sequence.frames) frame.stamp_s += 1000.0;
  EXPECT_THAT(RefusalOf([&] { EvaluateLabels(RunOfLabels(labels), sequence); }),
              HasSubstr("has no image of any frame"));
}

}  // namespace
}  // namespace eval
