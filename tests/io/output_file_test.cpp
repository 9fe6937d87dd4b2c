// The one file that a command writes: what is refused before the work, and where bytes end up.
#include "io/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/read_file.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class OutputFiles : public ::testing::Test {
 protected:
  fs::path place() const { return folder_ / "out.json"; }
  void Put(const std::string& name, const std::string& text = "old") const {
    std::ofstream(folder_ / name) << text;
  }
  auto Making(const fs::path& path, bool force = false,
              std::vector<fs::path> inputs = {}) const {
    return [=] { OutputFile(path, {force, inputs, "own.json"}); };
  }
  static auto Refused(const std::string& why) {
    return ThrowsMessage<InputError>(HasSubstr(why));
  }

  program::TemporaryFolder folder_;
};

TEST_F(OutputFiles, AreWrittenWhereNothingIs) {
  const OutputFile output(place(), {});
  EXPECT_FALSE(fs::exists(place()));
  output.Write("new");
  EXPECT_EQ(ReadFile(place()), "new");
}

TEST_F(OutputFiles, ReplaceAFileWithForceAlone) {
  Put("out.json");
  EXPECT_THAT(Making(place()), Refused("out.json: exists already; choose another name or add"));
  const OutputFile output(place(), {.force = true, .inputs = {}, .own_name = {}});
  EXPECT_EQ(ReadFile(place()), "old");
  output.Write("new");
  EXPECT_EQ(ReadFile(place()), "new");
}

TEST_F(OutputFiles, ReplaceNothingThatAppearedMeanwhile) {
  const OutputFile output(place(), {});
  Put("out.json");
  EXPECT_THROW(output.Write("new"), InputError);
  EXPECT_EQ(ReadFile(place()), "old");
}

TEST_F(OutputFiles, ComeToTheirPlacesTogetherOrNotAtAll) {
  Put("out.json");
  const OutputFile first(place(), {.force = true, .inputs = {}, .own_name = {}});
  const OutputFile second(folder_ / "out.png", {});
  const auto write = [&] { OutputFile::WriteTogether({{&first, "new"}, {&second, "new"}}); };
  {
    const AtomicFile of_another(folder_ / "out.png");
    EXPECT_THROW(write(), InputError);
  }
  Put("out.png", "of another");
  EXPECT_THAT(write, Refused("out.png: exists already"));
  EXPECT_EQ(
      program::Contents(folder_.path()),
      (std::map<std::string, std::string>{{"out.json", "old"}, {"out.png", "of another"}}));
  fs::remove(folder_ / "out.png");
  write();
  EXPECT_EQ(program::Contents(folder_.path()),
            (std::map<std::string, std::string>{{"out.json", "new"}, {"out.png", "new"}}));
}

TEST_F(OutputFiles, OfTwoWritersAtOnceOneIsRefused) {
  for (int round = 0; round < 300; ++round) {
    fs::remove(place());
    const OutputFile output(place(), {});
    std::atomic<int> ready = 0, written = 0;
    const auto write = [&] {
      for (++ready; ready < 2;) std::this_thread::yield();
      try {
        output.Write("new");
        ++written;
      } catch (const InputError&) {
      }
    };
    std::thread other(write);
    write();
    other.join();
    ASSERT_LE(written, 1);
  }
}

TEST_F(OutputFiles, NeverReplaceAnInputOfTheCommand) {
  Put("out.json");
  EXPECT_THAT(Making(place(), true, {place()}), Refused("is read by this command"));
  EXPECT_THAT(Making(place(), true, {folder_ / ""}), Refused("is in "));
  fs::create_directory_symlink(folder_ / "", folder_ / "link");
  EXPECT_THAT(Making(folder_ / "link/out.json", true, {folder_ / ""}), Refused("is in "));
  fs::create_directory(folder_ / "elsewhere");
  EXPECT_NO_THROW(Making(place(), true, {folder_ / "elsewhere/"})());
}

TEST_F(OutputFiles, MayReplaceWhatTheCommandItselfPutAmongItsInputs) {
  Put("own.json");
  EXPECT_NO_THROW(Making(folder_ / "own.json", true, {folder_ / ""})());
  EXPECT_THAT(Making(folder_ / "own.json", false, {folder_ / ""}), Refused("exists already"));
  fs::create_directory(folder_ / "deep");
  Put("deep/own.json");
  EXPECT_THAT(Making(folder_ / "deep/own.json", true, {folder_ / ""}), Refused("is in "));
}

