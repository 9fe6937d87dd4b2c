#include "eval/formats/folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/formats/pose/trajectory.h"
#include "eval/formats/sequence/camera.h"
#include "eval/formats/sequence/manifest.h"
#include "eval/formats/stamps.h"
#include "tests/eval/check/small_world.h"

namespace eval {
namespace {

using small_world::TemporaryFolder;
using small_world::WriteText;
using ::testing::HasSubstr;
using ::testing::Optional;

// Lines 2 and 4 leave no pose; line 3 goes back in time, which a score need not care about.
constexpr const char* kPoses =
    "2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0\n1 0 0 0 0 0 0 1\n4 0 0 0 0 0 0 0\n5 0 0 0 0 0 0 1\n";

TEST(FolderFaults, AreAllToldToACheckWhichReadsTheRest) {
  const TemporaryFolder place;
  WriteText(place.path() / "t.txt", kPoses);
  Folder folder(place.path(), OnFault::kCollect);
  EXPECT_EQ(ReadTrajectory(folder, "t.txt").size(), 3u);
  ASSERT_EQ(folder.faults().size(), 3u);
  EXPECT_EQ(folder.faults()[0].line, 2);
  EXPECT_THAT(folder.faults()[1].what, HasSubstr("increase strictly"));
  EXPECT_THAT(Describe(folder.faults()[2]), HasSubstr("t.txt:4: expected a unit quaternion"));
}

TEST(FolderFaults, StopAScoreAtTheFirstThatIsFatal) {
  const TemporaryFolder place;
  WriteText(place.path() / "t.txt", kPoses);
  Folder folder(place.path());
  EXPECT_THAT([&] { ReadTrajectory(folder, "t.txt"); },
              ::testing::ThrowsMessage<io::InputError>(HasSubstr("t.txt:2: expected")));
}

TEST(FolderFaults, ThatAreWarningsAreKeptForAScoreWhichReadsOn) {
  const TemporaryFolder place;
  WriteText(place.path() / "t.txt",
            "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n4 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n");
  Folder folder(place.path());
  EXPECT_EQ(ReadTrajectory(folder, "t.txt").size(), 4u);
  ASSERT_EQ(folder.faults().size(), 2u);
  const std::vector<std::string> lines = Summaries(folder.faults(), "RUN");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0],
              ::testing::StartsWith("RUN/t.txt:2: time stamp 1.000000 does not follow"));
  EXPECT_THAT(lines[0], ::testing::EndsWith("(and 1 more like it)"));
}

TEST(FolderFaults, ThatAreFlawsArePassedOverByAScore) {
  const TemporaryFolder place;
  WriteText(place.path() / "manifest.json", "{\"format\": \"pas-sequence/1\"}");
  Folder scored(place.path()), checked(place.path(), OnFault::kCollect);
  EXPECT_TRUE(ReadManifest(scored).known_format);
  EXPECT_TRUE(ReadManifest(checked).known_format);
  EXPECT_EQ(scored.faults().size(), 0u);
  EXPECT_GT(checked.faults().size(), 0u);
}

TEST(FolderFaults, OfIoComeWithTheirLine) {
  const TemporaryFolder place;
  WriteText(place.path() / "camera.yaml",
            "model: pinhole\nwidth: 640\nheight: 480\nfx: 500\nfy: wide\ncx: -9\ncy: 2\n"
            "fps: 30\ndepth_factor: 5000\n");
  Folder folder(place.path(), OnFault::kCollect);
  EXPECT_FALSE(ReadCamera(folder).has_value());
  ASSERT_EQ(folder.faults().size(), 2u);
  EXPECT_EQ(folder.faults()[0].line, 5);
  EXPECT_THAT(folder.faults()[0].what, HasSubstr("fy: expected a number"));
  EXPECT_EQ(folder.faults()[1].line, 6);  // a flaw: the principal point is outside the image
}

TEST(NearestStamp, TakesTheFirstOfEquallyNearOnes) {
  const std::vector<double> stamps{1.0, 1.0, 2.0};
  EXPECT_THAT(NearestStamp(stamps, 1.5, 0.5), Optional(0u));
  EXPECT_THAT(NearestStamp(stamps, 1.6, 0.5), Optional(2u));
  EXPECT_THAT(NearestStamp(stamps, 9.0, 7.0), Optional(2u));
  EXPECT_EQ(NearestStamp(stamps, 9.0, 6.9), std::nullopt);
  EXPECT_EQ(NearestStamp({}, 9.0, 6.9), std::nullopt);
}

}  // namespace
}  // namespace eval
