#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "eval/formats/pose/trajectory.h"
#include "eval/formats/run/run.h"
#include "eval/formats/sequence/image_lists.h"
#include "eval/formats/sequence/sequence.h"
#include "io/atomic_file.h"
#include "io/read_file.h"
#include "tests/eval/tiny_world.h"
#include "tests/support/refusal.h"
#include "tests/support/shared_data.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using test_support::RefusalOf;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class ReadFolders : public ::testing::Test {
 protected:
  fs::path Write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    io::WriteFile(folder_ / name, text);
    return folder_ / name;
  }

  void Replace(const std::string& name, const std::string& what, const std::string& by) const {
    std::string text = io::ReadFile(folder_ / name);
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    Write(name, text.replace(at, what.size(), by));
  }

  test_support::TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  Folder in_{folder_};
};

TEST_F(ReadFolders, ReadTheUpperTriangleOfACovarianceRowByRow) {
  Write("trajectory_covariance.txt",
        "# t c11 ...\n2.5 1 0 0 0 0 .5 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n"
        "1.5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  const auto covariances = ReadPoseCovariances(in_).value();
  ASSERT_EQ(covariances.size(), 2u);
  EXPECT_EQ(covariances[0].stamp_s, 1.5);
  EXPECT_TRUE(covariances[0].of_xi.isZero(0.0));
  Matrix6d expected = Eigen::DiagonalMatrix<double, 6>(
      (Eigen::Matrix<double, 6, 1>() << 1, 2, 3, 4, 5, 6).finished());
  expected(0, 5) = expected(5, 0) = 0.5;
  EXPECT_EQ(covariances[1].of_xi, expected);

  Write("map.json",
        R"({"planes": [{"id": 3, "normal": [0, 0, 1], "d": 0, "vertices": [], "hull": [],
            "covariance": [1, 0, 0, 0.5, 2, 0, 0, 3, 0, 4]}]})");
  const auto map = ReadRunMap(in_).value();
  Eigen::Matrix4d of_plane = Eigen::Vector4d(1, 2, 3, 4).asDiagonal();
  of_plane(0, 3) = of_plane(3, 0) = 0.5;
  ASSERT_TRUE(map.at(0).covariance.has_value());
  EXPECT_EQ(*map[0].covariance, of_plane);
}

TEST_F(ReadFolders, RefuseWhatIsNoCovariance) {
  for (const char* line :
       {"1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 -1",        // negative
        "1 1 1.01 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1",      // correlated beyond one
        "1 0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1",         // known, and yet not
        "1 1e-8 0 0 0 0 1e-3 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1"})  // small numbers too
  {
    Write("trajectory_covariance.txt", std::string(line) + "\n");
    EXPECT_THAT(RefusalOf([&] { ReadPoseCovariances(in_); }),
                HasSubstr("trajectory_covariance.txt:1"))
        << line;
  }
}

TEST_F(ReadFolders, TrajectoryNormalisesQuaternionsAndSkipsComments) {
  Write("t.txt", "# a comment\n\n1.5 1 2 3 0 0 0 1.0005\r\n2.5\t1 2 3 0 0 1 0\n");
  const Trajectory trajectory = ReadTrajectory(in_, "t.txt");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp_s, 1.5);
  EXPECT_TRUE(trajectory[0].T_wc.R.isIdentity(1e-15));
  EXPECT_EQ(trajectory[1].T_wc.t, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(trajectory[1].T_wc.R(0, 0), -1.0, 1e-15);
}

TEST_F(ReadFolders, TrajectoryNamesTheLineOfEveryFault) {
  for (const char* line : {"1 2 3 4 5 6 7", "1 2 3 4 0 0 0 0", "1 2 3 4 0 0 0 10",
                           "1 1e200 3 4 0 0 0 1", "1 2 3 x 0 0 0 1", "1 nan 0 0 0 0 0 1",
                           "1 1e999 0 0 0 0 0 1", "1 2 3 4 0 0 0 1 9", "1,5 0 0 0 0 0 0 1"}) {
    Write("t.txt", std::string("1 0 0 0 0 0 0 1\n") + line + "\n");
    EXPECT_THAT(RefusalOf([&] { ReadTrajectory(in_, "t.txt"); }),
                HasSubstr("t.txt:2: expected"))
        << line;
  }
}

TEST_F(ReadFolders, AMissingFileIsNamed) {
  EXPECT_THAT(RefusalOf([&] { ReadSequence(folder_ / "nowhere"); }), HasSubstr("nowhere"));
  EXPECT_THAT(RefusalOf([&] { ReadSequence(folder_); }), HasSubstr("is an empty folder"));
  EXPECT_THAT(RefusalOf([&] { ReadRun(folder_); }), HasSubstr("is an empty folder"));
  Write("rgb.txt", "1 rgb/1.png\n");
  EXPECT_THAT(RefusalOf([&] { ReadSequence(folder_); }), HasSubstr("depth.txt"));
  EXPECT_THAT(RefusalOf([&] { ReadRun(folder_); }), HasSubstr("run folder"));
  Write("run.json", "{\"format\": \"pas-run/1\", \"sequence\": \"SEQ\"}");
  EXPECT_THAT(RefusalOf([&] { ReadRun(folder_); }), HasSubstr("trajectory.txt"));
}

