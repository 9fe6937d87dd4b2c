#include "slam/input/sequence_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "io/input_error.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// A folder of this test alone, into which small sequences are written.
class Sequences : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "rgb");
    fs::create_directories(folder_ / "depth");
    camera_.width = 32, camera_.height = 24, camera_.cx = 15.5, camera_.cy = 11.5;
  }

  void WriteText(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  /// Frame i: colour (i, 2i, 3i), depth raw 1000 + i.
  void WriteImages(int i) {
    cv::imwrite((folder_ / ("rgb/" + std::to_string(i) + ".png")).string(),
                cv::Mat(24, 32, CV_8UC3, cv::Scalar(3 * i, 2 * i, i)));
    cv::imwrite((folder_ / ("depth/" + std::to_string(i) + ".png")).string(),
                cv::Mat(24, 32, CV_16UC1, cv::Scalar(1000 + i)));
  }
  /// Frames with these stamps, in this order.
  void WriteFrames(const std::vector<std::string>& stamps) {
    std::ostringstream text;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      WriteImages(static_cast<int>(i));
      text << stamps[i] << " rgb/" << i << ".png " << stamps[i] << " depth/" << i << ".png\n";
    }
    WriteText("associations.txt", text.str());
  }
  void ExpectIndexError(const std::string& regex) {
    EXPECT_THAT([&] { IndexSequence(folder_); },
                ThrowsMessage<io::InputError>(ContainsRegex(regex)));
  }
  void ExpectReadError(const std::string& regex) {
    EXPECT_THAT(
        [&] {
          SequenceReader reader(folder_, camera_);
          for (int i = 0; i < reader.size(); ++i) reader.Read(i);
        },
        ThrowsMessage<io::InputError>(ContainsRegex(regex)));
  }

  test_support::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  Camera camera_;
};

TEST_F(Sequences, GiveColourGrayAndDepthInMetresOfEachFrame) {
  WriteFrames({"1.0", "1.1", "1.2"});
  cv::Mat depth(24, 32, CV_16UC1, cv::Scalar(5000));
  depth.at<std::uint16_t>(3, 4) = 0;
  depth.at<std::uint16_t>(5, 6) = 65535;
  cv::imwrite((folder_ / "depth/1.png").string(), depth);
  SequenceReader reader(folder_, camera_);
  ASSERT_EQ(reader.size(), 3);
  const RecordedFrame frame = reader.Read(1);
  EXPECT_EQ(frame.index, 1);
  EXPECT_EQ(frame.timestamp_s, 1.1);
  EXPECT_EQ(frame.bgr(0, 0), cv::Vec3b(3, 2, 1));
  EXPECT_EQ(frame.gray(0, 0), cvRound(0.299 * 1 + 0.587 * 2 + 0.114 * 3));
  EXPECT_EQ(frame.depth_m(0, 0), 1.0f);
  EXPECT_EQ(frame.depth_m(3, 4), 0.0f);
  EXPECT_EQ(frame.depth_m(5, 6), 0.0f);
  EXPECT_THROW(reader.Read(3), std::invalid_argument);
}

TEST_F(Sequences, TellHowMuchLaterThanColourDepthIs) {
  WriteImages(0), WriteImages(1);
  WriteText("associations.txt",
            "1.0 rgb/0.png 1.015 depth/0.png\n1.1 rgb/1.png 1.09 depth/1.png\n");
  SequenceReader reader(folder_, camera_);
  ASSERT_EQ(reader.size(), 2);
  EXPECT_NEAR(reader.Read(0).depth_late_s, 0.015, 1e-9);
  EXPECT_NEAR(reader.Read(1).depth_late_s, -0.01, 1e-9);
}

