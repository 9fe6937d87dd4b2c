#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "eval/check/check_truth_depth.h"
#include "tests/eval/check/checked_folder.h"
#include "tests/eval/check/small_world.h"
#include "tests/support/fault_text.h"
#include "tests/support/image_files.h"

namespace eval {
namespace {

using namespace small_world;
using ::testing::HasSubstr;

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

// Its sides are parallel and its area is that of its corners, which lie in the object's box.
TEST_F(CheckSequenceFolder, NamesAFaceWhoseSidesAreNotSquareToEachOther) {
  constexpr double kSheared_m = 0.1;
  EditJson("gt/scene.json", [](json& scene) {
    json& plane = scene["planes"][4];  // the table's hidden underside, 0.8 m wide
    ASSERT_EQ(plane["normal"][2].get<double>(), -1.0);
    json& corners = plane["vertices"];
    const int along = corners[0][0] == corners[1][0] ? 1 : 0;
    const double side_m = corners[1][along].get<double>() - corners[0][along].get<double>();
    const double step_m = std::copysign(kSheared_m, side_m);
    corners[0][along] = corners[0][along].get<double>() + step_m;
    corners[2][along] = corners[2][along].get<double>() - step_m;
    plane["area"] = plane["area"].get<double>() * (1 - kSheared_m / std::abs(side_m));
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

TEST_F(CheckSequenceFolder, NamesALengthThatIsNoneAndAPlaceThatIsFarOff) {
  const auto pointers = [&] {
    std::set<std::string> all;
    for (const Fault& fault : CheckFolder(seq()).faults) all.insert(fault.pointer);
    return all;
  };
  EditJson("gt/scene.json", [](json& scene) { scene["objects"][3]["size"][2] = 0; });
  EXPECT_EQ(pointers().count("/objects/3/size"), 1u);
  for (const double x : {-1e9, 1e9}) {
    EditJson("gt/scene.json", [&](json& scene) { scene["objects"][2]["center"][0] = x; });
    EXPECT_EQ(pointers().count("/objects/2/center"), 1u) << x;
  }
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

TEST_F(CheckSequenceFolder, ComparesFramesByTheirTimeInAnyOrderOfTheList) {
  std::istringstream in(ReadText(seq() / "rgb.txt"));
  std::string backwards;
  for (std::string line; std::getline(in, line);) backwards.insert(0, line + "\n");
  WriteText(seq() / "rgb.txt", backwards);
  Renew();
  const CheckReport report = CheckFolder(seq());
  for (const Fault& fault : report.faults) EXPECT_EQ(fault.file, "rgb.txt") << All(report);
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

TEST_F(CheckSequenceFolder, ChecksIdImagesWithoutTheListsOfFramesToo) {
  fs::remove(seq() / "gt/frames.jsonl");
  Renew();
  EXPECT_TRUE(CheckFolder(seq()).faults.empty()) << All(CheckFolder(seq()));
  const std::string planes = "gt/plane_id/" + Stamp(0) + ".png";
  WriteText(seq() / planes, "junk");
  Renew();
  ExpectOnly(planes, 0, "", "PNG");
  fs::remove(seq() / planes);
  Renew();
  ExpectOnly(planes, 0, "", "is missing");
  fs::remove_all(seq() / "gt/plane_id");
  Renew();
  EXPECT_TRUE(CheckFolder(seq()).faults.empty()) << All(CheckFolder(seq()));
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
    cv::Mat depth = test_support::ReadImageFile(file);
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

// An ideal sensor is off by its rounding alone, but not where it is told a wrong calibration.
TEST_F(CheckDepthAgainstTruth, AllowsMoreWhereTheCalibrationWasGivenAnError) {
  for (int i = 0; i < 4; ++i) {
    const fs::path file = seq() / ("depth/" + Stamp(i) + ".png");
    cv::Mat depth = test_support::ReadImageFile(file);
    depth.convertTo(depth, CV_16U, 1.003);
    WriteImage(file, depth);
  }
  Renew();
  ExpectOnly("depth.txt", 0, "", "in 4 of 4 frames");
  Edit(seq() / "manifest.json", "\"sensor\"",
       "\"calibration_error\": {\"registration_px\": 1.5}, \"sensor\"");
  EXPECT_TRUE(CheckFolder(seq()).faults.empty()) << All(CheckFolder(seq()));
}

TEST_F(CheckDepthAgainstTruth, NamesTheOneImageThatWasSwapped) {
  const std::string name = "depth/" + Stamp(2) + ".png";
  fs::copy_file(seq() / ("depth/" + Stamp(0) + ".png"), seq() / name,
                fs::copy_options::overwrite_existing);
  Renew();
  ExpectOnly(name, 0, "", "off the depth that the truth predicts");
}

// As noise makes it: each frame has another scale, and two have a fault of another kind.
TEST_F(CheckDepthAgainstTruth, NamesAWrongDepthFactorWhoseSizeDiffersFromFrameToFrame) {
  world_ = MakeWorld(64, 48, 5);
  WriteSequence(seq(), world_);
  const std::array<double, 5> scales{5.0, 4.9, 5.1, 1.0, 1.0};
  for (std::size_t i = 0; i < scales.size(); ++i) {
    cv::Mat depth = Render(world_, world_.views[i]).depth;
    depth.convertTo(depth, CV_16U, scales[i]);
    for (int x = 0; x < depth.cols && scales[i] == 1.0; ++x) {
      cv::Mat column = depth.col(x);
      column.convertTo(column, CV_16U, 1.0 + double(x) / depth.cols);
    }
    WriteImage(seq() / ("depth/" + Stamp(static_cast<int>(i)) + ".png"), depth);
  }
  Renew();
  ExpectOnly("depth.txt", 0, "", "in 5 of 5 frames");
  EXPECT_THAT(CheckFolder(seq()).faults.at(0).mend, HasSubstr("mend depth_factor"));
}

TEST(RaysOf, GivesBackTheRayAtTheRimOfALensThatBendsMuch) {
  const Camera camera{640, 480, 525, 525, 319.5, 239.5, 30, 1000, {-0.25, 0, 0, 0, 0}};
  const Vector3d ray_c(0.84, 0.63, 1);  // the model folds back at 1.15
  const Eigen::Vector2d pixel = PixelOf(camera, ray_c);
  EXPECT_LT((RaysOf(camera, {{pixel.x(), pixel.y()}}).at(0) - ray_c).norm(), 1e-3);
}

}  // namespace
}  // namespace eval
