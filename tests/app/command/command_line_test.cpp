#include "app/console/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"

namespace app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<std::string> Arguments(std::vector<const char*> all) {
  all.insert(all.begin(), "pas");
  return ArgumentsOf(static_cast<int>(all.size()), all.data());
}

class KnownCommands : public ::testing::Test {
 protected:
  KnownCommands() : pas_("", "pas") {
    pas_.add_subcommand("slam");
    pas_.add_subcommand("scene")->add_subcommand("make");
  }
  auto Requiring(const std::vector<std::string>& arguments) {
    return [=, this] { RequireKnownCommands(pas_, arguments); };
  }
  CLI::App pas_;
};

TEST(CommandLine, TurnsHelpOfACommandIntoItsOption) {
  EXPECT_THAT(Arguments({"help"}), ElementsAre("--help"));
  EXPECT_THAT(Arguments({"-q", "help", "slam"}), ElementsAre("-q", "slam", "--help"));
  EXPECT_THAT(Arguments({"help", "scene", "make"}), ElementsAre("scene", "make", "--help"));
  EXPECT_THAT(Arguments({"slam", "help"}), ElementsAre("slam", "help"));
  EXPECT_THAT(Arguments({}), ElementsAre());
}

TEST(CommandLine, HoldsUtf8Alone) {
  EXPECT_THAT(Arguments({"b\xC3\xBC"
                         "cher"}),
              ElementsAre("b\xC3\xBC"
                          "cher"));
  EXPECT_THAT(
      [] {
        Arguments({"slam",
                   "b\xFC"
                   "cher"});
      },
      ThrowsMessage<io::InputError>(HasSubstr("is not valid UTF-8")));
}

TEST_F(KnownCommands, AreSuggestedForOnesThatAreSpeltNearlySo) {
  EXPECT_THAT(Requiring({"slams", "seq"}),
              ThrowsMessage<io::InputError>(
                  HasSubstr("unknown command `slams`; did you mean `slam`?")));
  EXPECT_THAT(Requiring({"-q", "scene", "mak"}),
              ThrowsMessage<io::InputError>(HasSubstr("did you mean `make`?")));
  EXPECT_THAT(Requiring({"telephone"}),
              ThrowsMessage<io::InputError>(HasSubstr("commands here: slam, scene")));
}

TEST_F(KnownCommands, AreNotAskedOfOneThatTakesArguments) {
  CLI::App* suite = pas_.add_subcommand("suite");
  std::string file;
  suite->add_option("SUITE", file);
  suite->add_subcommand("merge");
  EXPECT_NO_THROW(Requiring({"suite", "merged.yaml"})());
}

TEST_F(KnownCommands, AreNotSaidToBeMissingWhereAnOptionIsNone) {
  pas_.add_flag("-q,--quiet");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--nosuch"}, {"--nosuch", "slam"}}) {
    EXPECT_THAT(
        Requiring(arguments),
        ThrowsMessage<io::InputError>(HasSubstr("unknown option `--nosuch`; see pas --help")));
  }
  EXPECT_THAT(Requiring({"scene", "--nosuch"}),
              ThrowsMessage<io::InputError>(HasSubstr("see pas scene --help")));
  EXPECT_NO_THROW(Requiring({"--quiet", "scene", "--quiet", "--help", "make", "--any"})());
}

TEST_F(KnownCommands, TakeWhateverFollowsThem) {
  EXPECT_NO_THROW(Requiring({"slam", "slams"})());
  EXPECT_NO_THROW(Requiring({"-q", "scene", "make", "x"})());
  EXPECT_NO_THROW(Requiring({})());
}

}  // namespace
}  // namespace app
