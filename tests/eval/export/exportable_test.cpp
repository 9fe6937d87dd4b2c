#include "eval/export/exportable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"
#include "tests/eval/check/small_world.h"
#include "tests/support/image_files.h"

namespace eval {
namespace {

using namespace small_world;

TEST(ReadCheckedObjectIds, RefusesAnUnknownIdWhereverItStands) {
  const TemporaryFolder folder;
  const World world = MakeWorld();
  WriteSequence(folder.path() / "seq", world);
  const double stamp_s = world.views[0].stamp_s;
  const fs::path file = folder.path() / "seq/gt/object_id" / (StampText(stamp_s) + ".png");
  cv::Mat whole = test_support::ReadImageFile(file);
  EXPECT_NO_THROW(ReadCheckedObjectIds(ReadSequence(folder.path() / "seq"), stamp_s));
  // The last of objects 1 to 4 becomes 40: unknown ids lie between known ones and above them.
  json scene = json::parse(ReadText(folder.path() / "seq/gt/scene.json"));
  scene["objects"][3]["id"] = 40;
  for (json& plane : scene["planes"])
    if (plane["object"] == 4) plane["object"] = 40;
  WriteText(folder.path() / "seq/gt/scene.json", scene.dump());
  fs::remove(folder.path() / "seq/gt/frames.jsonl");
  whole.setTo(40, whole == 4);
  ASSERT_GT(cv::countNonZero(whole == 40), 0);
  WriteImage(file, whole);
  EXPECT_NO_THROW(ReadCheckedObjectIds(ReadSequence(folder.path() / "seq"), stamp_s));
  for (const int unknown : {5, 60000}) {
    for (const int v : {0, whole.rows / 2, whole.rows - 1}) {
      cv::Mat ids = whole.clone();
      ids.at<ushort>(v, whole.cols / 2) = static_cast<ushort>(unknown);
      WriteImage(file, ids);
      EXPECT_THROW(ReadCheckedObjectIds(ReadSequence(folder.path() / "seq"), stamp_s),
                   io::InputError)
          << unknown << " in row " << v;
    }
  }
}

// Masks, boxes and poses are of one instant; who trains on them has to know where colour is not.
TEST(ReadExportable, WarnsOfARollingShutter) {
  const auto warnings = [](const char* exposure) {
    const TemporaryFolder folder;
    WriteSequence(folder.path(), MakeWorld());
    json manifest = json::parse(ReadText(folder.path() / "manifest.json"));
    manifest["exposure"] = json::parse(exposure);
    WriteText(folder.path() / "manifest.json", manifest.dump());
    std::string told;
    ReadExportable(folder.path(), {.warn = [&](const std::string& line) { told += line; }});
    return told;
  };
  EXPECT_THAT(warnings(R"({"shutter_s": 0.015, "rolling_s": 0.03})"),
              ::testing::AllOf(::testing::HasSubstr("over 30 ms"),
                               ::testing::HasSubstr("--rolling-ms 0")));
  for (const char* exposure :
       {R"({"shutter_s": 0.015, "rolling_s": 0})", R"({"rolling_s": "0.03"})", "3", "[1]"}) {
    EXPECT_THAT(warnings(exposure), ::testing::Not(::testing::HasSubstr("rolling")))
        << exposure;
  }
}

}  // namespace
}  // namespace eval
