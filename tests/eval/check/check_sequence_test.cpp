#include "eval/check/check_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "eval/check/check_folder.h"
#include "tests/eval/check/checked_folder.h"
#include "tests/eval/check/small_world.h"
#include "tests/support/fault_text.h"
#include "tests/support/shared_data.h"

namespace eval {
namespace {

using namespace small_world;
using ::testing::HasSubstr;

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

TEST_F(CheckSequenceFolder, NamesNegativeTimesOnceForAFile) {
  fs::remove_all(seq() / "gt");
  for (const char* file : {"associations.txt", "detections.jsonl", "manifest.json"}) {
    fs::remove(seq() / file);
  }
  for (const char* file : {"rgb.txt", "depth.txt", "groundtruth.txt"}) {
    std::istringstream in(ReadText(seq() / file));
    std::string out, stamp, rest;
    while (in >> stamp && std::getline(in, rest)) {
      out += stamp == "#" ? "" : StampText(std::stod(stamp) - 1000) + rest + "\n";
    }
    WriteText(seq() / file, out);
  }
  const CheckReport report = CheckFolder(seq());
  ASSERT_EQ(report.faults.size(), 3u) << All(report);
  for (const Fault& fault : report.faults) {
    EXPECT_THAT(fault.what, HasSubstr("has negative time stamps, such as -"));
  }
}

TEST_F(CheckSequenceFolder, NamesColourAndDepthThatAreTooFarApartWhicheverComesFirst) {
  const std::string pairs = ReadText(seq() / "associations.txt"),
                    depth = ReadText(seq() / "depth.txt");
  for (const double later_s : {-0.025, -0.015, 0.015, 0.025}) {
    const std::string stamp = StampText(std::stod(Stamp(1)) + later_s);
    const std::string was = Stamp(1) + " depth/", is = stamp + " depth/";
    WriteText(seq() / "associations.txt", pairs);
    WriteText(seq() / "depth.txt", depth);
    Edit(seq() / "associations.txt", was, is);
    EditSequence("depth.txt", was, is);
    if (std::abs(later_s) > 0.02) {
      ExpectOnly("associations.txt", 2, "", "25.0 ms apart");
    } else {
      EXPECT_TRUE(CheckFolder(seq()).faults.empty()) << All(CheckFolder(seq()));
    }
  }
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
  const std::string colour = "rgb/" + Stamp(1) + ".png", depth = "depth/" + Stamp(1) + ".png";
  const cv::Mat was = cv::imread((seq() / colour).string());
  cv::Mat deep;
  was.convertTo(deep, CV_16U, 257);
  cv::imwrite((seq() / colour).string(), deep);
  Renew();
  ExpectOnly(colour, 0, "", "is 16-bit with 3 channels; expected 8-bit RGB or gray");
  cv::imwrite((seq() / colour).string(), was);
  cv::imwrite((seq() / depth).string(), was);
  Renew();
  ExpectOnly(depth, 0, "", "is 8-bit with 3 channels; expected 16-bit with 1 channel");
}

TEST_F(CheckSequenceFolder, TakesColourThatIsGrayOrHasAlpha) {
  for (const int code : {cv::COLOR_BGR2GRAY, cv::COLOR_BGR2BGRA}) {
    const fs::path file = seq() / ("rgb/" + Stamp(code == cv::COLOR_BGR2GRAY ? 1 : 2) + ".png");
    cv::Mat other;
    cv::cvtColor(cv::imread(file.string()), other, code);
    cv::imwrite(file.string(), other);
  }
  Renew();
  EXPECT_EQ(CheckFolder(seq()).faults.size(), 0u) << All(CheckFolder(seq()));
}

// ICL-NUIM has associations.txt alone.
TEST_F(CheckSequenceFolder, NeedsNoListsBesideAssociations) {
  for (const char* file : {"gt", "manifest.json", "rgb.txt", "depth.txt"})
    fs::remove_all(seq() / file);
  const CheckReport report = CheckFolder(seq());
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
  EXPECT_EQ(report.frames, 4);
  fs::remove(seq() / ("depth/" + Stamp(2) + ".png"));
  ExpectOnly("associations.txt", 3, "", "does not exist");
}

TEST_F(CheckSequenceFolder, NamesAnImageThatWasCutOff) {
  const std::string name = "depth/" + Stamp(3) + ".png";
  const std::string bytes = ReadText(seq() / name);
  WriteText(seq() / name, bytes.substr(0, bytes.size() / 2));
  Renew();
  ExpectOnly(name, 0, "", "not a whole PNG");
}

TEST_F(CheckSequenceFolder, TakesColourAsJpegAndDepthAsNothingButPng) {
  const std::string colour = "rgb/" + Stamp(1) + ".png", depth = "depth/" + Stamp(1) + ".png";
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", cv::imread((seq() / colour).string()), jpeg);
  WriteText(seq() / colour, std::string(jpeg.begin(), jpeg.end()));
  Renew();
  EXPECT_EQ(CheckFolder(seq()).faults.size(), 0u) << All(CheckFolder(seq()));
  WriteText(seq() / colour, std::string(jpeg.begin(), jpeg.end() - 20));
  Renew();
  ExpectOnly(colour, 0, "", "is not a whole PNG or JPEG file");
  WriteText(seq() / colour, std::string(jpeg.begin(), jpeg.end()));
  WriteText(seq() / depth, std::string(jpeg.begin(), jpeg.end()));
  Renew();
  ExpectOnly(depth, 0, "", "is not a whole PNG file");
}

TEST_F(CheckSequenceFolder, NamesAnImageOfAnotherSizeThanTheCameraTells) {
  const std::string name = "rgb/" + Stamp(0) + ".png";
  WriteImage(seq() / name, cv::Mat::zeros(20, 30, CV_8UC3));
  Renew();
  ExpectOnly(name, 0, "", "is 30 x 20; expected 64 x 48");
  WriteImage(seq() / name, cv::Mat::zeros(64, 48, CV_8UC3));  // as many pixels, upright
  Renew();
  ExpectOnly(name, 0, "", "is 48 x 64; expected 64 x 48");
}

TEST_F(CheckSequenceFolder, NamesACameraKeyOutOfRange) {
  EditSequence("camera.yaml", "fps: 30", "fps: 0");
  ExpectOnly("camera.yaml", 8, "",
             "fps: expected a number in (0, 1e9) (frames per second), found `0`");
}

TEST_F(CheckSequenceFolder, NamesACameraKeyThatIsMissing) {
  EditSequence("camera.yaml", "depth_factor", "depth_scale");
  ExpectOnly("camera.yaml", 1, "", "key `depth_factor` is missing");
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

TEST_F(CheckSequenceFolder, NamesAFileThatHasChangedSinceItWasWritten) {
  Edit(seq() / "detections.jsonl", "0.9", "0.8");
  ExpectOnly("detections.jsonl", 0, "", "sha256 differs");
}

// What an earlier sequence left there: a reader that lists the folder would take it for a frame.
TEST_F(CheckSequenceFolder, NamesAnImageThatTheManifestDoesNotListAndNoFileOfOthers) {
  WriteText(seq() / "notes.txt", "mine");
  WriteText(seq() / "rgb/thumbs.db", "some program's");
  EXPECT_TRUE(CheckFolder(seq()).faults.empty()) << All(CheckFolder(seq()));
  for (const std::string folder : {"rgb/", "depth/", "gt/plane_id/", "gt/object_id/"}) {
    const std::string stale = folder + "0.500000.png";
    fs::copy_file(seq() / (folder + Stamp(0) + ".png"), seq() / stale);
    ExpectOnly(stale, 0, "", "is not in manifest.json");
    fs::remove(seq() / stale);
  }
}

TEST_F(CheckSequenceFolder, NamesAManifestThatIsNotComplete) {
  Edit(seq() / "manifest.json", "\"complete\": true", "\"complete\": false");
  ExpectOnly("manifest.json", 0, "/complete", "not finished");
}

TEST_F(CheckSequenceFolder, NamesAFrameCountThatTheListsDoNotHave) {
  Edit(seq() / "manifest.json", "\"frames\": 4", "\"frames\": 5");
  ExpectOnly("manifest.json", 0, "/frames", "the lists give 4");
}

TEST_F(CheckSequenceFolder, NamesAFormatOfAnotherVersion) {
  Edit(seq() / "manifest.json", "pas-sequence/1", "pas-sequence/2");
  ExpectOnly("manifest.json", 0, "/format", "expected pas-sequence/1");
}

TEST(CheckFolderKind, TellsAFolderThatIsNeitherSequenceNorRun) {
  const TemporaryFolder folder;
  const CheckReport report = CheckFolder(folder.path());
  ASSERT_EQ(report.faults.size(), 1u);
  EXPECT_THAT(report.faults[0].what, HasSubstr("neither a sequence"));
  EXPECT_EQ(CheckFolder(folder.path() / "absent").faults.size(), 1u);
}

TEST(CheckFolderKind, FindsNoFaultInARealRecordingAsDownloaded) {
  const fs::path folder = test_support::TumRecording();
  SKIP_WITHOUT(folder);
  const CheckReport report = CheckFolder(folder);
  EXPECT_EQ(report.faults.size(), 0u) << All(report);
  EXPECT_EQ(report.frames, 37);
}

}  // namespace
}  // namespace eval
