// What `pas suite --shrink` leaves of a case that fails.
#include <chrono>
#include <thread>

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
  WriteSuite("seeds: {first: 21, count: 3}\n");
  WriteProgram(
      "case \"$*\" in *slam*)\n"
      "  if grep -q 'name: book_1' $4 && grep -q 'name: book_2' $4; then kill -SEGV $$; fi;;\n"
      "esac");
  const Outcome outcome = Suite("out", {"--shrink", "plates-22/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string scene = ReadText(folder_ / "out/shrunk/scene.yaml");
  EXPECT_THAT(scene, HasSubstr("name: book_1"));
  EXPECT_THAT(scene, HasSubstr("name: book_2"));
  EXPECT_THAT(scene, Not(HasSubstr("name: desk")));
  // The camera's motion and the noise are those of the case.
  EXPECT_THAT(ReadText(folder_ / "out/shrunk/suite.yaml"), HasSubstr("seeds: {first: 22}"));
}

// The smaller scene stands elsewhere; its meshes are where they were.
TEST_F(SuiteProgram, ShrinksASceneWithAMeshOfItsFolder) {
  fs::create_directories(folder_ / "own");
  std::ofstream(folder_ / "own/box.obj")
      << "v 0 0 0\nv 0.2 0 0\nv 0.2 0.2 0\nv 0 0.2 0\nv 0 0 0.2\nv 0.2 0 0.2\nv 0.2 0.2 0.2\nv "
         "0 0.2 0.2\n"
         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  std::ofstream(folder_ / "own/scene.yaml")
      << "format: pas-scene/1\nname: own\nobjects:\n"
         "  - {id: 1, name: floor, class: floor, role: structure, size_m: [4, 4, 0.1],"
         " center_m: [0, 0, -0.05]}\n"
         "  - {id: 2, name: thing, class: box, role: regular, mesh: box.obj, center_m: [0, 0, "
         "0.1]}\n";
  std::ofstream(folder_ / "suite.yaml")
      << "format: pas-suite/1\nname: fake\nscenes: [{file: own/scene.yaml}]\n"
         "seeds: {first: 1, count: 1}\n";
  WriteProgram(
      "case \"$*\" in *slam*) frames=${*##*--frames }; echo ${frames%% *} >> frames_tried\n"
      "  if grep -q 'name: thing' $4; then kill -SEGV $$; fi;; esac");
  const Outcome outcome = Suite("out", {"--shrink", "scene-1/kinect1/own/full/default"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string scene = ReadText(folder_ / "out/shrunk/scene.yaml");
  EXPECT_THAT(scene, HasSubstr("name: thing"));
  EXPECT_THAT(scene, Not(HasSubstr("name: floor")));
  const Outcome shown = Process({Pas(), "scene", "show", folder_ / "out/shrunk/scene.yaml"}, {},
                                folder_ / "errors")
                            .Wait();
  EXPECT_EQ(shown.exit_code, 0) << shown.errors;
  // The first try has as many frames as the case itself.
  EXPECT_EQ(ReadText(folder_ / "out/frames_tried").substr(0, 4), "300\n");
}

TEST_F(SuiteProgram, LeavesASmallerCaseThatCanBeTakenElsewhere) {
  std::ofstream(folder_ / "sensor.yaml") << "base: azure\n";
  std::ofstream(folder_ / "config.yaml") << "pose: {rounds: 4}\n";
  WriteSuite(
      "seeds: {first: 1, count: 1}\nsensors: [{name: mine, file: sensor.yaml}]\n"
      "configs: [{name: mine, file: config.yaml}]\n");
  WriteProgram("case \"$*\" in *slam*) kill -SEGV $$;; esac");
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/mine/own/full/mine"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  fs::rename(folder_ / "out/shrunk", folder_ / "elsewhere");
  fs::remove_all(folder_ / "out");
  const Outcome again = Process({Pas(), "-q", "suite", folder_ / "elsewhere/suite.yaml", "-o",
                                 folder_ / "again", "--program", folder_ / "fake"},
                                {}, folder_ / "errors")
                            .Wait();
  EXPECT_EQ(again.exit_code, 1) << again.errors;
  EXPECT_THAT(Statuses("again"), ElementsAre(HasSubstr("crashed")));
}

TEST_F(SuiteProgram, ShrinksNothingWhenItIsStoppedInTheFirstTry) {
  WriteProgram("echo > started; sleep 5; kill -SEGV $$");
  const Process process(Command("out", {"--shrink", "plates-1/kinect1/own/full/default"}), {},
                        folder_ / "errors");
  for (int i = 0; i < 500 && !fs::exists(folder_ / "out/started"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.Send(SIGINT);
  EXPECT_EQ(process.Wait().exit_code, 128 + SIGINT);
  EXPECT_FALSE(fs::exists(folder_ / "out/shrunk/suite.yaml"));
}

TEST_F(SuiteProgram, ShrinksNothingThatDoesNotFail) {
  const Outcome outcome = Suite("out", {"--shrink", "plates-1/kinect1/own/full/default"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("does not fail; bound its figures"));
}

class ShrinkByBaseline : public SuiteProgram {
 protected:
  void SetUp() override {
    WriteSuite("size_px: [320, 240]\nseeds: {first: 1, count: 1}\ngate: {times: false}\n");
    WriteProgram("");
    const Outcome outcome =
        Suite("before", {"--baseline", folder_ / "baseline.json", "--accept", "first"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  }
  Outcome Shrink() const {
    return Suite("out", {"--baseline", folder_ / "baseline.json", "--shrink",
                         "plates-1/kinect1/own/full/default"});
  }
  int ExitCodeOfWhatIsLeft(const std::string& results) const {
    return Process({Pas(), "-q", "suite", folder_ / "out/shrunk/suite.yaml", "-o",
                    folder_ / results, "--program", folder_ / "fake"},
                   {}, folder_ / "errors")
        .Wait()
        .exit_code;
  }
};

TEST_F(ShrinkByBaseline, LeavesABoundHalfWayToWhatTheCaseWas) {
  // Errors are twice as large from four frames on. In small images they are four times as
  // large, which is not what became worse.
  WriteProgram(
      "case \"$*\" in *slam*)\n"
      "  frames=${*##*--frames }; frames=${frames%% *}\n"
      "  if [ $frames -ge 4 ]; then factor=2.00; fi\n"
      "  case \"$*\" in *'--width 160'*) factor=4.00;; esac;;\n"
      "esac");
  const Outcome outcome = Shrink();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  const std::string suite = ReadText(folder_ / "out/shrunk/suite.yaml");
  EXPECT_THAT(suite, HasSubstr("rmse_m is 0.002, and 0.001 in the baseline\n"));
  EXPECT_THAT(suite, HasSubstr("frames: 5\nsize_px: [320, 240]\n"));
  EXPECT_THAT(suite, HasSubstr("gate:\n  worst:\n    /trajectory/ate_se3/rmse_m: 0.0015\n"));
  EXPECT_EQ(ExitCodeOfWhatIsLeft("worse"), 1);
  WriteProgram("");
  EXPECT_EQ(ExitCodeOfWhatIsLeft("mended"), 0);
}

TEST_F(ShrinkByBaseline, RefusesACaseThatIsWorseByLessThanMatters) {
  WriteProgram("factor=1.04");
  const Outcome outcome = Shrink();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("is not worse than in the baseline"));
}

}  // namespace
