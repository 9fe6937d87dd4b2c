// One input, one result: whatever the number of threads, the place, the time zone, the locale,
// the delays of the disk and the kills in between, every artefact from the first frame to the
// scores has the same bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using namespace program;

/// Every artefact by its name, those made first before those made of them.
using Artefacts = std::vector<std::pair<std::string, std::string>>;

/// What may differ, by name: times, memory, and where things lie.
std::string WithoutTimes(const std::string& name, const std::string& bytes) {
  if (name != "run/run.json" && name != "run/metrics.json") return bytes;
  nlohmann::json json = nlohmann::json::parse(bytes);
  for (const char* key :
       {"wall_time_s", "peak_memory_mb", "sequence", "sequence_absolute", "timing_ms"}) {
    json.erase(key);
  }
  return json.dump();
}

/// Place of an artefact in the order in which things are made.
int Stage(const std::string& name) {
  const std::vector<std::string> order{"seq/camera.yaml",
                                       "seq/groundtruth.txt",
                                       "seq/gt/scene.json",
                                       "seq/rgb.txt",
                                       "seq/depth.txt",
                                       "seq/associations.txt",
                                       "seq/rgb/",
                                       "seq/gt/plane_id/",
                                       "seq/gt/object_id/",
                                       "seq/depth/",
                                       "seq/gt/",
                                       "seq/detections",
                                       "seq/",
                                       "run/segmentation/",
                                       "run/frame_planes",
                                       "run/trajectory",
                                       "run/keyframes",
                                       "run/map",
                                       "run/run",
                                       "run/"};
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (name.starts_with(order[i])) return static_cast<int>(i);
  }
  return static_cast<int>(order.size());
}

Artefacts ArtefactsOf(const fs::path& folder) {
  Artefacts artefacts;
  for (const auto& [name, bytes] : Contents(folder)) {
    if (name == "run/timing.csv") continue;
    artefacts.emplace_back(name, WithoutTimes(name, bytes));
  }
  std::stable_sort(artefacts.begin(), artefacts.end(), [](const auto& a, const auto& b) {
    return Stage(a.first) < Stage(b.first);
  });
  return artefacts;
}

/// Name of the first artefact that differs; empty when none does.
std::string FirstDifference(const Artefacts& a, const Artefacts& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (i >= b.size() || a[i].first != b[i].first) return a[i].first + " (missing)";
    if (a[i].second != b[i].second) return a[i].first;
  }
  return a.size() == b.size() ? "" : b[a.size()].first + " (more than there should be)";
}

struct Circumstances {
  int threads = 1;
  Environment environment = {};
  std::string place = ".";
  int kill_at = 0;  ///< operation of `pas sim` at which it is killed, then resumed
  int seed = 1;
  /// What `pas scene make` is asked for; empty: a scene of the catalogue.
  std::vector<std::string> scene = {};
};

class SameBytes : public testing::Test {
 protected:
  /// scene -> sequence -> run -> metrics, by the program itself.
  Artefacts Make(const std::string& name, const Circumstances& how) const {
    const fs::path out = folder_ / name / how.place;
    fs::create_directories(out);
    const std::string threads = std::to_string(how.threads);
    fs::path scene = fs::path(PAS_SOURCE_DIR) / "scenes/ambiguous/desk.yaml";
    if (!how.scene.empty()) {
      scene = out / "scene.yaml";
      std::vector<std::string> make{Pas(), "-q", "scene", "make", "-o", scene};
      make.insert(make.end(), how.scene.begin(), how.scene.end());
      EXPECT_EQ(Run(make, how.environment).exit_code, 0);
    }
    std::vector<std::string> sim{
        Pas(),       "-q",      "sim", scene,      "-o",  out / "seq", "--frames",
        "6",         "--width", "320", "--height", "240", "--seed",    std::to_string(how.seed),
        "--threads", threads};
    if (how.kill_at > 0) {
      Environment interrupted = how.environment;
      interrupted["PAS_INTERRUPT_KILL"] = std::to_string(how.kill_at);
      EXPECT_EQ(Run(sim, interrupted).signal, SIGKILL);
      sim.push_back("--resume");
    }
    EXPECT_EQ(Run(sim, how.environment).exit_code, 0);
    const Outcome slam = Run({Pas(), "-q", "slam", out / "seq", "-o", out / "run", "--threads",
                              threads, "--save-segmentation"},
                             how.environment);
    EXPECT_EQ(slam.exit_code, 0) << slam.errors;
    const Outcome eval = Run({Pas(), "-q", "eval", out / "run"}, how.environment);
    EXPECT_EQ(eval.exit_code, 0) << eval.errors;
    return ArtefactsOf(out);
  }

  Outcome Run(const std::vector<std::string>& command, Environment environment) const {
    environment["LD_PRELOAD"] = PAS_FILE_INTERRUPTER;
    environment["PAS_INTERRUPT_FOLDER"] = "/seq";
    environment["ASAN_OPTIONS"] = "verify_asan_link_order=0";
    return Process(command, environment, folder_ / "errors").Wait();
  }

  TemporaryFolder folder_;
};

TEST_F(SameBytes, ComeOutUnderAllCircumstances) {
  const Artefacts once = Make("once", {});
  ASSERT_GT(once.size(), 6u * 5u + 12u);
  const std::map<std::string, Circumstances> all{
      {"again, with two threads", {.threads = 2}},
      {"three threads in another time zone",
       {.threads = 3, .environment = {{"TZ", "Pacific/Kiritimati"}}}},
      {"four threads in another place, German habits",
       {.threads = 4,
        .environment = {{"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}},
        .place = "an other/place"}},
      {"eight threads and a slow disk",
       {.threads = 8, .environment = {{"PAS_INTERRUPT_DELAY", "2000"}}}},
      {"killed and resumed", {.threads = 2, .kill_at = 60}}};
  for (const auto& [name, how] : all) {
    EXPECT_EQ(FirstDifference(once, Make(name, how)), "") << "differs first: " << name;
  }
}

TEST_F(SameBytes, ComeOutOfEveryKindOfScene) {
  const std::vector<std::vector<std::string>> scenes{
      {"--family", "coplanar", "--seed", "3"},
      {"--family", "passer", "--seed", "5", "--set", "kind=3"},  // toys, and what moves
      {"--twin", "fr1-xyz"}};                                    // a lens
  for (const auto& scene : scenes) {
    const Artefacts once = Make(scene[1] + "_once", {.scene = scene});
    ASSERT_GT(once.size(), 6u * 5u);
    const Circumstances other{.threads = 3,
                              .environment = {{"TZ", "Pacific/Kiritimati"},
                                              {"LC_ALL", "de_DE.UTF-8"},
                                              {"PAS_INTERRUPT_DELAY", "1000"}},
                              .place = "an other/place",
                              .kill_at = 60,
                              .scene = scene};
    EXPECT_EQ(FirstDifference(once, Make(scene[1] + "_other", other)), "") << scene[1];
  }
}

TEST_F(SameBytes, WouldTellWhatAnotherSeedChangesFirst) {
  const Artefacts once = Make("once", {});
  // Another seed records with another device.
  EXPECT_EQ(FirstDifference(once, Make("other", {.seed = 2})), "seq/camera.yaml");
  Artefacts changed = once;
  for (auto& [name, bytes] : changed) {
    if (name.starts_with("seq/depth/") || name.starts_with("run/map")) bytes += "x";
  }
  EXPECT_EQ(FirstDifference(once, changed), "seq/depth/0.015000.png");
}

}  // namespace
