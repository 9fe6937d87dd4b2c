// What is refused at once, before anything is read or done, and in words that name what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/app/program/small_run_test.h"
#include "tests/support/image_files.h"

namespace program {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class PlainRefusals : public SmallRunTest {
 protected:
  void ExpectSaid(const std::vector<std::string>& arguments, const std::string& why) const {
    const Outcome outcome = Do(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments[0];
    EXPECT_THAT(outcome.errors, HasSubstr(why)) << arguments[0];
  }
  /// What pas prints of a line of arguments.
  std::string Printed(const std::string& arguments) const {
    const std::string file = folder_ / "printed";
    Process({"/bin/sh", "-c", "'" + Pas().string() + "' " + arguments + " > " + file}, {},
            folder_ / "errors")
        .Wait();
    return ReadText(file);
  }
  std::string nowhere() const { return folder_ / "nowhere"; }
};

TEST_F(PlainRefusals, OfSlamComeBeforeItReadsTheSequence) {
  const std::string out = folder_ / "out";
  fs::create_directory(out);
  std::ofstream(folder_ / "out/thesis.tex") << "years of work";
  ExpectSaid({"slam", nowhere(), "-o", out}, "out: exists already");
  ExpectSaid({"slam", nowhere(), "-o", folder_ / "out/thesis.tex/run"},
             "thesis.tex is a file, no folder");
  ExpectSaid({"slam", nowhere(), "-o", folder_ / "new", "--detector", "eyes"},
             "--detector eyes: unknown detector");
  ExpectSaid({"slam", nowhere(), "-o", folder_ / "new", "--variant", "points", "--association",
              "sp-slam"},
             "--association: is of --variant full");
}

TEST_F(PlainRefusals, OfExportComeBeforeItReadsTheSequences) {
  const std::string out = folder_ / "run";
  for (const char* format : {"coco", "bop"}) {
    ExpectSaid({"export", nowhere(), "--format", format, "-o", out}, "run: exists already");
  }
}

TEST_F(PlainRefusals, OfSettingsAreOfAnEmptyFileToo) {
  std::ofstream(folder_ / "empty.yaml") << "";
  ExpectSaid({"config", "--config", folder_ / "empty.yaml"},
             "empty.yaml:1: the file is empty; expected settings");
  std::ofstream(folder_ / "none.yaml") << "{}\n";
  EXPECT_EQ(Do({"config", "--config", folder_ / "none.yaml"}).exit_code, 0);
}

TEST_F(PlainRefusals, OfSurfacesAreOfOneFileForTwoOutputs) {
  const std::string one = folder_ / "one.yaml";
  for (const char* force : {"-q", "--force"}) {
    ExpectSaid({"surfaces", folder_ / "seq", "-o", one, "--picture", one, force},
               "one.yaml: would hold two outputs");
  }
  EXPECT_FALSE(fs::exists(one));
}

TEST_F(PlainRefusals, OfSurfacesAreOfARecordingThatShowsNone) {
  for (const auto& image : fs::directory_iterator(folder_ / "seq/depth")) {
    const cv::Mat depth = test_support::ReadImageFile(image.path());
    test_support::WriteImageFile(image.path(), cv::Mat1w(depth.size(), ushort{0}));
  }
  const Outcome outcome = Do({"surfaces", folder_ / "seq", "-o", folder_ / "surfaces.yaml"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr("nothing is written, because no surface of 0.15 m2"));
  EXPECT_FALSE(fs::exists(folder_ / "surfaces.yaml"));
}

TEST_F(PlainRefusals, NameWhatIsThereAndWhatWasExpected) {
  std::ofstream(folder_ / "afile") << "text\n";
  ExpectSaid({"import", folder_ / "afile", "-o", folder_ / "out"},
             "afile: is no bag of ROS 1; expected RECORDING.bag");
  ExpectSaid({"check", nowhere()}, nowhere() + ": no such folder");
  ExpectSaid({"bench", "epipolar", nowhere(), "--trajectory", folder_ / "afile"},
             nowhere() + ": no such folder");
  ExpectSaid({"bench", "warp", nowhere(), "--warp", folder_ / "afile"},
             nowhere() + ": no such folder");
  ExpectSaid(
      {"eval", "--trajectory", folder_ / "run/trajectory.txt", "--truth", folder_ / "seq"},
      "name its " + (folder_ / "seq/groundtruth.txt").string());
  ExpectSaid({"--nosuch"}, "unknown option `--nosuch`");
}

TEST_F(PlainRefusals, PrintNoTableWithoutRows) {
  EXPECT_THAT(Printed("bench planes " + nowhere()), IsEmpty());
  EXPECT_THAT(ReadText(folder_ / "errors"), HasSubstr(nowhere() + ": no such folder"));
}

TEST_F(PlainRefusals, AreSparedByHelpThatSaysWhatEachParameterIs) {
  const std::string help = Printed("scene make --help");
  EXPECT_THAT(help, HasSubstr("between the boards [0.1, 500]"));
  EXPECT_THAT(help, Not(HasSubstr("The same for this")));
}

}  // namespace
}  // namespace program
