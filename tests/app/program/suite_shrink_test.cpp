// What `pas suite --shrink` leaves of a case that fails.
#include "tests/app/program/fake_suite.h"

namespace {

using namespace program;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(SuiteProgram, ShrinksACaseWhileItFailsAlike) {
  // It crashes from four frames on when the first of the two boards is there.
  WriteSuite("seeds: {first: 1, count: 1}\nsize_px: [320, 240]\n");
  WriteProgram(
      "case \"$*\" in *slam*)\n"
      "  frames=${*##*--frames }; frames=${frames%% *}\n"
      "  if [ $frames -ge 4 ] && grep -q 'name: book_1' $4; then kill -SEGV $$; fi;;\n"
      "esac");
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string suite = ReadText(folder_ / "out/shrunk/suite.yaml");
  EXPECT_THAT(suite, HasSubstr("frames: 5\nsize_px: [80, 60]"));
  const std::string scene = ReadText(folder_ / "out/shrunk/scene.yaml");
  EXPECT_EQ(scene.find("name:", scene.find("name:", scene.find("objects:")) + 1),
            std::string::npos)
      << scene;
  // What it wrote is a suite that fails in the same way.
  fs::copy_file(folder_ / "out/shrunk/suite.yaml", folder_ / "out/shrunk/again.yaml");
  const Outcome again = Process({Pas(), "-q", "suite", folder_ / "out/shrunk/again.yaml", "-o",
                                 folder_ / "again", "--program", folder_ / "fake"},
                                {}, folder_ / "errors")
                            .Wait();
  EXPECT_EQ(again.exit_code, 1) << again.errors;
  EXPECT_THAT(Statuses("again"), ElementsAre(HasSubstr("crashed")));
}

TEST_F(SuiteProgram, LeavesTheLastSceneThatFailedWhereSmallerOnesDoNot) {
  WriteSuite("seeds: {first: 1, count: 1}\n");
  WriteProgram(
      "case \"$*\" in *slam*)\n"
      "  if grep -q 'name: book_1' $4 && grep -q 'name: book_2' $4; then kill -SEGV $$; fi;;\n"
      "esac");
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string scene = ReadText(folder_ / "out/shrunk/scene.yaml");
  EXPECT_THAT(scene, HasSubstr("name: book_1"));
  EXPECT_THAT(scene, HasSubstr("name: book_2"));
  EXPECT_THAT(scene, Not(HasSubstr("name: desk")));
}

TEST_F(SuiteProgram, ShrinksNothingThatDoesNotFail) {
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("does not fail; bound its figures"));
}

}  // namespace