TEST_F(ReadFolders, FramesAreAssociatedByNearestTimeWithinTwentyMilliseconds) {
  Write("rgb.txt", "# c\n1.000 rgb/a.png\n2.000 rgb/b.png\n3.000 rgb/c.png\n");
  Write("depth.txt", "1.019 depth/a.png\n2.021 depth/b.png\n2.995 depth/c.png\n3.004 d.png\n");
  const Sequence sequence = ReadSequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 2u);
  EXPECT_EQ(sequence.frames[0].depth, "depth/a.png");
  EXPECT_EQ(sequence.frames[1].depth, "d.png");
  EXPECT_FALSE(sequence.synthetic);
  EXPECT_FALSE(sequence.camera || sequence.groundtruth || sequence.scene);
}

TEST_F(ReadFolders, PairsTheNearestImagesFirst) {
  Folder folder(folder_);
  const auto frames =
      AssociateByTime(folder, {{1.0, "rgb/a", 1}, {1.018, "rgb/b", 2}, {1.05, "rgb/c", 3}},
                      {{1.015, "depth/a", 1}, {1.049, "depth/b", 2}, {1.06, "depth/c", 3}});
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].rgb + " " + frames[0].depth, "rgb/b depth/a");
  EXPECT_EQ(frames[1].rgb + " " + frames[1].depth, "rgb/c depth/b");
  EXPECT_EQ(frames[1].depth_stamp_s, 1.049);
}

TEST_F(ReadFolders, ADepthImageBelongsToOneFrameAlone) {
  // Depth at half the rate of colour: the frames that the estimator is given, not twice as many.
  std::string rgb, depth;
  for (int i = 0; i < 8; ++i) {
    rgb += std::to_string(1.0 + 0.02 * i + 0.001) + " rgb/" + std::to_string(i) + ".png\n";
    if (i % 2 == 0) depth += std::to_string(1.0 + 0.02 * i) + " d" + std::to_string(i) + "\n";
  }
  Write("rgb.txt", rgb + "1.001 rgb/again.png\n");
  Write("depth.txt", depth);
  const Sequence sequence = ReadSequence(folder_);
  ASSERT_EQ(sequence.frames.size(), 4u);
  EXPECT_EQ(sequence.frames[3].depth, "d6");
  EXPECT_EQ(sequence.warnings.size(), 1u);  // the stamp that comes again
}

TEST_F(ReadFolders, AFileOutsideTheFolderIsRefused) {
  for (const char* outside : {"../rgb/a.png", "/tmp/a.png", "depth/../../a.png"}) {
    for (const std::string& line : {std::string("1 ") + outside + " 1 depth/a.png",
                                    std::string("1 rgb/a.png 1 ") + outside}) {
      Write("associations.txt", line + "\n");
      EXPECT_THAT(RefusalOf([&] { ReadSequence(folder_); }),
                  AllOf(HasSubstr("associations.txt:1"), HasSubstr(outside),
                        HasSubstr("outside the folder")))
          << line;
    }
  }
}

TEST_F(ReadFolders, CameraFaultsNameKeyAndLine) {
  const std::string good =
      "model: pinhole\nwidth: 640\nheight: 480\nfx: 500\nfy: 500\ncx: 1\ncy: 2\nfps: 30\n"
      "depth_factor: 5000\nunknown: [1, 2]\n";
  Write("camera.yaml", good);
  EXPECT_EQ(ReadCamera(in_)->fx, 500.0);
  Write("camera.yaml", "width: 640\n");
  EXPECT_THAT(RefusalOf([&] { ReadCamera(in_); }), HasSubstr("height"));
  Write("camera.yaml", good);
  Replace("camera.yaml", "fx: 500", "fx: -1");
  EXPECT_THAT(RefusalOf([&] { ReadCamera(in_); }), AllOf(HasSubstr(":4:"), HasSubstr("fx")));
  Write("camera.yaml", "a: [1\n");
  EXPECT_THAT(RefusalOf([&] { ReadCamera(in_); }), HasSubstr("not valid YAML"));
}

