#include "eval/check/check_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <opencv2/imgproc.hpp>

#include "eval/check/check_folder.h"
#include "tests/eval/check/small_world.h"
#include "tests/support/fault_text.h"

namespace eval {
namespace {

using namespace small_world;
using ::testing::HasSubstr;

class CheckSequenceFolder : public ::testing::Test {
 protected:
  CheckSequenceFolder()
      : folder_("check_" +
                std::string(::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    WriteSequence(seq(), world_);
  }
  fs::path seq() const { return folder_.path() / "seq"; }
  std::string Stamp(int frame) const {
    return StampText(world_.views[static_cast<std::size_t>(frame)].stamp_s);
  }
  /// Changes a file and renews the manifest, so that only the change itself is at fault.
  void EditSequence(const std::string& file, const std::string& from, const std::string& to) {
    Edit(seq() / file, from, to);
    Renew();
  }
  void Renew() { WriteManifest(seq(), static_cast<int>(world_.views.size())); }
  void EditJson(const std::string& file, const std::function<void(json&)>& edit) {
    json document = json::parse(ReadText(seq() / file));
    edit(document);
    WriteText(seq() / file, document.dump(1));
    Renew();
  }
  void EditFrame(int line, const std::function<void(json&)>& edit) {
    std::istringstream in(ReadText(seq() / "gt/frames.jsonl"));
    std::string out, text;
    for (int i = 1; std::getline(in, text); ++i) {
      json record = json::parse(text);
      if (i == line) edit(record);
      out += record.dump() + "\n";
    }
    WriteText(seq() / "gt/frames.jsonl", out);
    Renew();
  }
  /// Exactly one fault, in this place, that says this.
  void ExpectOnly(const std::string& file, int line, const std::string& pointer,
                  const std::string& what) {
    const CheckReport report = CheckFolder(seq());
    ASSERT_EQ(report.faults.size(), 1u) << All(report);
    const Fault& fault = report.faults[0];
    EXPECT_EQ(fault.file, file) << All(report);
    EXPECT_EQ(fault.line, line) << All(report);
    EXPECT_EQ(fault.pointer, pointer) << All(report);
    EXPECT_THAT(fault.what, HasSubstr(what));
    EXPECT_FALSE(fault.mend.empty());
  }

  TemporaryFolder folder_;
  World world_ = MakeWorld();
};

TEST_F(CheckSequenceFolder, FindsNoFaultInAFaultlessOne) {
  const CheckReport report = CheckFolder(seq());
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
  EXPECT_EQ(report.kind, "sequence");
  EXPECT_EQ(report.frames, 4);
  EXPECT_EQ(report.files, 9 + 4 * 4);
}

TEST_F(CheckSequenceFolder, FindsNoFaultWithoutAnythingThatIsOptional) {
  for (const char* file : {"gt", "manifest.json", "camera.yaml", "detections.jsonl",
                           "associations.txt", "groundtruth.txt"}) {
    fs::remove_all(seq() / file);
  }
  const CheckReport report = CheckFolder(seq());
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
}

TEST_F(CheckSequenceFolder, ListsEveryFaultAndNotOnlyTheFirst) {
  Edit(seq() / "rgb.txt", Stamp(1) + " rgb", "later rgb");
  Edit(seq() / "camera.yaml", "fps: 30", "fps: -1");
  Edit(seq() / "gt/scene.json", "\"regular\": true", "\"regular\": 7");
  const CheckReport report = CheckFolder(seq());
  const std::string text = All(report);
  EXPECT_THAT(text, HasSubstr("rgb.txt:3"));
  EXPECT_THAT(text, HasSubstr("camera.yaml:8"));
  EXPECT_THAT(text, HasSubstr("/objects/0/regular"));
  EXPECT_THAT(text, HasSubstr("sha256"));
}

TEST_F(CheckSequenceFolder, NamesTheLineThatIsNoListEntry) {
  fs::remove(seq() / "associations.txt");
  Edit(seq() / "depth.txt", Stamp(0) + " ", Stamp(0) + " and ");
  Renew();
  const CheckReport report = CheckFolder(seq());
  ASSERT_EQ(report.faults.size(), 1u) << All(report);
  EXPECT_EQ(report.faults[0].file, "depth.txt");
  EXPECT_EQ(report.faults[0].line, 1);
}

TEST_F(CheckSequenceFolder, NamesAListedImageThatIsMissing) {
  fs::remove(seq() / ("rgb/" + Stamp(2) + ".png"));
  Renew();
  ExpectOnly("rgb.txt", 4, "", "does not exist");
}

TEST_F(CheckSequenceFolder, NamesStampsThatDoNotIncrease) {
  fs::remove(seq() / "associations.txt");
  fs::remove_all(seq() / "gt");
  Edit(seq() / "groundtruth.txt", Stamp(1), Stamp(0));
  Renew();
  ExpectOnly("groundtruth.txt", 3, "", "increase strictly");
}

TEST_F(CheckSequenceFolder, NamesStampsInNanoseconds) {
  fs::remove_all(seq() / "gt");
  std::string poses;
  for (const View& view : world_.views) {
    std::string line = TumLine(view.stamp_s, view.T_wc);
    poses += std::to_string(std::lround(view.stamp_s * 1e9)) + line.substr(line.find(' '));
  }
  WriteText(seq() / "groundtruth.txt", poses);
  Renew();
  ExpectOnly("groundtruth.txt", 0, "", "not seconds");
}

TEST_F(CheckSequenceFolder, NamesAnImageOfTheWrongType) {
  const fs::path file = seq() / ("rgb/" + Stamp(1) + ".png");
  cv::Mat grey;
  cv::cvtColor(cv::imread(file.string()), grey, cv::COLOR_BGR2GRAY);
  WriteImage(file, grey);
  Renew();
  ExpectOnly("rgb/" + Stamp(1) + ".png", 0, "", "expected 8-bit with 3 channels");
}

TEST_F(CheckSequenceFolder, NamesAnImageThatWasCutOff) {
  const std::string name = "depth/" + Stamp(3) + ".png";
  const std::string bytes = ReadText(seq() / name);
  WriteText(seq() / name, bytes.substr(0, bytes.size() / 2));
  Renew();
  ExpectOnly(name, 0, "", "not a whole PNG");
}

TEST_F(CheckSequenceFolder, NamesAnImageOfAnotherSizeThanTheCameraTells) {
  const std::string name = "rgb/" + Stamp(0) + ".png";
  WriteImage(seq() / name, cv::Mat::zeros(20, 30, CV_8UC3));
  Renew();
  ExpectOnly(name, 0, "", "is 30 x 20; expected 64 x 48");
}

TEST_F(CheckSequenceFolder, NamesACameraKeyOutOfRange) {
  EditSequence("camera.yaml", "fps: 30", "fps: 0");
  ExpectOnly("camera.yaml", 8, "", "fps is 0; expected more than 0");
}

TEST_F(CheckSequenceFolder, NamesACameraKeyThatIsMissing) {
  EditSequence("camera.yaml", "depth_factor", "depth_scale");
  ExpectOnly("camera.yaml", 0, "", "depth_factor is missing");
}

TEST_F(CheckSequenceFolder, NamesAQuaternionThatIsNotUnit) {
  fs::remove_all(seq() / "gt");
  WriteText(seq() / "groundtruth.txt", "# truth\n1.0 0 0 0 0 0 0 1\n1.1 0 0 0 0 0 0.5 1\n");
  Renew();
  ExpectOnly("groundtruth.txt", 3, "", "length 1.118034");
}

TEST_F(CheckSequenceFolder, NamesAPoseWithANumberThatIsNotFinite) {
  fs::remove_all(seq() / "gt");
  WriteText(seq() / "groundtruth.txt", "1.0 0 nan 0 0 0 0 1\n1.1 0 0 0 0 0 0 1\n");
  Renew();
  ExpectOnly("groundtruth.txt", 1, "", "eight finite numbers");
}

TEST_F(CheckSequenceFolder, NamesABoxWithItsCornersSwapped) {
  WriteText(seq() / "detections.jsonl", "{\"timestamp\": " + Stamp(0) +
                                            ", \"detections\": [{\"class\": \"book\", "
                                            "\"score\": 0.9, \"box\": [30, 5, 10, 9]}]}\n");
  Renew();
  ExpectOnly("detections.jsonl", 1, "/detections/0/box", "x0 < x1");
}

TEST_F(CheckSequenceFolder, NamesABoxThatLeavesTheImageAndAScoreAboveOne) {
  WriteText(seq() / "detections.jsonl", "{\"timestamp\": " + Stamp(0) +
                                            ", \"detections\": [{\"class\": \"book\", "
                                            "\"score\": 90, \"box\": [3, 5, 10, 90]}]}\n");
  Renew();
  const CheckReport report = CheckFolder(seq());
  ASSERT_EQ(report.faults.size(), 2u) << All(report);
  EXPECT_EQ(report.faults[0].pointer, "/detections/0/score");
  EXPECT_EQ(report.faults[1].pointer, "/detections/0/box");
}

TEST_F(CheckSequenceFolder, NamesDetectionsOfATimeThatIsNoFrame) {
  WriteText(seq() / "detections.jsonl", "{\"timestamp\": 77.5, \"detections\": []}\n");
  Renew();
  ExpectOnly("detections.jsonl", 1, "/timestamp", "no time of rgb.txt");
}

TEST_F(CheckSequenceFolder, NamesALineThatIsNoJson) {
  WriteText(seq() / "detections.jsonl", "{\"timestamp\": 1,\n");
  Renew();
  ExpectOnly("detections.jsonl", 1, "", "not valid JSON");
}

TEST_F(CheckSequenceFolder, NamesAnUnknownRole) {
  EditJson("gt/scene.json", [](json& scene) { scene["objects"][1]["role"] = "prop"; });
  ExpectOnly("gt/scene.json", 0, "/objects/1/role", "no role");
}

TEST_F(CheckSequenceFolder, NamesAnIdThatIsUsedTwice) {
  EditJson("gt/scene.json", [](json& scene) { scene["planes"].push_back(scene["planes"][5]); });
  ExpectOnly("gt/scene.json", 0, "/planes/24/id", "second time");
}

TEST_F(CheckSequenceFolder, NamesANormalThatIsNotUnit) {
  EditJson("gt/scene.json", [](json& scene) {
    scene["planes"][0]["normal"] = {-1.0, 0.0, 0.1};
  });
  ExpectOnly("gt/scene.json", 0, "/planes/0/normal", "expected 1");
}

TEST_F(CheckSequenceFolder, NamesANormalThatPointsIntoItsObject) {
  // A hidden face, so that no image sees the difference.
  EditJson("gt/scene.json", [](json& scene) {
    json& plane = scene["planes"][4];
    for (json& v : plane["normal"]) v = -v.get<double>();
    plane["d"] = -plane["d"].get<double>();
  });
  ExpectOnly("gt/scene.json", 0, "/planes/4/normal", "into the object");
}

TEST_F(CheckSequenceFolder, NamesCornersOffTheirPlane) {
  EditJson("gt/scene.json", [](json& scene) {
    scene["planes"][4]["d"] = scene["planes"][4]["d"].get<double>() + 0.001;
  });
  const CheckReport report = CheckFolder(seq());
  ASSERT_EQ(report.faults.size(), 4u) << All(report);
  EXPECT_EQ(report.faults[2].pointer, "/planes/4/vertices/2");
  EXPECT_THAT(report.faults[2].what, HasSubstr("off the plane"));
}

TEST_F(CheckSequenceFolder, NamesCornersThatAreNotInOrder) {
  EditJson("gt/scene.json", [](json& scene) {
    std::swap(scene["planes"][4]["vertices"][1], scene["planes"][4]["vertices"][2]);
  });
  ExpectOnly("gt/scene.json", 0, "/planes/4/vertices", "no rectangle");
}

TEST_F(CheckSequenceFolder, NamesAnAreaThatTheCornersDoNotEnclose) {
  EditJson("gt/scene.json", [](json& scene) { scene["planes"][4]["area"] = 0.5; });
  ExpectOnly("gt/scene.json", 0, "/planes/4/area", "enclose 1.12");
}

TEST_F(CheckSequenceFolder, NamesAPlaneOfAnObjectThatDoesNotExist) {
  EditJson("gt/scene.json", [](json& scene) { scene["planes"][4]["object"] = 9; });
  ExpectOnly("gt/scene.json", 0, "/planes/4/object", "no id of an object");
}

TEST_F(CheckSequenceFolder, NamesHalfLengthsGivenAsSize) {
  EditJson("gt/scene.json", [](json& scene) {
    for (json& length : scene["objects"][3]["size"]) length = length.get<double>() / 2;
  });
  const CheckReport report = CheckFolder(seq());
  ASSERT_EQ(report.faults.size(), 6u) << All(report);  // each face of the object
  EXPECT_THAT(report.faults[0].what, HasSubstr("outside the box"));
}

TEST_F(CheckSequenceFolder, NamesAPixelCountThatTheIdImageDoesNotShow) {
  EditFrame(2, [](json& frame) {
    frame["planes"][0]["pixels"] = frame["planes"][0]["pixels"].get<int>() + 1;
  });
  ExpectOnly("gt/frames.jsonl", 2, "/planes/0/pixels", "shows");
}

TEST_F(CheckSequenceFolder, NamesAVisibleBoxThatTheIdImageDoesNotShow) {
  EditFrame(3, [](json& frame) { frame["objects"][1]["visible_box"][2] = 60; });
  ExpectOnly("gt/frames.jsonl", 3, "/objects/1/visible_box", "the id image shows");
}

TEST_F(CheckSequenceFolder, NamesAPlaneThatIsSeenButNotListed) {
  EditFrame(1, [](json& frame) { frame["planes"].erase(0); });
  ExpectOnly("gt/frames.jsonl", 1, "/planes", "lacks id");
}

TEST_F(CheckSequenceFolder, NamesAFrameWithoutTruth) {
  std::string text = ReadText(seq() / "gt/frames.jsonl");
  WriteText(seq() / "gt/frames.jsonl", text.substr(text.find('\n') + 1));
  Renew();
  ExpectOnly("gt/frames.jsonl", 0, "", "lacks the frame 1.000000");
}

TEST_F(CheckSequenceFolder, NamesPixelsWhoseObjectDoesNotOwnTheirPlane) {
  EditJson("gt/scene.json", [](json& scene) {
    // The hidden underside of the desk keeps its owner; the seen top of the book gets the
    // bear's.
    scene["planes"][11]["object"] = 4;
  });
  const CheckReport report = CheckFolder(seq());
  ASSERT_EQ(report.faults.size(), 2u + 4u) << All(report);
  EXPECT_EQ(report.faults[0].pointer, "/planes/11/normal");
  EXPECT_EQ(report.faults[1].pointer, "/planes/11/vertices/0");
  EXPECT_EQ(report.faults[2].file, "gt/plane_id/" + Stamp(0) + ".png");
  EXPECT_THAT(report.faults[2].what, HasSubstr("whose object is not"));
}

TEST_F(CheckSequenceFolder, NamesAFileThatHasChangedSinceItWasWritten) {
  Edit(seq() / "detections.jsonl", "0.9", "0.8");
  ExpectOnly("detections.jsonl", 0, "", "sha256 differs");
}

TEST_F(CheckSequenceFolder, NamesAManifestThatIsNotComplete) {
  Edit(seq() / "manifest.json", "\"complete\": true", "\"complete\": false");
  ExpectOnly("manifest.json", 0, "/complete", "not finished");
}

TEST_F(CheckSequenceFolder, NamesAFrameCountThatTheListsDoNotHave) {
  Edit(seq() / "manifest.json", "\"frames\": 4", "\"frames\": 5");
  ExpectOnly("manifest.json", 0, "/frames", "rgb.txt lists 4");
}

TEST_F(CheckSequenceFolder, NamesAFormatOfAnotherVersion) {
  Edit(seq() / "manifest.json", "pas-sequence/1", "pas-sequence/2");
  ExpectOnly("manifest.json", 0, "/format", "expected pas-sequence/1");
}

// The mistakes that cost users of such data most time.
class CheckDepthAgainstTruth : public CheckSequenceFolder {
 protected:
  void ExpectExplained(const std::string& explanation) {
    Renew();
    ExpectOnly("depth.txt", 0, "", "in 4 of 4 frames");
    EXPECT_THAT(CheckFolder(seq()).faults.at(0).mend, HasSubstr(explanation));
  }
};

TEST_F(CheckDepthAgainstTruth, NamesDepthAlongTheRay) {
  for (int i = 0; i < 4; ++i) {
    const fs::path file = seq() / ("depth/" + Stamp(i) + ".png");
    cv::Mat depth = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        const double u = (x - world_.cx()) / world_.focal_px,
                     v = (y - world_.cy()) / world_.focal_px;
        depth.at<ushort>(y, x) =
            cv::saturate_cast<ushort>(depth.at<ushort>(y, x) * std::sqrt(1 + u * u + v * v));
      }
    }
    WriteImage(file, depth);
  }
  ExpectExplained("length of the ray");
}

TEST_F(CheckDepthAgainstTruth, NamesPosesThatAreInverted) {
  std::string poses;
  for (const View& view : world_.views) poses += TumLine(view.stamp_s, view.T_wc.inverse());
  WriteText(seq() / "groundtruth.txt", poses);
  ExpectExplained("world to camera");
}

TEST_F(CheckDepthAgainstTruth, NamesAWrongDepthFactor) {
  Edit(seq() / "camera.yaml", "depth_factor: 5000", "depth_factor: 1000");
  ExpectExplained("5 times too large");
}

TEST_F(CheckDepthAgainstTruth, NamesAFocalLengthThatIsTenPercentOff) {
  Edit(seq() / "camera.yaml", "fy: 57.6", "fy: 63.4");
  ExpectExplained("check the poses");
}

TEST_F(CheckDepthAgainstTruth, NamesTheOneImageThatWasSwapped) {
  const std::string name = "depth/" + Stamp(2) + ".png";
  fs::copy_file(seq() / ("depth/" + Stamp(0) + ".png"), seq() / name,
                fs::copy_options::overwrite_existing);
  Renew();
  ExpectOnly(name, 0, "", "off the depth that the truth predicts");
}

TEST(CheckFolderKind, TellsAFolderThatIsNeitherSequenceNorRun) {
  const TemporaryFolder folder("neither");
  const CheckReport report = CheckFolder(folder.path());
  ASSERT_EQ(report.faults.size(), 1u);
  EXPECT_THAT(report.faults[0].what, HasSubstr("neither a sequence"));
  EXPECT_EQ(CheckFolder(folder.path() / "absent").faults.size(), 1u);
}

TEST(CheckFolderKind, FindsNoFaultInARealRecordingAsDownloaded) {
  const char* shared = std::getenv("PAS_SHARED_DIR");
  const fs::path data = fs::path(shared != nullptr ? shared : PAS_SOURCE_DIR "/../shared") /
                        "data/tum_fr1_xyz_first37";
  if (!fs::is_directory(data)) GTEST_SKIP() << "no recording at " << data;
  const CheckReport report = CheckFolder(data);
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
  EXPECT_EQ(report.frames, 37);
}

}  // namespace
}  // namespace eval
