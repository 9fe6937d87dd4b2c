#include "app/export_warning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/program.h"

namespace app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RollingShutterWarning : public testing::Test {
 protected:
  std::string Of(const std::string& manifest) const {
    std::ofstream(folder_ / "manifest.json") << manifest;
    return RollingWarning(folder_ / "");
  }
  program::TemporaryFolder folder_;
};

TEST_F(RollingShutterWarning, IsGivenWhereColourWasReadOverSomeTime) {
  EXPECT_THAT(Of(R"({"exposure": {"shutter_s": 0.015, "rolling_s": 0.03}})"),
              AllOf(HasSubstr("30 ms"), HasSubstr("--rolling-ms 0")));
}

TEST_F(RollingShutterWarning, IsNotGivenElsewhere) {
  EXPECT_EQ(RollingWarning(folder_ / "none"), "");
  for (const char* manifest :
       {"{}", R"({"exposure": {"shutter_s": 0.015, "rolling_s": 0}})",
        R"({"exposure": {"rolling_s": "0.03"}})", R"({"exposure": 3})", "[1]", "{broken", ""}) {
    EXPECT_EQ(Of(manifest), "") << manifest;
  }
}

}  // namespace
}  // namespace app
