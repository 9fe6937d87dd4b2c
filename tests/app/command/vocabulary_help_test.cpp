#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/app.h"

namespace app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Nothing else can be done with the file that the command writes.
TEST(HelpOfVocabulary, SaysWhatItsFileIsFor) {
  CLI::App pas("", "pas");
  Globals globals;
  int exit_code = 0;
  AddVocabularyCommand(pas, globals, exit_code);
  EXPECT_THAT(pas.get_subcommand("vocabulary")->help(),
              AllOf(HasSubstr("no command reads the file"),
                    HasSubstr("slam/places/orb_words.bin"), HasSubstr("build")));
}

}  // namespace
}  // namespace app
