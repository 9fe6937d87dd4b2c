// What a user is told of exceptions.
#include "app/console/failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <opencv2/core.hpp>

#include "io/input_error.h"

namespace app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(WordsOfFailures, LeaveBadInputAsItIs) {
  EXPECT_EQ(Words(io::InputError("a.yaml:3", "expected b")), "a.yaml:3: expected b");
}

TEST(WordsOfFailures, TellOfWantOfMemory) {
  EXPECT_THAT(Words(std::bad_alloc()), StartsWith("out of memory;"));
  EXPECT_THAT(Words(cv::Exception(cv::Error::StsNoMem, "e", "f", "g.cpp", 1)),
              StartsWith("out of memory;"));
}

TEST(WordsOfFailures, TellOfFilesWithPathAndReasonAlone) {
  const std::filesystem::filesystem_error error(
      "status", "a/b", std::make_error_code(std::errc::permission_denied));
  EXPECT_THAT(Words(error),
              AllOf(StartsWith("a/b: Permission denied;"), Not(HasSubstr("filesystem error"))));
}

TEST(WordsOfFailures, CallAnythingElseAFaultOfTheProgram) {
  EXPECT_THAT(Words(std::logic_error("no owner")),
              AllOf(StartsWith("internal error: no owner"), HasSubstr("please report")));
  const cv::Exception error(cv::Error::StsAssert, "size > 0", "resize", "resize.cpp", 9);
  EXPECT_THAT(Words(error),
              AllOf(StartsWith("internal error: size > 0"), Not(HasSubstr("resize.cpp"))));
}

}  // namespace
}  // namespace app
