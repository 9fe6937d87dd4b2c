// What stands at a path; and that a file that may not be seen is not called missing.
#include "io/path_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/input_error.h"
#include "io/read_file.h"
#include "tests/support/program.h"

namespace io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class PathTypes : public ::testing::Test {
 protected:
  program::TemporaryFolder folder_;
};

TEST_F(PathTypes, FollowLinks) {
  EXPECT_EQ(TypeAt(folder_ / ""), fs::file_type::directory);
  EXPECT_EQ(TypeAt(folder_ / "none"), fs::file_type::not_found);
  EXPECT_EQ(TypeAt("/dev/null/none"), fs::file_type::not_found);
  EXPECT_EQ(TypeAt(folder_ / std::string(300, 'x')), fs::file_type::not_found);
  fs::create_symlink("/dev/zero", folder_ / "zero");
  EXPECT_EQ(TypeAt(folder_ / "zero"), fs::file_type::character);
  fs::create_symlink("ring", folder_ / "ring");
  EXPECT_THAT([&] { Exists(folder_ / "ring"); },
              ThrowsMessage<InputError>(HasSubstr("ring: cannot be read: Too many levels")));
}

TEST_F(PathTypes, RefusePipesAndDevicesUnopened) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder_ / "zero");
  EXPECT_THAT([&] { ReadFile(folder_ / "pipe"); },
              ThrowsMessage<InputError>(HasSubstr("pipe: is a pipe, expected a file")));
  EXPECT_THAT([&] { ReadFile(folder_ / "zero"); },
              ThrowsMessage<InputError>(HasSubstr("zero: is a device, expected a file")));
}

TEST_F(PathTypes, TellWantOfPermissionFromWantOfAFile) {
  fs::create_directory(folder_ / "closed");
  std::ofstream(folder_ / "closed/a") << "text";
  fs::permissions(folder_ / "closed", fs::perms::none);
  // The folder above has to let others through.
  fs::permissions(folder_ / "", fs::perms::all);
  const pid_t child = fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;
    if (getuid() == 0 && setuid(kNobody) != 0) _exit(1);
    try {
      Exists(folder_ / "closed/a");
    } catch (const InputError& error) {
      const bool right =
          std::string(error.what()).find("Permission denied") != std::string::npos &&
          std::string(error.what()).find("no such") == std::string::npos;
      _exit(right ? 0 : 2);
    }
    _exit(3);
  }
  int status = 0;
  waitpid(child, &status, 0);
  fs::permissions(folder_ / "closed", fs::perms::owner_all);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace io