TEST_F(ReadFolders, SequenceAndRunComeBackAsTheyWereWritten) {
  const testing::TinyWorld world;
  world.WriteSequence(folder_ / "SEQ");
  const testing::TinyRun tiny(world);
  tiny.Write(folder_ / "RUN");
  const Sequence sequence = ReadSequence(folder_ / "SEQ");
  EXPECT_TRUE(sequence.synthetic);
  ASSERT_EQ(sequence.frames.size(), world.frames.size());
  ASSERT_TRUE(sequence.scene && sequence.groundtruth && sequence.camera);
  EXPECT_EQ(sequence.scene->planes.size(), world.planes.size());
  EXPECT_TRUE(sequence.scene->FindPlane(1)->scored);
  EXPECT_EQ(sequence.scene->FindPlane(999), nullptr);
  EXPECT_EQ(sequence.scene->FindObject(testing::TinyWorld::kToy)->role, Role::kUnstructured);
  for (const testing::TinyFrame& frame : world.frames) {
    const auto ids = ReadPlaneIds(sequence, frame.stamp_s);
    ASSERT_TRUE(ids.has_value());
    EXPECT_EQ(cv::countNonZero(*ids != frame.plane_ids), 0);
  }
  EXPECT_FALSE(ReadPlaneIds(sequence, 1000.0).has_value());

  const eval::Run run = ReadRun(folder_ / "RUN");
  EXPECT_EQ(fs::canonical(SequenceOf(run)), fs::canonical(folder_ / "SEQ"));
  ASSERT_EQ(run.trajectory.size(), tiny.trajectory.size());
  EXPECT_TRUE(run.trajectory[7].T_wc.R.isApprox(tiny.trajectory[7].second.R, 1e-14));
  EXPECT_EQ(run.frames[3].planes.size(), tiny.frames[3]["planes"].size());
  EXPECT_EQ(run.frames[0].planes[0].decision, "new");
  EXPECT_FALSE(run.frames[0].planes[0].bad.has_value());
  EXPECT_EQ(run.timing->modules, (std::vector<std::string>{"orb", "mt"}));
  EXPECT_EQ(run.timing->rows_ms[5][1], 10.0);
  EXPECT_EQ(run.info.peak_memory_mb, 128.5);
}

TEST_F(ReadFolders, JsonFaultsNameFileLineAndKey) {
  const testing::TinyWorld world;
  testing::TinyRun tiny(world);
  const auto error_with = [&](const char* key, const nlohmann::json& value) {
    testing::TinyRun broken = tiny;
    broken.segmentation.clear();
    auto& plane = broken.frames[4]["planes"][1];
    if (value.is_discarded()) {
      plane.erase(key);
    } else {
      plane[key] = value;
    }
    broken.Write(folder_ / "RUN");
    return RefusalOf([&] { ReadRun(folder_ / "RUN"); });
  };
  const nlohmann::json gone(nlohmann::json::value_t::discarded);
  for (const char* key :
       {"index", "normal", "d", "centroid", "pixels", "map_plane", "decision"}) {
    EXPECT_THAT(error_with(key, gone), AllOf(HasSubstr("frame_planes.jsonl:5"),
                                             HasSubstr("/planes/1"), HasSubstr(key)));
  }
  EXPECT_THAT(error_with("normal", {0, 0, 2}), HasSubstr("unit normal"));
  EXPECT_THAT(error_with("normal", {0, 1}), HasSubstr("3 finite numbers"));
  EXPECT_THAT(error_with("d", "near"),
              HasSubstr("/planes/1/d: is \"near\"; expected a finite number"));
  EXPECT_THAT(error_with("index", 255), HasSubstr("from 0 to 254"));
  EXPECT_THAT(error_with("index", 1.5), HasSubstr("whole number"));
  EXPECT_THAT(error_with("decision", "maybe"), HasSubstr("matched, new, none"));
  EXPECT_EQ(error_with("some_unknown_key", 3), "");
}

TEST_F(ReadFolders, AFileThatIsCutOffIsAnErrorWithItsLine) {
  Write("frame_planes.jsonl", "{\"timestamp\": 1, \"planes\": []}\n{\"timestamp\": 2, \"pla");
  EXPECT_THAT(RefusalOf([&] { ReadRunFrames(in_); }),
              AllOf(HasSubstr("frame_planes.jsonl:2"), HasSubstr("cut off")));
  Write("map.json", "{\n\"planes\": [\n{\"id\": 1,,\n");
  EXPECT_THAT(RefusalOf([&] { ReadRunMap(in_); }), HasSubstr("map.json:3"));
}

TEST_F(ReadFolders, TimingKeepsTheFramesInWhichAModuleDidNotRun) {
  Write("timing.csv", "timestamp,orb,da\n1.0,4.5,\n2.0,,3\n");
  const Timing timing = ReadTiming(in_);
  EXPECT_TRUE(std::isnan(timing.rows_ms[0][1]));
  EXPECT_TRUE(std::isnan(timing.rows_ms[1][0]));
  EXPECT_EQ(timing.rows_ms[1][1], 3.0);
  Write("t.csv", "timestamp,orb\n1,2,3\n");
  EXPECT_THAT(RefusalOf([&] { ReadTiming(in_, "t.csv"); }), HasSubstr("t.csv:2"));
}