TEST_F(Sequences, ReadTheSameWithAndWithoutPrefetchAndInAnyOrder) {
  WriteFrames({"1", "2", "3", "4"});
  SequenceReader ahead(folder_, camera_), plain(folder_, camera_, {.prefetch = false});
  for (const int i : {0, 1, 2, 0, 3, 2, 2, 1}) {
    const RecordedFrame a = ahead.Read(i), b = plain.Read(i);
    EXPECT_EQ(a.index, b.index);
    EXPECT_EQ(cv::norm(a.bgr, b.bgr, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(a.depth_m, b.depth_m, cv::NORM_INF), 0);
  }
}

TEST_F(Sequences, PairTheListsByNearestTimeOneToOneWithinTwentyMilliseconds) {
  for (int i = 0; i < 4; ++i) WriteImages(i);
  WriteText("rgb.txt",
            "# colour\n1.000 rgb/0.png\n1.012 rgb/1.png\n\n2.0 rgb/2.png\n3.0 rgb/3.png\n");
  // 1.010 is nearest to 1.012, so that 1.000 is left with 0.985; 2.02 is exactly too far.
  WriteText("depth.txt",
            "0.985 depth/1.png\n1.010 depth/0.png\n2.0201 depth/2.png\n3.0 depth/3.png\n");
  const SequenceIndex index = IndexSequence(folder_);
  ASSERT_EQ(index.entries.size(), 3u);
  EXPECT_EQ(index.entries[0].depth, "depth/1.png");
  EXPECT_EQ(index.entries[1].depth, "depth/0.png");
  EXPECT_EQ(index.entries[2].depth, "depth/3.png");
  EXPECT_EQ(index.entries[0].timestamp_s, 1.0);
  EXPECT_THAT(index.warnings, ElementsAre(ContainsRegex(
                                  "left out, .* within 20 ms: 1 of 4 colour images .first "
                                  "rgb.txt:5. and 1 of 4 depth images .first depth.txt:3.")));
}

TEST_F(Sequences, ArePairedAsTumsScriptPairsThem) {
  // What associate.py gives for these stamps, milliseconds, with its default of 20 ms: two
  // images go to others than the nearest, and two pairs cross.
  const std::vector<int> rgb{1011, 1018, 1024, 1046, 1060, 1077,
                             1091, 1102, 1120, 1134, 1153, 1169};
  const std::vector<int> depth{1023, 1037, 1043, 1050, 1070, 1077, 1096, 1114, 1118, 1140};
  const std::vector<std::pair<int, int>> pairs{{1, 1}, {2, 0}, {3, 2}, {4, 3}, {5, 5},
                                               {6, 6}, {7, 7}, {8, 8}, {9, 9}};
  const auto list = [](const std::vector<int>& stamps_ms, const std::string& folder) {
    std::string text;
    for (std::size_t i = 0; i < stamps_ms.size(); ++i) {
      text += std::to_string(stamps_ms[i] / 1000) + "." +
              std::to_string(stamps_ms[i]).substr(1) + " " + folder + "/" + std::to_string(i) +
              ".png\n";
    }
    return text;
  };
  WriteText("rgb.txt", list(rgb, "rgb"));
  WriteText("depth.txt", list(depth, "depth"));
  const SequenceIndex index = IndexSequence(folder_);
  ASSERT_EQ(index.entries.size(), pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(index.entries[i].rgb, "rgb/" + std::to_string(pairs[i].first) + ".png");
    EXPECT_EQ(index.entries[i].depth, "depth/" + std::to_string(pairs[i].second) + ".png");
  }
  EXPECT_THAT(index.warnings, ElementsAre(ContainsRegex("3 of 12 colour .* 1 of 10 depth")));
}

TEST_F(Sequences, WarnOfPairsThatAreFarApartInTime) {
  WriteFrames({"1.0", "1.1", "1.2"});
  EXPECT_THAT(IndexSequence(folder_).warnings, IsEmpty());
  WriteText("associations.txt",
            "1.0 rgb/0.png 1.02 depth/0.png\n1.1 rgb/1.png 0.71 depth/1.png\n"
            "1.2 rgb/2.png 1.57 depth/2.png\n");
  EXPECT_THAT(
      IndexSequence(folder_).warnings,
      ElementsAre(ContainsRegex("more than 20 ms apart, up to 390 ms, in 2 of 3 lines .*"
                                "first associations.txt:2")));
}

TEST_F(Sequences, WarnOfPairsThatTheListsDoNotHave) {
  WriteFrames({"1.0", "1.1"});
  WriteText("rgb.txt", "1.0 rgb/0.png\n1.1 rgb/1.png\n");
  WriteText("depth.txt", "1.0 depth/0.png\n1.1 depth/1.png\n");
  EXPECT_THAT(IndexSequence(folder_).warnings, IsEmpty());
  WriteText("depth.txt", "1.0 depth/1.png\n1.1 depth/0.png\n");
  EXPECT_THAT(
      IndexSequence(folder_).warnings,
      ElementsAre(ContainsRegex("depth.txt has not the time and file of 2 of 2 lines")));
}

TEST_F(Sequences, WarnOfPairsWhoseColourTheListHasUnderAnotherTimeOrFile) {
  WriteFrames({"1.0", "1.1", "1.2"});
  WriteText("depth.txt", "1.0 depth/0.png\n1.1 depth/1.png\n1.2 depth/2.png\n");
  for (const std::string line : {"1.1 rgb/0.png", "1.15 rgb/1.png", ""}) {
    WriteText("rgb.txt", "1.0 rgb/0.png\n" + line + "\n1.2 rgb/2.png\n");
    EXPECT_THAT(
        IndexSequence(folder_).warnings,
        ElementsAre(ContainsRegex("rgb.txt .* has not the time and file of 1 of 3 lines "
                                  ".*first associations.txt:2")))
        << line;
  }
}

TEST_F(Sequences, WarnWhenTheManifestSaysThatTheyAreNotWhole) {
  WriteFrames({"1.0", "1.1"});
  const auto warnings = [&](const std::string& manifest) {
    WriteText("manifest.json", manifest);
    return SequenceReader(folder_, camera_).warnings();
  };
  EXPECT_THAT(warnings(R"({"complete": true, "frame_count": 2})"), IsEmpty());
  EXPECT_THAT(warnings(R"({"generator": "another"})"), IsEmpty());
  EXPECT_THAT(warnings(R"({"complete": false, "frame_count": 3})"),
              ElementsAre(ContainsRegex("does not say complete: true; .*--resume")));
  EXPECT_THAT(warnings(R"({"complete": true, "frame_count": 3})"),
              ElementsAre(ContainsRegex("counts 3 frames, the lists of the sequence give 2")));
  EXPECT_THAT(warnings("{"), ElementsAre(ContainsRegex("manifest.json is no JSON object")));
  WriteText("manifest.json", R"({"complete": false})");
  fs::remove(folder_ / "depth/1.png");
  ExpectReadError("depth/1.png .*no such file; the sequence is not complete; finish it with");
}

TEST_F(Sequences, WarnOfStampsThatDoNotFitTheCamerasRate) {
  camera_.fps = 30;
  WriteFrames({"1.000", "1.033", "1.067", "1.100"});
  EXPECT_THAT(SequenceReader(folder_, camera_).warnings(), IsEmpty());
  WriteFrames({"1", "2", "3", "4"});
  EXPECT_THAT(SequenceReader(folder_, camera_).warnings(),
              ElementsAre(ContainsRegex("every 1 s .* look like numbers of frames")));
}

TEST_F(Sequences, NameFileAndLineOfAListThatCannotBeUnderstood) {
  ExpectIndexError("rgb.txt: no such file");
  WriteText("associations.txt", "# nothing\n");
  ExpectIndexError("associations.txt: names no image");
  WriteText("associations.txt", "\n1.0 rgb/0.png 1.0\n");
  ExpectIndexError(
      "associations.txt:2: expected `t_rgb rgb_file t_depth depth_file`, found 3 words");
  WriteText("associations.txt", "1.0 ../secret.png 1.0 depth/0.png\n");
  ExpectIndexError("associations.txt:1: file `../secret.png` must lie inside");
  WriteText("associations.txt", "1.0 rgb/../../secret.png 1.0 depth/0.png\n");
  ExpectIndexError("associations.txt:1: file `rgb/../../secret.png` must lie inside");
  WriteText("associations.txt", "1.0 /etc/passwd 1.0 depth/0.png\n");
  ExpectIndexError("must lie inside");
  WriteText("associations.txt", std::string(10000, 'x'));
  ExpectIndexError("associations.txt:1: too long");
  EXPECT_THAT([] { IndexSequence("/nowhere/at/all"); },
              ThrowsMessage<io::InputError>(ContainsRegex("/nowhere/at/all: no such folder")));
}

TEST_F(Sequences, SayWhenTheTwoListsHaveNothingInCommon) {
  WriteText("rgb.txt", "1.0 rgb/0.png\n");
  WriteText("depth.txt", "1.5 depth/0.png\n");
  ExpectIndexError("no colour image of rgb.txt has a depth image .* within 20 ms");
}

TEST_F(Sequences, NameFileAndFrameOfAnImageThatCannotBeUsed) {
  WriteFrames({"1.0", "1.1"});
  const fs::path rgb = folder_ / "rgb/1.png", depth = folder_ / "depth/1.png";
  const std::uintmax_t size = fs::file_size(rgb);

  fs::resize_file(rgb, size - 20);
  ExpectReadError("rgb/1.png \\(frame 1, associations.txt:2\\): the image is truncated");
  fs::resize_file(rgb, 10);
  ExpectReadError("rgb/1.png .*not a PNG or JPEG image");
  fs::resize_file(rgb, 0);
  ExpectReadError("rgb/1.png .*frame 1.*is empty");
  fs::remove(rgb);
  ExpectReadError("rgb/1.png .*frame 1.*no such file");
  fs::create_directory(rgb);
  ExpectReadError("rgb/1.png .*frame 1.*not a file");
  fs::remove(rgb);

  cv::imwrite(rgb.string(), cv::Mat(24, 30, CV_8UC3, cv::Scalar(0)));
  ExpectReadError("rgb/1.png .*the image is 30 x 24, the camera says 32 x 24");
  WriteImages(1);
  cv::imwrite(depth.string(), cv::Mat(24, 32, CV_8UC1, cv::Scalar(0)));
  ExpectReadError("depth/1.png .*frame 1.*8-bit gray, expected 16-bit gray");
}

TEST_F(Sequences, TakeColourAsJpegWhateverItIsCalled) {
  WriteFrames({"1.0"});
  cv::Mat3b ramp(24, 32);
  for (int v = 0; v < ramp.rows; ++v) {
    for (int u = 0; u < ramp.cols; ++u)
      ramp(v, u) = cv::Vec3b(60, static_cast<uchar>(4 * u), static_cast<uchar>(8 * v));
  }
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", ramp, jpeg, {cv::IMWRITE_JPEG_QUALITY, 95});
  const auto write = [&](const std::string& file, std::size_t size) {
    std::ofstream(folder_ / file, std::ios::binary)
        .write(reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(size));
  };
  write("rgb/0.png", jpeg.size());
  const RecordedFrame frame = SequenceReader(folder_, camera_).Read(0);
  constexpr double kJpegLoss = 12;  // grey levels, measured: 7 at this quality
  EXPECT_LT(cv::norm(frame.bgr, ramp, cv::NORM_INF), kJpegLoss);

  write("rgb/0.png", jpeg.size() - 40);
  ExpectReadError("rgb/0.png .*the image is truncated");
  // So is one that has a whole image inside: cameras put a small one into a segment of its own.
  std::vector<unsigned char> with_small{0xFF, 0xD8, 0xFF, 0xE1, 0x00,
                                        0x06, 0xFF, 0xD9, 0xFF, 0xD9};
  with_small.insert(with_small.end(), jpeg.begin() + 2, jpeg.end());
  std::swap(jpeg, with_small);
  write("rgb/0.png", jpeg.size());
  EXPECT_NO_THROW(SequenceReader(folder_, camera_).Read(0));
  write("rgb/0.png", jpeg.size() - 40);
  ExpectReadError("rgb/0.png .*the image is truncated");
  std::swap(jpeg, with_small);
  write("rgb/0.png", 12);
  ExpectReadError("rgb/0.png .*not a PNG or JPEG image");
  cv::imencode(".jpg", cv::Mat3b(24, 30), jpeg);
  write("rgb/0.png", jpeg.size());
  ExpectReadError("rgb/0.png .*the image is 30 x 24, the camera says 32 x 24");
}

TEST_F(Sequences, RefuseDepthAsJpeg) {
  WriteFrames({"1.0"});
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", cv::Mat1b(24, 32, uchar{90}), jpeg);
  std::ofstream(folder_ / "depth/0.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(jpeg.data()),
             static_cast<std::streamsize>(jpeg.size()));
  ExpectReadError("depth/0.png .*a JPEG, which does not keep depth; depth must be a PNG");
}

TEST_F(Sequences, RefuseAnImageWhoseBytesAreDamaged) {
  WriteFrames({"1.0"});
  const fs::path file = folder_ / "rgb/0.png";
  cv::Mat noise(24, 32, CV_8UC3);
  cv::randu(noise, 0, 256);
  cv::imwrite(file.string(), noise);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
  stream.write("\xFF\x00\xFF\x00\xFF\x00", 6);
  stream.close();
  ExpectReadError("rgb/0.png .*damaged");
}

TEST_F(Sequences, NeverOpenTheTruth) {
  WriteFrames({"1.0", "1.1"});
  // Were they opened, these would fail: folders in the place of files, and a loop.
  fs::create_directory(folder_ / "groundtruth.txt");
  fs::create_symlink("gt", folder_ / "gt");
  SequenceReader reader(folder_, camera_);
  EXPECT_EQ(reader.Read(1).timestamp_s, 1.1);
}

TEST(RealRecording, IsReadWholeThroughItsAssociations) {
  const fs::path folder = test_support::TumRecording();
  SKIP_WITHOUT(folder);
  SequenceReader reader(folder, TumCamera("tum1"));
  EXPECT_EQ(reader.size(), 37);
  EXPECT_TRUE(reader.warnings().empty());
  const RecordedFrame frame = reader.Read(36);
  EXPECT_EQ(frame.bgr.size(), cv::Size(640, 480));
  double nearest = 0, farthest = 0;
  cv::minMaxLoc(frame.depth_m, &nearest, &farthest, nullptr, nullptr, frame.depth_m > 0);
  EXPECT_GT(nearest, 0.4);  // what a Kinect can measure
  EXPECT_LT(farthest, 11.0);
}

}  // namespace
}  // namespace slam
