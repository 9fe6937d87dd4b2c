#include "eval/check/check_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "eval/check/check_folder.h"
#include "tests/eval/check/small_run.h"
#include "tests/support/fault_text.h"
#include "tests/support/image_files.h"

namespace eval {
namespace {

using namespace small_world;
using ::testing::HasSubstr;

class CheckRunFolder : public ::testing::Test {
 protected:
  CheckRunFolder() { WriteRun(run(), MakeWorld()); }
  fs::path run() const { return folder_.path() / "run"; }
  void EditJson(const std::string& file, const std::function<void(json&)>& edit) {
    json document = json::parse(ReadText(run() / file));
    edit(document);
    WriteText(run() / file, document.dump(1));
  }
  void EditLine(int line, const std::function<void(json&)>& edit) {
    std::istringstream in(ReadText(run() / "frame_planes.jsonl"));
    std::string out, text;
    for (int i = 1; std::getline(in, text); ++i) {
      json record = json::parse(text);
      if (i == line) edit(record);
      out += record.dump() + "\n";
    }
    WriteText(run() / "frame_planes.jsonl", out);
  }
  void ExpectOnly(const std::string& file, int line, const std::string& pointer,
                  const std::string& what) {
    const CheckReport report = CheckFolder(run());
    ASSERT_EQ(report.faults.size(), 1u) << All(report);
    const Fault& fault = report.faults[0];
    EXPECT_EQ(fault.file, file) << All(report);
    EXPECT_EQ(fault.line, line) << All(report);
    EXPECT_EQ(fault.pointer, pointer) << All(report);
    EXPECT_THAT(fault.what, HasSubstr(what));
    EXPECT_FALSE(fault.mend.empty());
  }
  TemporaryFolder folder_;
};

TEST_F(CheckRunFolder, FindsNoFaultInAFaultlessOne) {
  const CheckReport report = CheckFolder(run());
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
  EXPECT_EQ(report.kind, "run");
  EXPECT_EQ(report.frames, 4);
  EXPECT_EQ(report.files, 7 + 4);
}

TEST_F(CheckRunFolder, NamesEveryFileThatIsMissing) {
  for (const char* file : {"trajectory.txt", "keyframes.txt", "frame_planes.jsonl", "map.json",
                           "map.ply", "timing.csv"}) {
    fs::remove(run() / file);
  }
  fs::remove_all(run() / "segmentation");
  EXPECT_EQ(CheckFolder(run()).faults.size(), 6u) << All(CheckFolder(run()));
}

TEST_F(CheckRunFolder, NamesAKeyThatRunJsonLacks) {
  EditJson("run.json", [](json& document) { document.erase("variant"); });
  ExpectOnly("run.json", 0, "/variant", "missing");
}

TEST_F(CheckRunFolder, NamesAMissingMemoryFigure) {
  EditJson("run.json", [](json& document) { document.erase("peak_memory_mb"); });
  ExpectOnly("run.json", 0, "/peak", "peak memory");
}

TEST_F(CheckRunFolder, NamesATrajectoryThatLacksATrackedFrame) {
  const std::string text = ReadText(run() / "trajectory.txt");
  WriteText(run() / "trajectory.txt", text.substr(0, text.rfind('\n', text.size() - 2) + 1));
  ExpectOnly("trajectory.txt", 0, "", "has 3 poses");
}

TEST_F(CheckRunFolder, NamesAKeyframeThatWasNeverTracked) {
  WriteText(run() / "keyframes.txt", "1.0 0 0 0 0 0 0 1\n1.5 0 0 0 0 0 0 1\n");
  ExpectOnly("keyframes.txt", 2, "", "no time of trajectory.txt");
}

TEST_F(CheckRunFolder, NamesACovarianceWithoutAPoseAndAPoseWithoutACovariance) {
  std::string lines;
  std::vector<std::string> stamps;
  std::istringstream poses(ReadText(run() / "trajectory.txt"));
  for (std::string pose; std::getline(poses, pose);)
    stamps.push_back(pose.substr(0, pose.find(' ')));
  const std::string numbers = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
  for (const std::string& stamp : stamps) lines += stamp + numbers;
  WriteText(run() / "trajectory_covariance.txt", lines);
  EXPECT_EQ(CheckFolder(run()).faults.size(), 0u) << All(CheckFolder(run()));
  WriteText(run() / "trajectory_covariance.txt", lines + "99" + numbers);
  ExpectOnly("trajectory_covariance.txt", 5, "", "no time of trajectory.txt");
  WriteText(run() / "trajectory_covariance.txt", lines.substr(lines.find('\n') + 1));
  ExpectOnly("trajectory.txt", 1, "", "no time of trajectory_covariance.txt");
}

TEST_F(CheckRunFolder, NamesAFrameWithoutALineOfPlanes) {
  const std::string text = ReadText(run() / "frame_planes.jsonl");
  const auto cut = text.rfind('\n', text.size() - 2);
  WriteText(run() / "frame_planes.jsonl", text.substr(0, cut + 1));
  fs::remove_all(run() / "segmentation");
  const CheckReport report = CheckFolder(run());
  ASSERT_EQ(report.faults.size(), 2u) << All(report);
  EXPECT_THAT(report.faults[0].what, HasSubstr("no time of frame_planes.jsonl"));
  EXPECT_THAT(report.faults[1].what, HasSubstr("has 3 frames"));
}

TEST_F(CheckRunFolder, NamesAPlaneThatTurnsItsBackToTheCamera) {
  EditLine(2, [](json& frame) {
    json& plane = frame["planes"][0];
    for (json& v : plane["normal"]) v = -v.get<double>();
    plane["d"] = -plane["d"].get<double>();
  });
  ExpectOnly("frame_planes.jsonl", 2, "/planes/0/d", "d > 0");
}

TEST_F(CheckRunFolder, NamesANormalThatIsNotUnit) {
  EditLine(2, [](json& frame) { frame["planes"][0]["normal"] = {0.0, 0.0, -0.9}; });
  ExpectOnly("frame_planes.jsonl", 2, "/planes/0/normal", "length 0.9");
}

TEST_F(CheckRunFolder, NamesAMapPlaneThatTheMapDoesNotHave) {
  EditLine(3, [](json& frame) { frame["planes"][0]["map_plane"] = 99; });
  ExpectOnly("frame_planes.jsonl", 3, "/planes/0/map_plane", "no plane of map.json");
}

TEST_F(CheckRunFolder, NamesADecisionThatIsNone) {
  EditLine(3, [](json& frame) { frame["planes"][0]["decision"] = "maybe"; });
  ExpectOnly("frame_planes.jsonl", 3, "/planes/0/decision", "maybe");
}

TEST_F(CheckRunFolder, NamesAReasonThatTheFormatDoesNotKnow) {
  EditLine(1, [](json& frame) { frame["planes"][0]["bad"] = "small"; });
  ExpectOnly("frame_planes.jsonl", 1, "/planes/0/bad", "small");
}

TEST_F(CheckRunFolder, NamesAMatchWithAPlaneThatNobodyMade) {
  EditLine(1, [](json& frame) { frame["planes"][0]["decision"] = "matched"; });
  ExpectOnly("frame_planes.jsonl", 1, "/planes/0/decision", "no earlier frame made");
}

TEST_F(CheckRunFolder, NamesAMatchWithAPlaneThatTheVeryFrameMade) {
  EditLine(1, [](json& frame) {
    frame["planes"][1]["map_plane"] = frame["planes"][0]["map_plane"];
    frame["planes"][1]["decision"] = "matched";
  });
  const CheckReport report = CheckFolder(run());
  ASSERT_EQ(report.faults.size(), 2u) << All(report);  // and what frame 2 then matches
  EXPECT_EQ(report.faults[0].line, 1);
  EXPECT_EQ(report.faults[0].pointer, "/planes/1/decision");
}

TEST_F(CheckRunFolder, NamesAPlaneThatIsMadeTwice) {
  EditLine(3, [](json& frame) { frame["planes"][0]["decision"] = "new"; });
  ExpectOnly("frame_planes.jsonl", 3, "/planes/0/decision", "made before");
}

TEST_F(CheckRunFolder, NamesVerticesInTheWorldFrame) {
  EditLine(2, [](json& frame) { frame["planes"][0]["vertices"] = {{0.1, 0.2, 5.0}}; });
  ExpectOnly("frame_planes.jsonl", 2, "/planes/0/vertices/0", "off its plane");
}

TEST_F(CheckRunFolder, NamesANumberThatIsNull) {
  EditLine(2, [](json& frame) { frame["planes"][0]["centroid"][1] = nullptr; });
  ExpectOnly("frame_planes.jsonl", 2, "/planes/0/centroid", "3 finite numbers");
}

TEST_F(CheckRunFolder, NamesASegmentationValueWithoutAPlane) {
  const std::string name = "segmentation/" + StampText(1.0) + ".png";
  cv::Mat labels = test_support::ReadImageFile(run() / name);
  labels.at<uchar>(3, 4) = 200;
  WriteImage(run() / name, labels);
  ExpectOnly(name, 0, "", "the value 200 in 1 pixels");
}

TEST_F(CheckRunFolder, NamesAPlaneThatWasLastSeenBeforeItWasFirstSeen) {
  EditJson("map.json", [](json& map) {
    map["planes"][1]["first_seen"] = 1.1;
    map["planes"][1]["last_seen"] = 1.0;
  });
  ExpectOnly("map.json", 0, "/planes/1/first_seen", "later than last_seen");
}

TEST_F(CheckRunFolder, NamesAMergeIntoAPlaneThatIsNotThere) {
  EditJson("map.json", [](json& map) { map["planes"][0]["merged_into"] = 77; });
  ExpectOnly("map.json", 0, "/planes/0/merged_into", "no plane of the map");
}

TEST_F(CheckRunFolder, NamesAMergeThatLeadsBackToItself) {
  EditJson("map.json",
           [](json& map) { map["planes"][0]["merged_into"] = map["planes"][0]["id"]; });
  ExpectOnly("map.json", 0, "/planes/0/merged_into", "back to the plane itself");
}

TEST_F(CheckRunFolder, NamesASplitFromAPlaneThatIsNotThere) {
  EditJson("map.json", [](json& map) { map["planes"][0]["split_from"] = 77; });
  ExpectOnly("map.json", 0, "/planes/0/split_from", "no plane of the map");
}

TEST_F(CheckRunFolder, NamesASplitThatLeadsBackToItself) {
  EditJson("map.json",
           [](json& map) { map["planes"][0]["split_from"] = map["planes"][0]["id"]; });
  ExpectOnly("map.json", 0, "/planes/0/split_from", "back to the plane itself");
}

TEST_F(CheckRunFolder, TakesASplitForWhatMadeThePlane) {
  // Without the split this is a match with a plane that nobody made.
  int id = 0;
  EditLine(1, [&](json& frame) {
    frame["planes"][0]["decision"] = "matched";
    id = frame["planes"][0]["map_plane"];
  });
  EditJson("map.json", [&](json& map) {
    for (json& plane : map["planes"]) {
      if (plane["id"] != id) continue;
      plane["split_from"] = map["planes"][plane == map["planes"][0] ? 1 : 0]["id"];
      plane["split_at"] = 1.0;
    }
  });
  const CheckReport report = CheckFolder(run());
  EXPECT_TRUE(report.faults.empty()) << All(report);
}

TEST_F(CheckRunFolder, NamesAHullThatIsOffItsPlane) {
  EditJson("map.json", [](json& map) {
    map["planes"][1]["hull"][2][2] = map["planes"][1]["hull"][2][2].get<double>() + 0.5;
    map["planes"][1]["hull"][2][1] = map["planes"][1]["hull"][2][1].get<double>() + 0.5;
  });
  ExpectOnly("map.json", 0, "/planes/1/hull/2", "off its plane");
}

TEST_F(CheckRunFolder, NamesATimingColumnThatIsMissing) {
  Edit(run() / "timing.csv", "epi", "plane");
  ExpectOnly("timing.csv", 1, "", "`epi`");
}

TEST_F(CheckRunFolder, NamesATimeThatIsNotFinite) {
  Edit(run() / "timing.csv", ",9,0,", ",inf,0,");
  ExpectOnly("timing.csv", 2, "", "orb is `inf`");
}

TEST_F(CheckRunFolder, NamesAPlyWithoutPlaneIds) {
  Edit(run() / "map.ply", "property int plane_id", "property int label");
  ExpectOnly("map.ply", 0, "", "`plane_id`");
}

TEST_F(CheckRunFolder, NamesAPlyThatIsCutOff) {
  const std::string text = ReadText(run() / "map.ply");
  WriteText(run() / "map.ply", text.substr(0, text.rfind('\n', text.size() - 2) + 1));
  const CheckReport report = CheckFolder(run());
  ASSERT_EQ(report.faults.size(), 1u) << All(report);
  EXPECT_THAT(report.faults[0].what, HasSubstr("ends or breaks at point"));
}

TEST_F(CheckRunFolder, TakesAPlyThatNamesOtherElementsBesidePoints) {
  Edit(run() / "map.ply", "end_header",
       "element face 0\nproperty list uchar int vertex_indices\nend_header");
  const CheckReport report = CheckFolder(run());
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
}

TEST_F(CheckRunFolder, NamesAPlyThatEndsWithItsHeader) {
  std::string header = ReadText(run() / "map.ply");
  header = header.substr(0, header.find("end_header") + 10);
  const auto format = header.find("ascii");
  for (const std::string& text : {header, header.substr(0, format) + "binary_little_endian" +
                                              header.substr(format + 5)}) {
    WriteText(run() / "map.ply", text);  // no end of the line
    ExpectOnly("map.ply", 0, "", "no complete PLY header");
  }
}

TEST_F(CheckRunFolder, NamesAPlyThatDoesNotCountItsPoints) {
  const std::string text = ReadText(run() / "map.ply");
  const auto at = text.find("element vertex ") + 15;
  for (const char* count : {"abc", "", "12x", "-1", "1.5"}) {
    WriteText(run() / "map.ply", text.substr(0, at) + count + text.substr(text.find('\n', at)));
    ExpectOnly("map.ply", 0, "", "no complete PLY header");
  }
}

TEST_F(CheckRunFolder, SaysThatANumberIsTooLarge) {
  Edit(run() / "frame_planes.jsonl", "\"pixels\":", "\"pixels\":3000000000,\"was\":");
  const CheckReport report = CheckFolder(run());
  ASSERT_GE(report.faults.size(), 1u);
  EXPECT_THAT(report.faults[0].what,
              ::testing::AllOf(HasSubstr("is 3000000000"), HasSubstr("to 2147483647")));
}

TEST_F(CheckRunFolder, NamesACameraOfHalfAPixel) {
  EditJson("run.json", [](json& run) { run["camera"]["width"] = 64.5; });
  const CheckReport report = CheckFolder(run());
  ASSERT_GE(report.faults.size(), 1u);
  EXPECT_THAT(report.faults[0].what, HasSubstr("whole number"));
}

TEST_F(CheckRunFolder, NamesANumberOfTheCameraThatIsMissingAmongOthers) {
  const json camera{{"width", 640}, {"height", 480}, {"fx", 525}, {"fy", 525},
                    {"cx", 319.5},  {"cy", 239.5},   {"fps", 30}, {"depth_factor", 5000}};
  EditJson("run.json", [&](json& document) { document["camera"] = camera; });
  EXPECT_EQ(CheckFolder(run()).faults.size(), 0u) << "a camera needs no lens";
  const auto lens = [](json& document) {
    for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) document["camera"][key] = 0.0;
  };
  for (const char* key : {"width", "p2"}) {
    EditJson("run.json",
             [&](json& document) { lens(document), document["camera"].erase(key); });
    ExpectOnly("run.json", 0, std::string("/camera/") + key, "is missing");
    EditJson("run.json", [&](json& document) { document["camera"] = camera; });
  }
}

TEST_F(CheckRunFolder, NamesACountOfRefusedPairsThatIsNone) {
  for (const json& value : {json("text"), json(nullptr), json(1e200), json(-1), json(0.5)}) {
    EditJson("run.json", [&](json& document) { document["refused_pairs"] = {{"iou", value}}; });
    ExpectOnly("run.json", 0, "/refused_pairs/iou", "is ");
  }
  EditJson("run.json", [](json& document) { document["refused_pairs"] = {{"iou", 7}}; });
  EXPECT_EQ(CheckFolder(run()).faults.size(), 0u) << All(CheckFolder(run()));
}

TEST_F(CheckRunFolder, NamesASeedThatNoSeedIs) {
  EditJson("run.json", [](json& document) { document["seed"] = 1e200; });
  ExpectOnly("run.json", 0, "/seed", "expected a whole number of 64 bits");
  EditJson("run.json", [](json& document) { document["seed"] = 18446744073709549568u; });
  EXPECT_EQ(CheckFolder(run()).faults.size(), 0u);
}

TEST_F(CheckRunFolder, NamesARunOfMoreFramesThanItsSequenceHas) {
  EditJson("run.json", [](json& document) { document["sequence_frames"] = 3; });
  ExpectOnly("run.json", 0, "/sequence_frames", "is 3, but the run has 4 frames");
}

TEST_F(CheckRunFolder, NamesAMapPlaneOfADecisionThatIsNone) {
  std::size_t plane = 0;
  EditLine(2, [&](json& frame) {
    while (frame["planes"][plane]["decision"] != "matched") ++plane;
    frame["planes"][plane]["decision"] = "none";
  });
  ExpectOnly("frame_planes.jsonl", 2, "/planes/" + std::to_string(plane) + "/map_plane",
             "but the decision is none");
}

TEST_F(CheckRunFolder, NamesAPlaneThatLacksAKeyWhichMayBeNull) {
  for (const char* key : {"class", "by"}) {
    const std::string lines = ReadText(run() / "frame_planes.jsonl");
    EditLine(2, [&](json& frame) { frame["planes"][0].erase(key); });
    ExpectOnly("frame_planes.jsonl", 2, std::string("/planes/0/") + key, "is missing");
    WriteText(run() / "frame_planes.jsonl", lines);
  }
}

TEST_F(CheckRunFolder, NamesPointsOfAPlaneThatTheMapDoesNotHave) {
  std::string text = ReadText(run() / "map.ply");
  const auto last = text.rfind(' ');
  WriteText(run() / "map.ply", text.substr(0, last) + " 123\n");
  ExpectOnly("map.ply", 0, "", "plane 123");
}

TEST_F(CheckRunFolder, RefusesACovarianceOfAPlaneThatIsNone) {
  const auto tell = [&](std::vector<double> upper) {
    EditJson("map.json", [&](json& map) { map["planes"][0]["covariance"] = upper; });
  };
  EditJson("map.json", [](json& map) {
    for (json& plane : map["planes"]) plane["covariance"] = std::vector<double>(10, 0.0);
  });
  tell(
      {1e-4, 0, 0, -2e-4, 1e-4, 0, -1e-4, 0, 0, 6e-4});  // n . x + d is known at (2, 1) to 1e-4
  EXPECT_EQ(CheckFolder(run()).faults.size(), 0u) << All(CheckFolder(run()));
  tell({1e-4, 0, 0, -2e-4, 1e-4, 0, -1e-4, 0, 0, 4e-4});
  ExpectOnly("map.json", 0, "/planes/0/covariance", "negative variance");
  tell({1e-4, 0, 0});
  ExpectOnly("map.json", 0, "/planes/0/covariance", "10");
}

TEST_F(CheckRunFolder, NamesAPlaneWithoutCovarianceAmongOthersThatHaveOne) {
  EditJson("map.json", [](json& map) {
    for (json& plane : map["planes"]) plane["covariance"] = std::vector<double>(10, 0.0);
    map["planes"][1]["covariance"] = nullptr;
  });
  ExpectOnly("map.json", 0, "/planes/1/covariance", "other planes have one");
}

}  // namespace
}  // namespace eval
