// `pas draw` as a process: a run or a sequence with a fault is named, and nothing is left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program/small_run_test.h"

namespace program {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DrawProgram : public SmallRunTest {
 protected:
  Outcome Draw() const { return Do({"draw", folder_ / "run", "-o", folder_ / "pictures"}); }
  void ExpectRefusedWith(const std::string& where) const {
    const Outcome outcome = Draw();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.errors, HasSubstr(where));
    EXPECT_THAT(outcome.errors, Not(HasSubstr("OpenCV")));
    std::vector<std::string> there;
    for (const auto& entry : fs::directory_iterator(folder_ / "")) {
      there.push_back(entry.path().filename().string());
    }
    EXPECT_THAT(there, ::testing::UnorderedElementsAre("seq", "run", "errors"));
  }
  fs::path FirstColourImage() const {
    std::vector<fs::path> images;
    for (const auto& entry : fs::directory_iterator(folder_ / "seq/rgb")) {
      images.push_back(entry.path());
    }
    return *std::min_element(images.begin(), images.end());
  }
};

TEST_F(DrawProgram, DrawsAWholeRun) {
  EXPECT_EQ(Draw().exit_code, 0);
  EXPECT_EQ(Contents(folder_ / "pictures").size(), 3u);
}

TEST_F(DrawProgram, NamesAColourImageThatIsCutOffAndLeavesNothing) {
  const fs::path image = FirstColourImage();
  fs::resize_file(image, 40);
  ExpectRefusedWith(image.filename().string());
}

TEST_F(DrawProgram, NamesAColourImageThatSaysItIsHugeAndLeavesNothing) {
  const fs::path image = FirstColourImage();
  std::string bytes = ReadText(image);
  bytes[16] = bytes[20] = 1;  // the first of four bytes of width and of height
  eval::small_world::WriteText(image, bytes);
  ExpectRefusedWith(image.filename().string());
}

TEST_F(DrawProgram, NamesAFolderThatIsAnImageAndLeavesNothing) {
  const fs::path image = FirstColourImage();
  fs::remove(image);
  fs::create_directory(image);
  ExpectRefusedWith(image.filename().string());
}

TEST_F(DrawProgram, NamesARunThatIsBrokenAndLeavesNothing) {
  eval::small_world::WriteText(folder_ / "run/map.json", "{\"planes\": [");
  ExpectRefusedWith("map.json");
}

TEST_F(DrawProgram, RefusesARunOfAnotherSequence) {
  const std::string poses = ReadText(folder_ / "run/trajectory.txt");
  eval::small_world::WriteText(folder_ / "run/trajectory.txt", poses + "99.5 0 0 0 0 0 0 1\n");
  ExpectRefusedWith("belongs to no frame of " + (folder_ / "seq").string());
}

TEST_F(DrawProgram, WritesIntoNoFolderButThatOfAnEarlierDrawing) {
  fs::create_directory(folder_ / "notes");
  std::ofstream(folder_ / "notes/thesis.tex") << "years of work";
  for (const char* place : {"seq", "run", "notes"}) {
    const auto before = Contents(folder_ / place);
    const Outcome outcome = Do({"draw", folder_ / "run", "-o", folder_ / place, "--force"});
    EXPECT_EQ(outcome.exit_code, 2) << place;
    EXPECT_THAT(outcome.errors, HasSubstr("even --force does not write into it")) << place;
    EXPECT_EQ(Contents(folder_ / place), before) << place;
  }
  ASSERT_EQ(Draw().exit_code, 0);
  fs::rename(folder_ / "seq", folder_ / "pictures/seq");
  const Outcome outcome = Do({"draw", folder_ / "run", "-o", folder_ / "pictures", "--force",
                              "--truth", folder_ / "pictures/seq"});
  EXPECT_THAT(outcome.errors, HasSubstr("seq is in it, which is read by this command"));
}

}  // namespace
}  // namespace program
