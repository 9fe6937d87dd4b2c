// A folder is there whole or not at all: at every moment at which its writer may be killed, and
// wherever the disk may be full. A writer that does not take care fails the very same check.
#include "io/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cerrno>
#include <optional>
#include <set>

#include "io/atomic_file.h"
#include "io/folder_lock.h"
#include "io/input_error.h"
#include "tests/support/program.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using program::Contents;
using program::Environment;
using program::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class OutputFolders : public ::testing::Test {
 protected:
  fs::path place() const { return folder_ / "out"; }
  /// Names in the folder above.
  std::set<std::string> Beside() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(place().parent_path())) {
      names.insert(entry.path().filename().string());
    }
    names.erase("errors");
    names.erase("count");
    return names;
  }
  void Make(bool force = false) const {
    OutputFolder output(place(), "marker.json", force);
    output.Write("marker.json", force ? "new" : "old");
    output.Commit();
  }
  auto Making(bool force) const {
    return [=, this] { Make(force); };
  }

  /// Runs a writer of three files with the interrupter in place.
  Outcome Run(const std::string& value, Environment environment = {}) const {
    environment["LD_PRELOAD"] = PAS_FILE_INTERRUPTER;
    environment["PAS_INTERRUPT_FOLDER"] = "/out";
    environment["PAS_INTERRUPT_COUNT"] = (folder_ / "count").string();
    environment["ASAN_OPTIONS"] = "verify_asan_link_order=0";
    return program::Process({PAS_FOLDER_WRITER, place(), value}, environment,
                            folder_ / "errors")
        .Wait();
  }
  long Operations() const { return std::stol(program::ReadText(folder_ / "count")); }

  program::TemporaryFolder folder_;
};

TEST_F(OutputFolders, AreThereWholeAfterCommitAndNotAtAllBefore) {
  OutputFolder output(place().string() + "/", "marker.json", false);
  output.Write("a.txt", "a");
  output.Write("deep/down/b.txt", "b");
  EXPECT_FALSE(fs::exists(place()));
  output.Commit();
  EXPECT_EQ(Contents(place()),
            (std::map<std::string, std::string>{{"a.txt", "a"}, {"deep/down/b.txt", "b"}}));
  EXPECT_THAT(Beside(), ElementsAre("out"));
  EXPECT_THROW(output.Write("late.txt", ""), std::invalid_argument);
}

TEST_F(OutputFolders, LeaveNothingWhenGivenUp) {
  { OutputFolder(place(), "marker.json", false).Write("a.txt", "a"); }
  EXPECT_THAT(Beside(), IsEmpty());
}

TEST_F(OutputFolders, ReplaceOneOfTheirKindWithForceAlone) {
  Make();
  EXPECT_THAT(Making(false),
              ThrowsMessage<InputError>(HasSubstr("out: exists already; choose another name "
                                                  "or pass --force")));
  EXPECT_EQ(Contents(place()).at("marker.json"), "old");
  WriteFile(place() / "of the old one.txt", "");
  Make(true);
  EXPECT_THAT(Contents(place()), ElementsAre(testing::Pair("marker.json", "new")));
  EXPECT_THAT(Beside(), ElementsAre("out"));
}

TEST_F(OutputFolders, ReplaceNoFolderOrFileOfAnotherKindEvenWithForce) {
  const auto refused =
      ThrowsMessage<InputError>(HasSubstr("out: exists and holds no marker.json"));
  fs::create_directories(place());
  WriteFile(place() / "thesis.tex", "years of work");
  EXPECT_THAT(Making(true), refused);
  EXPECT_EQ(Contents(place()).at("thesis.tex"), "years of work");
  fs::remove_all(place());
  WriteFile(place(), "a file");
  EXPECT_THAT(Making(true), ThrowsMessage<InputError>(HasSubstr(
                                "out: is a file, which even --force does not replace")));
  fs::remove(place());
  fs::create_symlink("nowhere", place());
  EXPECT_THAT(Making(true), ThrowsMessage<InputError>(HasSubstr("out: is a link, which even")));
  fs::remove(place());
  fs::create_directory(place());
  EXPECT_NO_THROW(Make(true)) << "an empty one is nobody's work";
}

TEST_F(OutputFolders, TakeThePlaceOfAnEmptyOneWithoutForce) {
  fs::create_directory(place());
  Make();
  EXPECT_EQ(Contents(place()).at("marker.json"), "old");
  EXPECT_THAT(Beside(), ElementsAre("out"));
}

