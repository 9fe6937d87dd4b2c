// What the time stamps of a sequence folder may be, and what becomes of those that may not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "io/input_error.h"
#include "slam/input/frame_rate.h"
#include "slam/input/sequence_index.h"
#include "slam/input/sequence_reader.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class SequenceStamps : public ::testing::Test {
 protected:
  void WriteText(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  /// Image i has the i-th stamp.
  static std::string List(const std::vector<std::string>& stamps, const std::string& kind) {
    std::ostringstream text;
    for (std::size_t i = 0; i < stamps.size(); ++i)
      text << stamps[i] << " " << kind << "/" << i << ".png\n";
    return text.str();
  }
  void WriteLists(const std::vector<std::string>& rgb, const std::vector<std::string>& depth) {
    WriteText("rgb.txt", List(rgb, "rgb"));
    WriteText("depth.txt", List(depth, "depth"));
  }
  void WriteAssociations(const std::vector<std::string>& stamps) {
    std::ostringstream text;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      text << stamps[i] << " rgb/" << i << ".png " << stamps[i] << " depth/" << i << ".png\n";
    }
    WriteText("associations.txt", text.str());
  }
  /// The colour images of the frames, in their order.
  std::vector<std::string> Colour() {
    std::vector<std::string> files;
    for (const SequenceEntry& entry : IndexSequence(folder_.path()).entries)
      files.push_back(entry.rgb);
    return files;
  }
  std::vector<std::string> Warnings() { return IndexSequence(folder_.path()).warnings; }
  void ExpectError(const std::string& regex) {
    EXPECT_THAT([&] { IndexSequence(folder_.path()); },
                ThrowsMessage<io::InputError>(ContainsRegex(regex)));
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(SequenceStamps, OfAssociationsThatGoBackAreSorted) {
  WriteAssociations({"1.0", "1.2", "1.1", "1.3"});
  EXPECT_THAT(Colour(), ElementsAre("rgb/0.png", "rgb/2.png", "rgb/1.png", "rgb/3.png"));
  EXPECT_THAT(Warnings(), ElementsAre(HasSubstr("1 of 4 lines of associations.txt (first "
                                                "associations.txt:3)")));
}

TEST_F(SequenceStamps, OfAssociationsThatComeAgainCountOnce) {
  WriteAssociations({"1.0", "1.1", "1.1", "1.2", "1.1000001"});
  EXPECT_THAT(Colour(), ElementsAre("rgb/0.png", "rgb/1.png", "rgb/3.png"));
  EXPECT_THAT(
      Warnings(),
      ElementsAre(ContainsRegex("sorted by time, .* 1 of 5 .*first associations.txt:5"),
                  ContainsRegex("stamps come again: 2 of 5 .*first associations.txt:3")));
}

TEST_F(SequenceStamps, OfListsThatGoBackOrComeAgainAreMendedInEachList) {
  WriteLists({"1.0", "1.1", "1.1"}, {"1.1", "1.0"});
  const SequenceIndex index = IndexSequence(folder_.path());
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_EQ(index.entries[0].rgb, "rgb/0.png");
  EXPECT_EQ(index.entries[0].depth, "depth/1.png");
  EXPECT_EQ(index.entries[1].rgb, "rgb/1.png");
  EXPECT_EQ(index.entries[1].depth, "depth/0.png");
  EXPECT_THAT(
      index.warnings,
      ElementsAre(ContainsRegex("come again: 1 of 3 lines of rgb.txt .first rgb.txt:3"),
                  ContainsRegex("sorted .* 1 of 2 lines of depth.txt .first depth.txt:2")));
}

TEST_F(SequenceStamps, OfEachImageAreOfItsOwnLine) {
  WriteLists({"0.5", "1.0"}, {"0.1", "0.2", "1.01"});
  const SequenceIndex index = IndexSequence(folder_.path());
  ASSERT_EQ(index.entries.size(), 1u);
  EXPECT_EQ(index.entries[0].rgb_source, "rgb.txt:2");
  EXPECT_EQ(index.entries[0].depth_source, "depth.txt:3");
}

TEST_F(SequenceStamps, NameTheLineOfADepthImageThatCannotBeUsed) {
  std::filesystem::create_directories(folder_ / "rgb");
  std::filesystem::create_directories(folder_ / "depth");
  cv::imwrite((folder_ / "rgb/0.png").string(), cv::Mat3b(24, 32, cv::Vec3b(1, 2, 3)));
  cv::imwrite((folder_ / "depth/1.png").string(), cv::Mat1b(24, 32, uchar{7}));
  WriteLists({"1.0"}, {"0.5", "1.0"});
  Camera camera;
  camera.width = 32, camera.height = 24, camera.cx = 15.5, camera.cy = 11.5;
  const auto expect = [&](const std::string& regex) {
    EXPECT_THAT([&] { SequenceReader(folder_.path(), camera).Read(0); },
                ThrowsMessage<io::InputError>(ContainsRegex(regex)));
  };
  expect("depth/1.png .frame 0, depth.txt:2.: the image is 8-bit gray");
  std::filesystem::remove(folder_ / "depth/1.png");
  expect("depth/1.png .frame 0, depth.txt:2.: no such file");
}

TEST_F(SequenceStamps, AreRefusedInUnitsOtherThanSecondsSince1970) {
  WriteAssociations({"1305031102175304000"});
  ExpectError(
      "associations.txt:1: timestamp `1305031102175304000` .*nanoseconds: divide by 1e9");
  WriteAssociations({"1305031102175304"});
  ExpectError("microseconds");
  WriteAssociations({"1305031102175"});
  ExpectError("milliseconds");
  WriteAssociations({"-1"});
  ExpectError("not a number of seconds");
  WriteAssociations({"nan"});
  ExpectError("not a number of seconds");
}

// By the rule of `pas eval`, which would refuse the trajectory.
TEST_F(SequenceStamps, AreRefusedInUnitsOtherThanSecondsSinceTheMachineWasStarted) {
  WriteAssociations({"1000000000", "1033000000", "1066000000"});
  ExpectError("associations.txt: .*not in seconds: the median step is 33000000; .*nanoseconds");
  WriteAssociations({"1000000", "1033000", "1066000"});
  ExpectError("microseconds: divide by 1e6");
  std::filesystem::remove(folder_ / "associations.txt");
  WriteLists({"1", "2", "3"}, {"1000000000", "1033000000", "1066000000"});
  ExpectError("depth.txt: .*nanoseconds");
}

std::string WarningOf(double step_s, double fps) {
  std::vector<SequenceEntry> entries(5);
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i].timestamp_s = 1.3e9 + step_s * static_cast<double>(i);
  return RateWarning(entries, fps);
}

