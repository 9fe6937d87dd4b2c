#include "io/folder_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"
#include "tests/support/program.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class FolderKinds : public ::testing::Test {
 protected:
  /// A folder with these (empty) files.
  fs::path With(const std::string& name, const std::vector<std::string>& files) const {
    fs::create_directories(folder_ / name);
    for (const std::string& file : files) {
      fs::create_directories((folder_ / name / file).parent_path());
      std::ofstream(folder_ / name / file) << "";
    }
    return folder_ / name;
  }
  static auto Refused(const std::string& what, const std::string& mend) {
    return ThrowsMessage<InputError>(AllOf(HasSubstr(what), HasSubstr(mend)));
  }

  program::TemporaryFolder folder_;
};

TEST_F(FolderKinds, AreSeenFromTheNamesInThem) {
  EXPECT_EQ(KindOf(folder_ / "none"), FolderKind::kNothing);
  EXPECT_EQ(KindOf(With("empty", {})), FolderKind::kEmpty);
  EXPECT_EQ(KindOf(With("seq", {"rgb.txt", "depth.txt"})), FolderKind::kSequence);
  EXPECT_EQ(KindOf(With("run", {"run.json", "trajectory.txt"})), FolderKind::kRun);
  EXPECT_EQ(KindOf(With("run/..", {})), FolderKind::kOther);
  EXPECT_EQ(KindOf(With("pictures", {"contact_sheet.png"})), FolderKind::kPictures);
  EXPECT_EQ(KindOf(With("coco", {"export.json"})), FolderKind::kExport);
  EXPECT_EQ(KindOf(With("ros", {"a_0.db3"})), FolderKind::kRosBag);
  EXPECT_EQ(KindOf(With("bags", {"a.bag"}) / "a.bag"), FolderKind::kRosBag);
  EXPECT_EQ(KindOf(With("scan", {"color/0.jpg", "depth/0.png", "pose/0.txt"})),
            FolderKind::kScanNet);
  EXPECT_EQ(KindOf(With("seven", {"frame-000000.color.png"})), FolderKind::kSevenScenes);
  EXPECT_EQ(KindOf(With("fusion", {"frame-000000.color.jpg"})), FolderKind::kSevenScenes);
  EXPECT_EQ(KindOf(With("icl", {"scene_00_0000.depth"})), FolderKind::kIclNuim);
  EXPECT_EQ(KindOf(With("replica", {"traj.txt", "results/frame000000.jpg"})),
            FolderKind::kReplica);
  EXPECT_EQ(KindOf(With("replica", {}) / "results"), FolderKind::kImages);
  EXPECT_EQ(KindOf(With("ros", {}) / "a_0.db3"), FolderKind::kRosBag);
}

TEST_F(FolderKinds, ThatAreWrongAreNamedWithTheCommandThatTakesThem) {
  const fs::path seq = With("seq", {"rgb.txt"}), run = With("run", {"run.json"});
  EXPECT_THAT([&] { RequireRun(seq); },
              Refused("seq: is a sequence, expected a run folder", "pas slam " + seq.string()));
  EXPECT_THAT([&] { RequireSequence(run); },
              Refused("run: is a run of `pas slam`, expected a sequence folder", "pas eval"));
  EXPECT_THAT(
      [&] {
        RequireSequence(With("ros2", {"a_0.db3", "metadata.yaml"}));
      },
      Refused("is a ROS bag", "convert it to TUM's format"));
  EXPECT_THAT([&] { RequireRecording(folder_ / "ros2/a_0.db3"); },
              Refused("a_0.db3: is a ROS bag", "convert it to TUM's format"));
  EXPECT_THAT(
      [&] {
        RequireSequence(With("room0", {"traj.txt", "results/depth000000.png"}));
      },
      Refused("room0: is a recording of Replica as NICE-SLAM renders it",
              "docs/cameras.md says how"));
  const fs::path bags = With("ros", {"a.bag"});
  EXPECT_THAT([&] { RequireRecording(bags); },
              Refused("ros: is a ROS bag", "did you mean " + (bags / "a.bag").string()));
  EXPECT_THAT([&] { RequireSequence(bags / "a.bag"); },
              Refused("a.bag: is a ROS bag", "pas import"));
  EXPECT_NO_THROW(RequireRecording(bags / "a.bag"));
  EXPECT_NO_THROW(RequireRecording(seq));
  EXPECT_THAT([&] { RequireSequence(folder_ / "none"); }, Refused("none: no such folder", ""));
  EXPECT_NO_THROW(RequireSequence(seq));
  EXPECT_NO_THROW(RequireRun(run));
}

TEST_F(FolderKinds, OfABagThatIsNotThereSpeakOfBags) {
  EXPECT_THAT([&] { RequireRecording(folder_ / "none.bag"); },
              Refused("none.bag: no such file; expected a bag of ROS 1", ""));
  EXPECT_THAT([&] { RequireRecording(folder_ / "none"); }, Refused("no such folder", ""));
}

TEST_F(FolderKinds, OfAFileSaySo) {
  const fs::path file = With("a", {"scene.yaml"}) / "scene.yaml";
  EXPECT_THAT([&] { RequireSequence(file); },
              Refused("is a file, expected a sequence folder", "pas sim"));
}

TEST_F(FolderKinds, OneLevelTooHighPointToTheFolderWithin) {
  const fs::path seq = With("demo/sequence", {"rgb.txt"});
  With("demo/run", {"run.json"});
  EXPECT_THAT([&] { RequireSequence(folder_ / "demo"); },
              Refused("is a folder of another kind", "did you mean " + seq.string()));
  EXPECT_THAT([&] { RequireSequence(With("demo", {"a.png"})); },
              Refused("holds images without a list of them", "did you mean " + seq.string()));
}

TEST_F(FolderKinds, MayBeTwoAtOnce) {
  EXPECT_NO_THROW(RequireSequence(With("both", {"run.json", "trajectory.txt", "rgb.txt"})));
  EXPECT_NO_THROW(RequireRun(folder_ / "both"));
}

}  // namespace
}  // namespace io