TEST_F(OutputFolders, NeverTakeThePlaceOfTheCurrentOne) {
  fs::create_directory(place());
  const fs::path before = fs::current_path();
  fs::current_path(place());
  EXPECT_THAT([] { OutputFolder(".", "marker.json", true); },
              ThrowsMessage<InputError>(HasSubstr("is the folder you are in")));
  fs::current_path(before);
}

TEST_F(OutputFolders, LeaveNoFolderAboveThemWhenGivenUp) {
  { OutputFolder(place() / "deep/down", "marker.json", false).Write("a.txt", "a"); }
  EXPECT_THAT(Beside(), IsEmpty());
  fs::create_directory(place());
  { OutputFolder(place() / "deep/down", "marker.json", false).Write("a.txt", "a"); }
  EXPECT_THAT(Beside(), ElementsAre("out"));
}

TEST_F(OutputFolders, ReplaceNothingThatAppearedWhileTheyWereWritten) {
  OutputFolder output(place(), "marker.json", true);
  fs::create_directories(place());
  WriteFile(place() / "thesis.tex", "years of work");
  EXPECT_THROW(output.Commit(), InputError);
  EXPECT_EQ(Contents(place()).at("thesis.tex"), "years of work");
}

// Of two commands that write to one place at once, the later must not spoil the earlier one's.
TEST_F(OutputFolders, LeaveTheUnfinishedOneOfAProcessThatStillRunsAlone) {
  const fs::path theirs = place().string() + ".partial-" + std::to_string(::getppid());
  fs::create_directory(theirs);
  WriteFile(theirs / "a.txt", "a");
  Make();
  EXPECT_EQ(Contents(theirs), (std::map<std::string, std::string>{{"a.txt", "a"}}));
}

TEST_F(OutputFolders, AreWrittenByOneProcessAtATime) {
  const fs::path theirs = place().string() + ".partial-" + std::to_string(::getppid());
  std::optional<FolderLock> lock(std::in_place, theirs);
  WriteFile(theirs / "a.txt", "a");
  const auto refused =
      ThrowsMessage<InputError>(HasSubstr("out: is being written by another process"));
  EXPECT_THAT(Making(true), refused);
  EXPECT_THAT([this] { OutputFolder::RequirePlace(place(), "marker.json", false); }, refused);
  EXPECT_THAT(Beside(), ElementsAre(theirs.filename().string())) << "nothing of ours is left";
  lock.reset();
  EXPECT_NO_THROW(Make());
  EXPECT_EQ(Contents(theirs).at("a.txt"), "a");
}

TEST_F(OutputFolders, AreWrittenOnceAtATimeByOneProcess) {
  OutputFolder first(place(), "marker.json", false);
  first.Write("marker.json", "first");
  EXPECT_THAT(Making(true), ThrowsMessage<InputError>(HasSubstr("is being written")));
  first.Commit();
  EXPECT_EQ(Contents(place()).at("marker.json"), "first");
}

TEST_F(OutputFolders, ReplaceNoMountPoint) {
  EXPECT_THAT([] { OutputFolder::RequirePlace("/proc", "marker.json", true); },
              ThrowsMessage<InputError>(HasSubstr("/proc: is a mount point, so it cannot be "
                                                  "replaced; name a folder in it")));
}

TEST_F(OutputFolders, ReplaceNoFolderWhoseNeighboursTheyMayNotBe) {
  const uid_t user = ::geteuid();
  fs::create_directory(place());
  fs::permissions(place().parent_path(), fs::perms(0555));
  if (user == 0) {
    ASSERT_EQ(::seteuid(65534), 0);  // root may write anywhere
  }
  std::string why;
  try {
    Make();
  } catch (const InputError& error) {
    why = error.what();
  }
  ASSERT_EQ(::seteuid(user), 0);
  fs::permissions(place().parent_path(), fs::perms(0755));
  EXPECT_THAT(why, HasSubstr("which you may not write to, so it cannot be replaced; name a "
                             "folder in it"));
}

TEST_F(OutputFolders, AreInNoFile) {
  WriteFile(place(), "a file");
  EXPECT_THAT([this] { OutputFolder(place() / "deep/run", "marker.json", false); },
              ThrowsMessage<InputError>(HasSubstr("out is a file, no folder")));
}