TEST(RateWarning, IsThereForStampsThatLookLikeAnotherUnit) {
  EXPECT_THAT(WarningOf(33, 30), HasSubstr("milliseconds"));
  EXPECT_THAT(
      WarningOf(1, 30),
      AllOf(HasSubstr("a colour image comes every 1 s (median), but fps of the camera is "
                      "30: are the timestamps seconds"),
            HasSubstr("numbers of frames")));
  EXPECT_THAT(WarningOf(0.5, 30), HasSubstr("set fps to 2"));
  EXPECT_THAT(WarningOf(0.00003, 30), HasSubstr("are the timestamps seconds?"));
}

TEST(RateWarning, IsNotThereForACameraThatIsSomewhatSlowerOrFaster) {
  for (const double fps : {8.0, 10.0, 15.0, 30.0, 60.0, 90.0})
    EXPECT_THAT(WarningOf(1 / 30.0, fps), IsEmpty()) << fps;
  EXPECT_THAT(WarningOf(0.1, 30), IsEmpty());
}

TEST(RateWarning, NeedsMoreThanTwoFrames) {
  std::vector<SequenceEntry> entries(2);
  entries[1].timestamp_s = 100;
  EXPECT_THAT(RateWarning(entries, 30), IsEmpty());
}

}  // namespace
}  // namespace slam
