#include "app/options/choice_option.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/app.h"
#include "app/options/number_options.h"

namespace app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

enum class Size { kSmall, kMiddle, kLarge };

class Choices : public ::testing::Test {
 protected:
  Choices() : pas_("", "pas") {
    pas_.add_option("--word", word_)->check(Choice({"none", "all"}));
    pas_.add_option("--size", size_)
        ->transform(ChoiceOf<Size>({{"small", Size::kSmall}, {"large", Size::kLarge}}));
    CheckValues(pas_);
  }
  void Parse(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());
    pas_.parse(arguments);
  }
  auto Parsing(const std::string& option, const std::string& value) {
    return [=, this] { Parse({option, value}); };
  }

  CLI::App pas_;
  std::string word_;
  Size size_ = Size::kMiddle;
};

TEST_F(Choices, AreTakenByName) {
  Parse({"--word", "all", "--size", "large"});
  EXPECT_EQ(word_, "all");
  EXPECT_EQ(size_, Size::kLarge);
}

TEST_F(Choices, ThatAreMistypedAreRefusedWithTheOnesThereAre) {
  EXPECT_THAT(Parsing("--size", "lagre"),
              ThrowsMessage<CLI::ValidationError>(HasSubstr(
                  "--size: expected small or large, found `lagre`; did you mean `large`?")));
  EXPECT_THAT(
      Parsing("--word", "everything"),
      ThrowsMessage<CLI::ValidationError>(AllOf(
          HasSubstr("expected none or all, found `everything`"), Not(HasSubstr("mean")))));
}

TEST_F(Choices, AreNoNumbers) {
  EXPECT_THAT(Parsing("--size", "2"),
              ThrowsMessage<CLI::ValidationError>(HasSubstr("expected small or large")));
}

// As the program has them: app/sim/recording_options.cpp and app/command_export.cpp.
TEST(Commands, NameTheChoicesOfAnOptionThatIsMistyped) {
  const auto refusal = [](AddCommand add, std::vector<std::string> arguments) -> std::string {
    CLI::App pas("", "pas");
    Globals globals;
    int exit_code = 0;
    add(pas, globals, exit_code);
    CheckValues(pas);
    std::reverse(arguments.begin(), arguments.end());
    try {
      pas.parse(arguments);
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* wrong : {"perfct", "2"}) {
    EXPECT_EQ(refusal(AddSimCommand, {"sim", "--detector", wrong})
                  .find("--detector: expected perfect, noisy, poor or none, found"),
              0u)
        << wrong;
  }
  EXPECT_THAT(refusal(AddSimCommand, {"sim", "--motion", "fats"}),
              HasSubstr("expected slow, office, fast"));
  EXPECT_THAT(refusal(AddExportCommand, {"export", "--format", "cocoo"}),
              HasSubstr("expected coco or bop, found `cocoo`; did you mean `coco`?"));
}

}  // namespace
}  // namespace app