TEST_F(OutputFolders, RefuseAPlaceThatCannotBeWrittenTo) {
  EXPECT_THAT([] { OutputFolder("/proc/out", "marker.json", false); },
              ThrowsMessage<InputError>(HasSubstr("/proc/out: cannot be written: ")));
  EXPECT_THAT([] { OutputFolder("", "marker.json", false); },
              ThrowsMessage<InputError>(HasSubstr("expected the name of a new folder")));
  EXPECT_THAT([] { OutputFolder("/", "marker.json", false); },
              ThrowsMessage<InputError>(HasSubstr("expected the name of a new folder")));
}

TEST_F(OutputFolders, AreWholeOrNotThereAtEveryMomentAtWhichTheirWriterIsKilled) {
  ASSERT_EQ(Run("one").exit_code, 0);
  const auto one = Contents(place());
  ASSERT_EQ(one.size(), 3u);
  ASSERT_EQ(Run("two").exit_code, 0);
  const auto two = Contents(place());
  const long operations = Operations();
  // Three files, each opened, written, closed and renamed, and the old folder removed: if this
  // is no longer so, the writer does what the interrupter does not see.
  ASSERT_GT(operations, 3 * 4 + 4);
  for (const bool over_an_old_one : {false, true}) {
    for (long moment = 1; moment <= operations; ++moment) {
      fs::remove_all(place());
      if (over_an_old_one) {
        ASSERT_EQ(Run("one").exit_code, 0);
      }
      const Outcome outcome = Run("two", {{"PAS_INTERRUPT_KILL", std::to_string(moment)}});
      const auto found = Contents(place());
      const auto& before = over_an_old_one ? one : std::map<std::string, std::string>();
      EXPECT_TRUE(found == two || (outcome.signal == SIGKILL && found == before))
          << "operation " << moment;
    }
  }
  ASSERT_EQ(Run("two").exit_code, 0);
  EXPECT_THAT(Beside(), ElementsAre("out")) << "what killed writers left is cleaned up";
}

TEST_F(OutputFolders, WouldBeCaughtWritingInPlace) {
  ASSERT_EQ(Run("one").exit_code, 0);
  const auto whole = Contents(place());
  int caught = 0;
  for (long moment = 1; moment <= 6; ++moment) {
    const Environment environment{{"LD_PRELOAD", PAS_FILE_INTERRUPTER},
                                  {"PAS_INTERRUPT_FOLDER", "/careless"},
                                  {"PAS_INTERRUPT_KILL", std::to_string(moment)},
                                  {"ASAN_OPTIONS", "verify_asan_link_order=0"}};
    const fs::path careless = folder_ / "careless";
    program::Process({PAS_NAIVE_WRITER, place(), careless}, environment, folder_ / "errors")
        .Wait();
    caught += fs::exists(careless) && Contents(careless) != whole ? 1 : 0;
    fs::remove_all(careless);
  }
  EXPECT_GT(caught, 3);
}

TEST_F(OutputFolders, TellOfAFullDiskAndLeaveWhatWasThereWhereverItStrikes) {
  ASSERT_EQ(Run("two").exit_code, 0);
  const auto two = Contents(place());
  ASSERT_EQ(Run("one").exit_code, 0);
  const auto one = Contents(place());
  const long operations = Operations();
  int refused = 0;
  for (long moment = 1; moment <= operations; ++moment) {
    const Outcome outcome = Run("two", {{"PAS_INTERRUPT_ERROR", std::to_string(ENOSPC)},
                                        {"PAS_INTERRUPT_FROM", std::to_string(moment)}});
    EXPECT_THAT(Beside(), ElementsAre("out")) << "operation " << moment;
    EXPECT_EQ(Contents(place()), outcome.exit_code == 0 ? two : one) << "operation " << moment;
    if (outcome.exit_code == 0) {  // it struck when all had been written
      ASSERT_EQ(Run("one").exit_code, 0);
      continue;
    }
    ++refused;
    EXPECT_THAT(outcome.errors, HasSubstr("cannot be written: No space left on device"));
    EXPECT_THAT(outcome.errors, HasSubstr("/out")) << "must name the place";
  }
  EXPECT_GT(refused, 6);
  EXPECT_LT(refused, operations);
}

}  // namespace
}  // namespace io