TEST_F(OutputFiles, NeverReplaceWhatIsNoFile) {
  Put("file");
  fs::create_symlink("file", place());
  EXPECT_THAT(Making(place(), true), Refused("is a link, which is never replaced"));
  fs::remove(place());
  fs::create_symlink("nowhere", place());
  EXPECT_THAT(Making(place(), true), Refused("is a link"));
  fs::remove(place());
  fs::create_directory(place());
  EXPECT_THAT(Making(place(), true), Refused("is a folder"));
  EXPECT_THAT(Making(place() / "", true), Refused("expected the name of a file"));
}

TEST_F(OutputFiles, GoToADeviceAsItIs) {
  OutputFile("/dev/null", {}).Write("gone");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THAT([] { OutputFile("/dev/full", {}).Write("x"); },
              Refused("/dev/full: cannot be written: No space left on device"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(OutputFiles, GoThroughAPipeThatIsRead) {
  ASSERT_EQ(mkfifo(place().c_str(), 0600), 0);
  EXPECT_THAT(Making(place()), Refused("is a pipe that nobody reads"));
  const int reader = open(place().c_str(), O_RDONLY | O_NONBLOCK);
  OutputFile(place(), {}).Write("through");
  std::array<char, 16> bytes{};
  EXPECT_EQ(read(reader, bytes.data(), bytes.size()), 7);
  EXPECT_STREQ(bytes.data(), "through");
  close(reader);
}

// A reader that takes a little whenever the pipe is full, and no sooner.
TEST_F(OutputFiles, GoThroughAPipeWholeHoweverSlowlyItIsRead) {
  ASSERT_EQ(mkfifo(place().c_str(), 0600), 0);
  const int reader = open(place().c_str(), O_RDONLY | O_NONBLOCK);
  const OutputFile output(place(), {});
  const int full = open(place().c_str(), O_WRONLY | O_NONBLOCK);  // to ask whether it is
  std::string bytes(1 << 20, '\0'), received;
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i % 251);
  std::string refusal;
  std::atomic<bool> written = false;
  std::thread writer([&] {
    refusal = test_support::RefusalOf([&] { output.Write(bytes); });
    written = true;
  });
  for (std::array<char, 4096> part{};;) {
    const bool all = written;
    pollfd has_room{full, POLLOUT, 0};
    if (!all && poll(&has_room, 1, 0) > 0) {
      std::this_thread::yield();
      continue;
    }
    const ssize_t count = read(reader, part.data(), part.size());
    if (count > 0) received.append(part.data(), static_cast<std::size_t>(count));
    if (count <= 0 && all) break;
  }
  writer.join();
  close(full);
  close(reader);
  EXPECT_EQ(refusal, "");
  EXPECT_TRUE(received == bytes) << received.size();
}

TEST_F(OutputFiles, GoToADescriptorWhateverItIs) {
  const int file = open((folder_ / "redirected").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(write(file, "first ", 6), 6);
  OutputFile("/dev/fd/" + std::to_string(file), {}).Write("second");
  close(file);
  EXPECT_EQ(ReadFile(folder_ / "redirected"), "first second");
  EXPECT_THAT(Making("/dev/fd/999"), Refused("Bad file descriptor"));
}

TEST_F(OutputFiles, NeedAFolderToStandIn) {
  EXPECT_THAT(Making(folder_ / "no/out.json"), Refused("there is no folder"));
  Put("file");
  EXPECT_THAT(Making(folder_ / "file/out.json"), Refused("there is no folder"));
}

TEST_F(OutputFiles, DoNotTakeTheFileOfAnotherForTheirUnfinishedOne) {
  Put("out.json.part");
  EXPECT_THAT(Making(place()), Refused("out.json.part: is in the way"));
  EXPECT_EQ(ReadFile(folder_ / "out.json.part"), "old");
}

TEST_F(OutputFiles, AnyFileThatIsWrittenWholeReplacesNoLink) {
  Put("file");
  fs::create_symlink("file", place());
  EXPECT_THAT([&] { WriteFile(place(), "new"); }, Refused("is a link or a device"));
  EXPECT_EQ(ReadFile(folder_ / "file"), "old");
}

TEST_F(OutputFiles, AFolderWithAnInputInItIsNotReplaced) {
  Put("scene.yaml");
  const auto replacing = [&](const fs::path& folder) {
    return [=, this] { RefuseInputsInside(folder, {"", folder_ / "scene.yaml"}); };
  };
  EXPECT_THAT(replacing(folder_ / ""), Refused("scene.yaml is in it"));
  EXPECT_NO_THROW(replacing(folder_ / "seq")());
  const program::TemporaryFolder elsewhere;
  fs::create_directory_symlink(folder_ / "", elsewhere / "link");
  EXPECT_THAT(replacing(elsewhere / "link"), Refused("scene.yaml is in it"));
}

}  // namespace
}  // namespace io
