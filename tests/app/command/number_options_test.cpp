// What every option refuses, whoever adds it.
#include "app/options/number_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "app/app.h"

namespace app {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class ValuesOfOptions : public ::testing::Test {
 protected:
  ValuesOfOptions() : pas_("", "pas") {
    CLI::App* deep = pas_.add_subcommand("a")->add_subcommand("b");
    deep->add_option("--real", real_);
    deep->add_option("--maybe", maybe_);
    deep->add_option("--bounded", real_)->check(CLI::Range(0.0, 1.0));
    deep->add_option("--whole", whole_);
    deep->add_option("--seed", seed_);
    deep->add_option("--list", list_)->expected(2);
    deep->add_option("--text", text_);
    deep->add_flag("--flag", flag_);
    CheckValues(pas_);
  }
  auto Parsing(const std::string& option, const std::string& value) {
    return [=, this] { Parse({option, value}); };
  }
  void Parse(std::vector<std::string> rest) {
    rest.insert(rest.begin(), {"a", "b"});
    std::reverse(rest.begin(), rest.end());
    pas_.parse(rest);
  }

  CLI::App pas_;
  double real_ = 0;
  std::optional<double> maybe_;
  int whole_ = 0;
  std::uint64_t seed_ = 0;
  std::vector<double> list_;
  std::string text_;
  bool flag_ = false;
};

TEST_F(ValuesOfOptions, ThatAreRealAreFinite) {
  for (const char* option : {"--real", "--maybe", "--bounded"}) {
    for (const char* value :
         {"nan", "NAN", "-nan", "inf", "-inf", "infinity", "1e400", "", "x"}) {
      EXPECT_THAT(Parsing(option, value),
                  ThrowsMessage<CLI::ValidationError>(HasSubstr("expected a finite number")))
          << option << " " << value;
    }
  }
  EXPECT_THROW(Parse({"--list", "1", "nan"}), CLI::ValidationError);
  EXPECT_THROW(Parse({"--bounded", "2"}), CLI::ValidationError);
  Parse({"--real", "-1.5e3", "--maybe", "2", "--list", "1", "2.5", "--flag"});
  EXPECT_EQ(real_, -1500);
  EXPECT_EQ(maybe_, 2);
  EXPECT_EQ(list_.back(), 2.5);
}

TEST_F(ValuesOfOptions, ThatAreUnsignedHaveNoSignAndFit) {
  for (const char* value :
       {"-1", "-0", "nan", "1.5", "18446744073709551616", "1e3", "0x10", ""}) {
    EXPECT_THAT(Parsing("--seed", value),
                ThrowsMessage<CLI::ValidationError>(HasSubstr("a whole number of 0 or more")))
        << value;
  }
  Parse({"--seed", "18446744073709551615"});
  EXPECT_EQ(seed_, UINT64_MAX);
}

TEST_F(ValuesOfOptions, ThatAreWholeAreDecimal) {
  for (const char* value : {"nan", "1.5", "0x10", "", "99999999999999999999"}) {
    EXPECT_THROW(Parsing("--whole", value)(), CLI::ValidationError) << value;
  }
  EXPECT_THROW(Parsing("--whole", "3000000000")(), CLI::ParseError);
  Parse({"--whole", "010"});
  EXPECT_EQ(whole_, 10) << "not eight";
  Parse({"--whole", "-3"});
  EXPECT_EQ(whole_, -3);
}

TEST_F(ValuesOfOptions, ThatAreTextsAreNotEmpty) {
  EXPECT_THAT(Parsing("--text", ""),
              ThrowsMessage<CLI::ValidationError>(HasSubstr("expected a text, found none")));
  Parse({"--text", "nan"});
  EXPECT_EQ(text_, "nan");
}

}  // namespace
}  // namespace app
