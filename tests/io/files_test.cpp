// Reading and writing of single files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <thread>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/read_file.h"
#include "tests/support/program.h"

namespace io {
namespace {

using program::Contents;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;

class Files : public ::testing::Test {
 protected:
  program::TemporaryFolder folder_;
};

TEST_F(Files, ComeBackAsTheyWereWritten) {
  const std::string bytes("a\0\r\nb", 5);
  WriteFile(folder_ / "a", bytes);
  EXPECT_EQ(ReadFile(folder_ / "a"), bytes);
  WriteFile(folder_ / "a", "");
  EXPECT_EQ(ReadFile(folder_ / "a"), "");
}

TEST_F(Files, ThatCannotBeReadAreNamedWithTheReasonAndWhatToDo) {
  const auto reading = [&](const char* name, std::uintmax_t max_bytes = 1 << 20) {
    return [=, this] { ReadFile(folder_ / name, "make one", max_bytes); };
  };
  EXPECT_THAT(reading("none"),
              ThrowsMessage<InputError>(EndsWith("none: no such file; make one")));
  EXPECT_THAT(reading(""),
              ThrowsMessage<InputError>(EndsWith("is a folder, expected a file; make one")));
  WriteFile(folder_ / "large", std::string((1 << 20) + 1, 'x'));
  EXPECT_THAT(reading("large"),
              ThrowsMessage<InputError>(EndsWith("is larger than 1 MiB; make one")));
}

TEST_F(Files, AreThereWholeAfterFinishAndNotAtAllBefore) {
  WriteFile(folder_ / "a", "old");
  AtomicFile file(folder_ / "a");
  file.Add("new ");
  file.Add(std::string(1 << 20, 'x'));
  EXPECT_EQ(ReadFile(folder_ / "a"), "old");
  file.Add(" end");
  file.Finish();
  EXPECT_THAT(Contents(folder_ / ""),
              ElementsAre(Pair("a", "new " + std::string(1 << 20, 'x') + " end")));
}

TEST_F(Files, ThatAreGivenUpLeaveTheOldOne) {
  WriteFile(folder_ / "a", "old");
  { AtomicFile(folder_ / "a").Add("new"); }
  EXPECT_THAT(Contents(folder_ / ""), ElementsAre(Pair("a", "old")));
}

TEST_F(Files, AreWrittenByOneAtATime) {
  AtomicFile first(folder_ / "a");
  first.Add(std::string(1 << 19, 'x'));
  EXPECT_THAT([&] { WriteFile(folder_ / "a", "second"); },
              ThrowsMessage<InputError>(HasSubstr("a: is being written by another process")));
  first.Add(" end");
  first.Finish();
  EXPECT_EQ(ReadFile(folder_ / "a"), std::string(1 << 19, 'x') + " end");
  WriteFile(folder_ / "a", "third");
  EXPECT_EQ(ReadFile(folder_ / "a"), "third");
}

TEST_F(Files, LeaveNothingOfWhatAKilledProcessHadWritten) {
  std::ofstream(folder_ / ("a" + std::string(kUnfinishedSuffix))) << "a long and useless text";
  WriteFile(folder_ / "a", "new");
  EXPECT_THAT(Contents(folder_ / ""), ElementsAre(Pair("a", "new")));
}

/// Of eight that write the same file at once each is refused or writes all of it.
TEST_F(Files, AreWholeWhoeverWritesThemAtOnce) {
  // Each tries until it has written so many: who comes while another writes is refused.
  constexpr int kWriters = 8, kFilesEach = 50;
  std::atomic<int> at_it = kWriters;
  std::vector<std::thread> writers;
  for (int i = 0; i < kWriters; ++i) {
    writers.emplace_back([&, i] {
      for (int written = 0; written < kFilesEach;) {
        try {
          WriteFile(folder_ / "a", std::string(1000, static_cast<char>('a' + i)));
          ++written;
        } catch (const InputError&) {
          std::this_thread::yield();
        }
      }
      --at_it;
    });
  }
  bool whole = true;
  while (at_it > 0) {
    std::ifstream stream(folder_ / "a");
    std::stringstream text;
    text << stream.rdbuf();
    if (stream) whole = whole && text.str() == std::string(1000, text.str()[0]);
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_TRUE(whole);
  EXPECT_EQ(Contents(folder_ / "").size(), 1u) << "an unfinished file stays";
}

TEST_F(Files, ThatCannotBeWrittenAreNamedWithTheReason) {
  EXPECT_THAT(
      [&] { WriteFile(folder_ / "no/such/folder.txt", "x"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("no/such/folder.txt: cannot be written"),
                                      HasSubstr("No such file or directory"))));
  std::filesystem::create_directory(folder_ / "d");
  EXPECT_THAT([&] { WriteFile(folder_ / "d", "x"); },
              ThrowsMessage<InputError>(HasSubstr("Is a directory")));
  EXPECT_TRUE(Contents(folder_ / "").empty()) << "an unfinished file stays";
}

}  // namespace
}  // namespace io