TEST_F(ReadFolders, TimingIsByTimeWhateverItsRowsOrder) {
  Write("timing.csv", "timestamp,orb\n2.0,3\n1.0,4.5\n");
  const Timing timing = ReadTiming(in_);
  EXPECT_EQ(timing.stamps_s, (std::vector<double>{1, 2}));
  EXPECT_EQ(timing.rows_ms, (std::vector<std::vector<double>>{{4.5}, {3}}));
}

TEST_F(ReadFolders, TimingKeepsTheFirstRowOfAFrame) {
  Write("timing.csv", "timestamp,orb\n1.0,3\n2.0,4\n2.000001,9\n1.0,9\n3.0,5\n");
  const Timing timing = ReadTiming(in_);
  EXPECT_EQ(timing.stamps_s, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(timing.rows_ms, (std::vector<std::vector<double>>{{3}, {4}, {5}}));
  EXPECT_EQ(in_.faults().size(), 2u);
}

TEST_F(ReadFolders, APoseThatComesAgainIsRefusedAlsoBehindLaterOnes) {
  Write("run.json", "{\"format\": \"pas-run/1\", \"sequence\": \"SEQ\"}");
  Write("trajectory.txt", "1 0 0 0 0 0 0 1\n2 0 0 1 0 0 0 1\n1 0 0 1 0 0 0 1\n");
  EXPECT_THAT(RefusalOf([&] { ReadRun(folder_); }),
              AllOf(HasSubstr("trajectory.txt:3"), HasSubstr("comes a second time")));
}

TEST_F(ReadFolders, TwoPosesForOneFrameAreRefused) {
  Write("run.json", "{\"format\": \"pas-run/1\", \"sequence\": \"SEQ\"}");
  Write("trajectory.txt", "1 0 0 0 0 0 0 1\n1 0 0 1 0 0 0 1\n");
  EXPECT_THAT(RefusalOf([&] { ReadRun(folder_); }), HasSubstr("trajectory.txt"));
}

TEST_F(ReadFolders, TheRunsSequenceThatIsNowhereIsNamedWithBothPlaces) {
  Write("run.json", "{\"format\": \"pas-run/1\", \"sequence\": \"lost\"}");
  Write("trajectory.txt", "1 0 0 0 0 0 0 1\n");
  EXPECT_THAT(RefusalOf([&] { SequenceOf(ReadRun(folder_)); }),
              AllOf(HasSubstr("run.json"), HasSubstr("lost"), HasSubstr("--truth")));
}

TEST_F(ReadFolders, TheRunsSequenceIsFoundWhereverTheTwoWereMoved) {
  const auto found = [&](const std::string& sequence, const std::string& absolute) {
    Write("a/run/run.json",
          nlohmann::json{
              {"format", "pas-run/1"}, {"sequence", sequence}, {"sequence_absolute", absolute}}
              .dump());
    Write("a/run/trajectory.txt", "1 0 0 0 0 0 0 1\n");
    return fs::weakly_canonical(SequenceOf(ReadRun(folder_ / "a/run")));
  };
  fs::create_directories(folder_ / "a/seq");
  fs::create_directories(folder_ / "a/run/truth");
  const fs::path seq = fs::weakly_canonical(folder_ / "a/seq");
  EXPECT_EQ(found("../seq", "/nowhere"), seq);
  EXPECT_EQ(found("seq", "/nowhere"), seq);
  EXPECT_EQ(found(seq.string(), ""), seq);
  EXPECT_EQ(found("../moved/away", seq.string()), seq);
  EXPECT_EQ(found("truth", seq.string()), fs::weakly_canonical(folder_ / "a/run/truth"));

  // From the run, and only then from where the program was called: another one may lie there.
  fs::create_directories(folder_ / "b/seq");
  fs::create_directories(folder_ / "b/other");
  const fs::path called_from = fs::current_path();
  fs::current_path(folder_ / "b");
  EXPECT_EQ(found("seq", ""), seq);
  EXPECT_EQ(found("other", ""), fs::weakly_canonical(folder_ / "b/other"));
  fs::current_path(called_from);
}

TEST(ReadRecording, FindsTheFramesAndTheTruthOfARealSequence) {
  const fs::path folder = test_support::TumRecording();
  SKIP_WITHOUT(folder);
  const Sequence sequence = ReadSequence(folder);
  EXPECT_EQ(sequence.frames.size(), 37u);
  EXPECT_FALSE(sequence.synthetic);
  EXPECT_GT(sequence.groundtruth.value().size(), 100u);
}

}  // namespace
}  // namespace eval
