// The promise of `pas sim --resume`: killed at any moment, nothing that is there is half there,
// and the resumed sequence has the bytes of one that was never interrupted. A writer that does
// not take care fails the very same check, so the check can fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/image/decode_image.h"
#include "tests/support/program.h"

namespace {

using namespace program;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kMoments = 52;

/// Without prints, which take time to make.
constexpr const char* kScene = R"(format: pas-scene/1
name: two boards
motion: {preset: slow, target_m: [0, 0, 0.03], target_spread_m: 0.15}
objects:
  - {id: 1, name: floor, class: floor, role: structure, center_m: [0, 0, -0.05], size_m: [4, 4, 0.1]}
  - {id: 2, name: low, class: book, role: regular, center_m: [-0.16, 0, 0.02], size_m: [0.3, 0.3, 0.04]}
  - {id: 3, name: high, class: book, role: regular, center_m: [0.16, 0, 0.03], size_m: [0.3, 0.3, 0.06]}
)";

class KilledRun : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(scene()) << kScene;
    const Outcome outcome =
        Run(Command(folder_ / "whole"), {{"PAS_INTERRUPT_COUNT", (folder_ / "count").string()}},
            "whole");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    operations_ = Count();
    whole_ = Contents(folder_ / "whole");
    // Four images a frame, each opened, written, closed and renamed: if this is no longer so,
    // the writer does what the interrupter does not see.
    ASSERT_GT(operations_, 4 * 4 * kFrames);
  }

  long Count() const { return std::stol(ReadText(folder_ / "count")); }
  fs::path scene() const { return folder_ / "scene.yaml"; }
  std::vector<std::string> Command(const fs::path& output, bool resume = false) const {
    std::vector<std::string> command{Pas(),       "-q",   "sim",      scene(),
                                     "-o",        output, "--frames", std::to_string(kFrames),
                                     "--width",   "64",   "--height", "48",
                                     "--threads", "2"};
    if (resume) command.push_back("--resume");
    return command;
  }
  /// Runs with the interrupter in place, watching the folder called `watched`.
  Outcome Run(const std::vector<std::string>& command, Environment environment,
              const std::string& watched) const {
    environment["LD_PRELOAD"] = PAS_FILE_INTERRUPTER;
    environment["PAS_INTERRUPT_FOLDER"] = "/" + watched;
    environment["ASAN_OPTIONS"] = "verify_asan_link_order=0";
    return Process(command, environment, folder_ / "errors").Wait();
  }

  /// What is wrong with a folder in which a process was killed.
  std::string FaultsOf(const fs::path& folder) const {
    std::string faults;
    const auto found = Contents(folder);
    for (const auto& [file, bytes] : found) {
      if (fs::path(file).extension() == ".part") continue;
      const auto intact = whole_.find(file);
      if (file == "manifest.json" && (intact == whole_.end() || bytes != intact->second)) {
        const auto manifest = nlohmann::json::parse(bytes, nullptr, false);
        if (!manifest.is_object()) faults += "manifest.json is torn\n";
        if (manifest.is_object() && manifest.value("complete", true))
          faults += "manifest.json says complete\n";
      } else if (file.starts_with(".frames/")) {
        if (!nlohmann::json::accept(bytes)) faults += file + " is torn\n";
      } else if (intact == whole_.end()) {
        faults += file + " does not belong there\n";
      } else if (bytes != intact->second) {
        faults += file + " is torn\n";
      }
      if (file == "manifest.json" && intact != whole_.end() && bytes == intact->second) {
        if (found != whole_) faults += "complete, but files are missing\n";
      }
    }
    return faults;
  }
  std::string FaultsAfterResume(const fs::path& folder) const {
    return Contents(folder) == whole_ ? "" : "resumed to other bytes\n";
  }

  static constexpr int kFrames = 4;
  TemporaryFolder folder_;
  std::map<std::string, std::string> whole_;
  long operations_ = 0;
};

TEST_F(KilledRun, LeavesOnlyWholeFilesAndResumesToTheSameBytesAtEveryMoment) {
  for (const auto& [file, bytes] : whole_) {
    if (fs::path(file).extension() != ".png") continue;
    ASSERT_FALSE(io::DecodeImage(bytes).empty()) << file;
  }
  for (long i = 0; i < kMoments; ++i) {
    const std::string name = "killed" + std::to_string(i);
    const long moment = 1 + i * (operations_ - 1) / (kMoments - 1);
    const Outcome killed =
        Run(Command(folder_ / name), {{"PAS_INTERRUPT_KILL", std::to_string(moment)}}, name);
    ASSERT_EQ(killed.signal, SIGKILL) << "operation " << moment << " of " << operations_;
    EXPECT_EQ(FaultsOf(folder_ / name), "") << "operation " << moment;
    const Outcome resumed = Run(Command(folder_ / name, true), {}, name);
    EXPECT_EQ(resumed.exit_code, 0) << "operation " << moment << ": " << resumed.errors;
    EXPECT_EQ(FaultsAfterResume(folder_ / name), "") << "operation " << moment;
    fs::remove_all(folder_ / name);
  }
}

