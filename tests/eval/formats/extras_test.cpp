// What `pas` writes beyond the formats, and another program means otherwise, is passed over with a
// warning.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "io/read_file.h"
#include "tests/eval/tiny_world.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TinyRun;
using testing::TinyWorld;
namespace fs = std::filesystem;

class ReadExtras : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = new TinyWorld;
    folder_ = new test_support::TemporaryFolder;
    world_->WriteSequence(seq());
  }
  static void TearDownTestSuite() {
    delete folder_;
    delete world_;
  }
  static fs::path seq() { return folder_->path() / "SEQ"; }
  static fs::path run() { return folder_->path() / "RUN"; }

  /// The run, read after `spoil` was made to it.
  static eval::Run RunWith(const std::function<void(TinyRun&)>& spoil) {
    TinyRun tiny(*world_);
    tiny.segmentation.clear();
    spoil(tiny);
    tiny.Write(run());
    return ReadRun(run());
  }
  static std::vector<std::string> Told(const std::vector<Fault>& warnings) {
    std::vector<std::string> lines;
    for (const Fault& fault : warnings) lines.push_back(Describe(fault));
    return lines;
  }
  static Sequence SequenceWith(const std::function<void(json&)>& spoil) {
    json scene = world_->SceneJson();
    spoil(scene);
    io::WriteFile(seq() / "gt/scene.json", scene.dump());
    Sequence sequence = ReadSequence(seq());
    io::WriteFile(seq() / "gt/scene.json", world_->SceneJson().dump());
    return sequence;
  }

  inline static TinyWorld* world_ = nullptr;
  inline static test_support::TemporaryFolder* folder_ = nullptr;
};

TEST_F(ReadExtras, OfRunJsonAreAnythingToOtherPrograms) {
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, json>>{{"camera", 3},
                                                 {"camera", {1, 2}},
                                                 {"camera", {{"fx", "wide"}}},
                                                 {"interrupted", "no"},
                                                 {"sequence_frames", "all"},
                                                 {"sequence_frames", -1},
                                                 {"sequence_absolute", 7}}) {
    const eval::Run read =
        RunWith([&, name = key, other = value](TinyRun& r) { r.info[name] = other; });
    EXPECT_THAT(Told(read.warnings), ElementsAre(HasSubstr("run.json /" + key)));
    EXPECT_FALSE(read.info.camera || read.info.interrupted || read.info.sequence_frames);
  }
}

TEST_F(ReadExtras, OfMapPlanesAreAnythingToOtherPrograms) {
  for (const auto& [key, value] : std::vector<std::pair<std::string, json>>{
           {"covariance", {1, 0, 0}},
           {"covariance", {{1, 0}, {0, 1}}},
           {"covariance", "none"},
           {"split_from", "the desk"},
           {"split_from", -1},
           {"split_from", 4711},
           {"split_from", TinyRun::MapId(TinyWorld::kDeskTop)},
           {"split_at", "later"}}) {
    const eval::Run read = RunWith([&, name = key, other = value](TinyRun& r) {
      ASSERT_EQ(r.map["planes"][0]["id"], TinyRun::MapId(TinyWorld::kDeskTop));
      r.map["planes"][0][name] = other;
    });
    EXPECT_THAT(Told(read.warnings), ElementsAre(HasSubstr("map.json /planes/0/" + key)));
    EXPECT_FALSE(read.map[0].split_from.has_value());
    EXPECT_EQ(read.map[0].covariance.has_value(), key != "covariance");
  }
}

TEST_F(ReadExtras, ACovarianceOfTheRightShapeThatIsNoneIsRefused) {
  const std::string refusal = test_support::RefusalOf(
      [] { RunWith([](TinyRun& r) { r.map["planes"][0]["covariance"][0] = -1.0; }); });
  EXPECT_THAT(refusal, HasSubstr("negative variance"));
}

TEST_F(ReadExtras, AFileOfTheNameOfCovariancesMayBeAnother) {
  const auto read_with = [](const std::string& text) {
    RunWith([](TinyRun&) {});
    io::WriteFile(run() / "trajectory_covariance.txt", text);
    return ReadRun(run());
  };
  const std::string six = "0 1 2 3 4 5 6\n1 1 2 3 4 5 6\n";
  const eval::Run other = read_with(six);
  EXPECT_FALSE(other.covariances.has_value());
  EXPECT_THAT(Summaries(other.warnings, "RUN"),
              ElementsAre(HasSubstr("expected a stamp and 21 finite numbers")));
  // Among lines of the right form one of another is left out.
  const eval::Run one = read_with("0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n0.1 0 0 nan\n");
  ASSERT_TRUE(one.covariances.has_value());
  EXPECT_EQ(one.covariances->size(), 1u);
  EXPECT_TRUE(read_with("# no pose\n").covariances.has_value());
}

TEST_F(ReadExtras, OfTheSceneAreAnythingToOtherPrograms) {
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, json>>{{"name", 3},
                                                 {"shape", {{"kind", "box"}}},
                                                 {"detection_group", "books"},
                                                 {"detection_group", 1.5}}) {
    const Sequence sequence = SequenceWith(
        [&, name = key, other = value](json& scene) { scene["objects"][0][name] = other; });
    EXPECT_THAT(Told(sequence.warnings), ElementsAre(HasSubstr("/objects/0/" + key)));
    EXPECT_EQ(sequence.scene->objects[0].detection_group, 0);
  }
  for (const json& holes : {json(2), json("two"), json{1, 2}, json{{{0, 0}, {1, 1}, {2, 2}}}}) {
    const Sequence sequence =
        SequenceWith([&](json& scene) { scene["planes"][0]["holes"] = holes; });
    EXPECT_THAT(Told(sequence.warnings), ::testing::Contains(HasSubstr("/planes/0/holes")));
    EXPECT_TRUE(sequence.scene->planes[0].holes_g.empty());
  }
}

TEST_F(ReadExtras, ATrueCameraThatIsSomethingElseLeavesTheCamera) {
  const auto true_fx = [](const std::string& text) {
    io::WriteFile(seq() / "gt/camera.yaml", text);
    const Sequence sequence = ReadSequence(seq());
    EXPECT_THAT(Told(sequence.warnings), ElementsAre(HasSubstr("gt/camera.yaml")));
    return sequence.true_camera->fx;
  };
  for (const char* text :
       {"a: [1\n", "- 1\n- 2\n", "position: [0, 0, 1]\n", "fx: 500\nfy: 500\n"}) {
    EXPECT_EQ(true_fx(text), TinyWorld::kFocal) << text;
  }
  // One with all of the keys is ours, and a wrong number in it would be in figures.
  std::string ours = io::ReadFile(seq() / "camera.yaml");
  ours.replace(ours.find("fx: 150"), 7, "fx: -15");
  io::WriteFile(seq() / "gt/camera.yaml", ours);
  EXPECT_THAT(test_support::RefusalOf([] { ReadSequence(seq()); }), HasSubstr("fx"));
  fs::remove(seq() / "gt/camera.yaml");
}

}  // namespace
}  // namespace eval
