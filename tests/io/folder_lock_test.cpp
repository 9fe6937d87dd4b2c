#include "io/folder_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>

#include "io/input_error.h"
#include "tests/support/program.h"

namespace io {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class FolderLocks : public ::testing::Test {
 protected:
  auto Locking() const {
    return [this] { FolderLock(folder_ / "seq"); };
  }
  program::TemporaryFolder folder_;
};

TEST_F(FolderLocks, AreHeldByOneAtATime) {
  std::optional<FolderLock> lock(std::in_place, folder_ / "seq");
  EXPECT_THAT(Locking(),
              ThrowsMessage<InputError>(HasSubstr("seq: is being written by another process")));
  lock.reset();
  EXPECT_NO_THROW(Locking()());
  EXPECT_TRUE(program::Contents(folder_ / "seq").empty());
}

TEST_F(FolderLocks, TellWhetherTheyAreHeld) {
  const std::filesystem::path folder = folder_ / "seq";
  EXPECT_FALSE(FolderLock::IsHeld(folder)) << "there is no such folder";
  {
    const FolderLock lock(folder);
    EXPECT_TRUE(FolderLock::IsHeld(folder));
  }
  EXPECT_FALSE(FolderLock::IsHeld(folder));
}

TEST_F(FolderLocks, EndWithTheProcessThatHasThem) {
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder_ / "seq");
    _exit(0);  // without the destructor
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_NO_THROW(Locking()());
}

TEST_F(FolderLocks, AreOfFoldersAlone) {
  std::ofstream(folder_ / "seq") << "a file";
  EXPECT_THAT(Locking(), ThrowsMessage<InputError>(HasSubstr("seq: is a file; name a folder")));
  EXPECT_THAT([] { FolderLock("/proc/none/seq"); },
              ThrowsMessage<InputError>(HasSubstr("cannot be")));
}

}  // namespace
}  // namespace io