TEST_F(KilledRun, MayBeKilledAgainAndAgainWhileItResumes) {
  int kills = 0;
  for (bool done = false; !done; ++kills) {
    const Outcome outcome =
        Run(Command(folder_ / "stubborn", kills > 0),
            {{"PAS_INTERRUPT_KILL", std::to_string(20 + 7 * kills)}}, "stubborn");
    EXPECT_EQ(FaultsOf(folder_ / "stubborn"), "") << "kill " << kills;
    done = outcome.exit_code == 0;
    ASSERT_TRUE(done || outcome.signal == SIGKILL) << outcome.errors;
    ASSERT_LT(kills, 40);
  }
  EXPECT_GT(kills, 3);
  EXPECT_EQ(FaultsAfterResume(folder_ / "stubborn"), "");
}

TEST_F(KilledRun, HoldsForKillsFromOutsideTooAtAnyTime) {
  using Clock = std::chrono::steady_clock;
  const auto started = Clock::now();
  Process(Command(folder_ / "timed"), {}, folder_ / "errors").Wait();
  const auto whole_time = Clock::now() - started;
  for (int i = 0; i < 8; ++i) {
    const std::string name = "outside" + std::to_string(i);
    const Process process(Command(folder_ / name), {}, folder_ / "errors");
    std::this_thread::sleep_for(whole_time * (i + 1) / 9);
    process.Kill();
    process.Wait();
    EXPECT_EQ(FaultsOf(folder_ / name), "") << "kill " << i;
    Process(Command(folder_ / name, true), {}, folder_ / "errors").Wait();
    EXPECT_EQ(FaultsAfterResume(folder_ / name), "") << "kill " << i;
  }
}

TEST_F(KilledRun, WouldBeCaughtWritingInPlace) {
  const auto naive = [&](const std::string& name) {
    return std::vector<std::string>{PAS_NAIVE_WRITER, folder_ / "whole", folder_ / name};
  };
  Run(naive("careless"), {{"PAS_INTERRUPT_COUNT", (folder_ / "count").string()}}, "careless");
  const long operations = Count();
  int caught = 0;
  for (long i = 0; i < kMoments; ++i) {
    const std::string name = "naive" + std::to_string(i);
    const long moment = 1 + i * (operations - 1) / (kMoments - 1);
    const Outcome killed =
        Run(naive(name), {{"PAS_INTERRUPT_KILL", std::to_string(moment)}}, name);
    ASSERT_EQ(killed.signal, SIGKILL);
    std::string faults = FaultsOf(folder_ / name);
    Run(naive(name), {}, name);
    faults += FaultsAfterResume(folder_ / name);
    caught += faults.empty() ? 0 : 1;
  }
  // It is whole between two files only.
  EXPECT_GT(caught, kMoments / 3);
}

TEST_F(KilledRun, TellsOfAFullDiskWhereverItStrikesAndGoesOnAfterwards) {
  for (long i = 0; i < 8; ++i) {
    const std::string name = "full" + std::to_string(i);
    const long moment = 1 + i * (operations_ - 1) / 8;
    const Outcome outcome = Run(Command(folder_ / name),
                                {{"PAS_INTERRUPT_ERROR", std::to_string(ENOSPC)},
                                 {"PAS_INTERRUPT_FROM", std::to_string(moment)}},
                                name);
    EXPECT_EQ(outcome.exit_code, 2) << "operation " << moment;
    EXPECT_THAT(outcome.errors, HasSubstr("No space left on device"));
    EXPECT_THAT(outcome.errors, HasSubstr("/" + name)) << "must name the file";
    EXPECT_EQ(FaultsOf(folder_ / name), "") << "operation " << moment;
    const bool begun = fs::exists(folder_ / name / "manifest.json");
    if (!begun) fs::remove_all(folder_ / name);
    Run(Command(folder_ / name, begun), {}, name);
    EXPECT_EQ(FaultsAfterResume(folder_ / name), "") << "operation " << moment;
  }
}

TEST_F(KilledRun, TellsOfAFolderThatMayNotBeWritten) {
  for (const int error : {EACCES, EROFS}) {
    const Outcome outcome =
        Run(Command(folder_ / "locked"),
            {{"PAS_INTERRUPT_ERROR", std::to_string(error)}, {"PAS_INTERRUPT_FROM", "1"}},
            "locked");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.errors, HasSubstr(std::strerror(error)));
    EXPECT_THAT(outcome.errors, HasSubstr("/locked"));
    EXPECT_THAT(Contents(folder_ / "locked"), IsEmpty());
  }
}

TEST_F(KilledRun, IsNotResumedWithAnotherScene) {
  const Outcome killed = Run(Command(folder_ / "seq"),
                             {{"PAS_INTERRUPT_KILL", std::to_string(operations_ / 2)}}, "seq");
  ASSERT_EQ(killed.signal, SIGKILL);
  const auto before = Contents(folder_ / "seq");
  std::string text = ReadText(scene());
  text.replace(text.find("0.06]"), 5, "0.05]");
  std::ofstream(scene()) << text;
  const Outcome resumed = Run(Command(folder_ / "seq", true), {}, "seq");
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_THAT(resumed.errors, HasSubstr("cannot resume: scene_hash was"));
  EXPECT_THAT(resumed.errors, HasSubstr("--force"));
  EXPECT_EQ(Contents(folder_ / "seq"), before);
}

}  // namespace
