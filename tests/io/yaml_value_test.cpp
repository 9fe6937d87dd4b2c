#include "io/yaml_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace io {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// What reading says of a text; empty when it says nothing.
template <typename Read>
std::string ErrorInYaml(const std::string& text, const Read& read) {
  return test_support::RefusalOf([&] { read(ParseYaml(text, "a.yaml")); });
}

/// The same for the value of `key`.
template <typename Read>
std::string ErrorAt(const std::string& key, const std::string& text, const Read& read) {
  return ErrorInYaml(text, [&](const YamlValue& root) { read(YamlMap(root).At(key)); });
}

void Nothing(const YamlValue&) {}
void Share(const YamlValue& value) { value.Number(Interval("(0, 1]"), "of all"); }

TEST(YamlText, MustBeOnePlainShallowDocument) {
  EXPECT_THAT(ErrorInYaml("a: [1, 2\nb: }", Nothing), StartsWith("a.yaml:2: not valid YAML"));
  EXPECT_THAT(ErrorInYaml("a: 1\n---\nb: 2\n", Nothing),
              HasSubstr("more than one YAML document"));
  EXPECT_THAT(ErrorInYaml("b: 1\na: &x 1\n", Nothing), StartsWith("a.yaml:2: anchors"));
  EXPECT_THAT(ErrorInYaml("a: *x\n", Nothing), StartsWith("a.yaml:1: "));
  EXPECT_THAT(ErrorInYaml(std::string(100000, '['), Nothing),
              HasSubstr("nested deeper than 8"));
  EXPECT_EQ(ErrorInYaml("[[[[[[[[1]]]]]]]]", Nothing), "");
  EXPECT_THAT(ErrorInYaml("[[[[[[[[[1]]]]]]]]]", Nothing), HasSubstr("nested deeper than 8"));
}

TEST(YamlText, MustGiveEachKeyOnceAndInPlainText) {
  EXPECT_EQ(ErrorInYaml("a: 1\nb: {c: 1,\n  c: 2}\n", Nothing),
            "a.yaml:3: key `c` is given twice; keep one");
  EXPECT_EQ(ErrorInYaml("a: {c: 1}\nb: {c: 2}\n", Nothing), "");
  EXPECT_THAT(ErrorInYaml("? [a, b]\n: 1\n", Nothing), HasSubstr("a key must be a plain text"));
}

TEST(YamlMap, NamesAnUnknownKeyItsLineAndTheOneThatIsMeant) {
  const auto read = [](const YamlValue& root) { YamlMap(root, {"size_m", "name"}); };
  EXPECT_EQ(ErrorInYaml("name: a\nsize_mm: 1\n", read),
            "a.yaml:2: unknown key `size_mm`; did you mean `size_m`? keys here: size_m, name");
  EXPECT_EQ(ErrorInYaml("colour: 1\n", read),
            "a.yaml:1: unknown key `colour`; keys here: size_m, name");
  EXPECT_EQ(
      ErrorInYaml("", read),
      "a.yaml:1: the file is empty; expected `key: value` lines with keys of: size_m, name");
  EXPECT_EQ(ErrorInYaml("- 1\n", read), "a.yaml:1: expected `key: value` lines, found a list");
}

TEST(YamlMap, MayLearnItsKeysWhileItIsRead) {
  const auto read = [](const YamlValue& root) {
    const YamlMap map(root), section(map.At("section"));
    section.RefuseOtherKeys({"a"});
    map.RefuseOtherKeys({"section"});
  };
  EXPECT_EQ(ErrorInYaml("", read), "");
  EXPECT_EQ(ErrorInYaml("section:\n", read), "");
  EXPECT_EQ(ErrorInYaml("section: {a: 1}\n", read), "");
  EXPECT_EQ(ErrorInYaml("section:\n  a: 1\n  b: 2\n", read),
            "a.yaml:3: section: unknown key `b`; did you mean `a`? keys here: a");
  EXPECT_EQ(ErrorInYaml("section: 3\n", read),
            "a.yaml:1: section: expected `key: value` lines, found `3`");
}

TEST(YamlMap, SaysOfAMissingKeyWhatWasExpected) {
  EXPECT_EQ(ErrorAt("share", "# nothing\nother: 1\n", Share),
            "a.yaml:2: key `share` is missing; expected a number in (0, 1] (of all)");
}

TEST(YamlValue, TakesNumbersOfItsDomainAlone) {
  EXPECT_EQ(ErrorAt("share", "share: 1", Share), "");
  EXPECT_EQ(ErrorAt("share", "share: +1e-3", Share), "");
  EXPECT_EQ(ErrorAt("share", "a: 1\nshare: 0", Share),
            "a.yaml:2: share: expected a number in (0, 1] (of all), found `0`");
  EXPECT_THAT(ErrorAt("share", "share: '1'", Share), EndsWith("found `1` in quotes"));
  EXPECT_THAT(ErrorAt("share", "share: [1]", Share), EndsWith("found a list"));
  EXPECT_THAT(ErrorAt("share", "share: ~", Share), EndsWith("found nothing"));
  for (const char* bad : {"nan", ".nan", ".inf", "1e999", "0x1", "0.5m", "0,5"}) {
    EXPECT_THAT(ErrorAt("share", std::string("share: ") + bad, Share),
                EndsWith("found `" + std::string(bad) + "`"));
  }
}

TEST(YamlValue, TakesWholeNumbersAndSeeds) {
  const auto whole = [](const YamlValue& value) { value.Whole({1, 65535}); };
  EXPECT_EQ(ErrorAt("id", "id: 65535", whole), "");
  EXPECT_EQ(ErrorAt("id", "id: 0", whole),
            "a.yaml:1: id: expected a whole number in [1, 65535], found `0`");
  for (const char* bad : {"1.5", "1e3", "99999999999", "-1", "'1'"}) {
    EXPECT_NE(ErrorAt("id", std::string("id: ") + bad, whole), "") << bad;
  }
  const auto seed = [](const YamlValue& value) { value.Seed(); };
  EXPECT_THAT(ErrorAt("seed", "seed: '5'", seed), EndsWith("found `5` in quotes"));
  const YamlMap map(ParseYaml("seed: 18446744073709551615\nlow: -1\n", "a.yaml"));
  EXPECT_EQ(map.At("seed").Seed(), 18446744073709551615u);
  EXPECT_THROW(map.At("low").Seed(), InputError);
}

TEST(YamlValue, TakesOneOfItsChoices) {
  const YamlMap map(ParseYaml("a: lamp\nb: true\nc: 1\n", "a.yaml"));
  EXPECT_EQ(map.At("a").OneOf({"area", "lamp"}), 1u);
  EXPECT_TRUE(map.At("b").Flag());
  EXPECT_THAT(
      [&] {
        map.At("a").OneOf({"area", "point"});
      },
      ThrowsMessage<InputError>(
          EndsWith("a.yaml:1: a: expected one of: area, point, found `lamp`")));
  EXPECT_THAT([&] { map.At("c").Flag(); }, ThrowsMessage<InputError>(HasSubstr("false, true")));
}

TEST(YamlValue, TakesWordsAndPathsOfPlainCharactersAlone) {
  const auto word = [](const std::string& text) {
    return ErrorAt("a", "a: " + text, [](const YamlValue& value) { value.Word(); });
  };
  EXPECT_EQ(word("teddy bear-2"), "");
  for (const std::string& bad : {std::string("'a\"b'"), std::string("-a"), std::string("\"\""),
                                 std::string(65, 'a'), std::string("\"a\\tb\"")}) {
    EXPECT_THAT(word(bad), HasSubstr("expected 1 to 64 letters")) << bad;
  }
  EXPECT_THAT(word("\"a\\tb" + std::string(100, 'c') + "\""), HasSubstr("found `a?bccc"))
      << "what is shown has no control characters";
  const auto path = [](const std::string& text) {
    return ErrorAt("a", "a: " + text, [](const YamlValue& value) { value.Path(); });
  };
  EXPECT_EQ(path("../meshes/a_b.obj"), "");
  EXPECT_THAT(path("a;b"), HasSubstr("expected a path"));
  EXPECT_THAT(path("' a'"), HasSubstr("expected a path"));
}

TEST(YamlValue, TakesListsAndNamesTheEntryThatIsWrong) {
  const YamlMap map(ParseYaml("p: [1, 2,\n  x]\nlist: [a, b, '']\n", "a.yaml"));
  EXPECT_THAT(
      [&] {
        map.At("p").Numbers(3, {0, 9}, "metres");
      },
      ThrowsMessage<InputError>(
          EndsWith("a.yaml:2: p[2]: expected a number in [0, 9] (metres), found `x`")));
  EXPECT_THAT(
      [&] {
        map.At("p").Numbers(2, {0, 9});
      },
      ThrowsMessage<InputError>(HasSubstr("expected a list of 2 numbers")));
  EXPECT_THAT([&] { map.At("list").List(2); },
              ThrowsMessage<InputError>(HasSubstr("expected at most 2 entries, found 3")));
  EXPECT_EQ(map.At("list").List()[1].Text(), "b");
  EXPECT_THAT([&] { map.At("list").List()[2].Text(); },
              ThrowsMessage<InputError>(HasSubstr("list[2]: expected a text")));
}

TEST(YamlFile, IsReadFromDiskUpToOneMebibyte) {
  const program::TemporaryFolder folder;
  WriteFile(folder / "a.yaml", "\na: 1\n");
  EXPECT_THAT([&] { YamlMap(ReadYaml(folder / "a.yaml")).At("a").Fail("is wrong"); },
              ThrowsMessage<InputError>(EndsWith("a.yaml:2: a: is wrong")));
  WriteFile(folder / "b.yaml", std::string((1 << 20) + 1, ' '));
  EXPECT_THAT(
      [&] { ReadYaml(folder / "b.yaml", "expected a scene"); },
      ThrowsMessage<InputError>(EndsWith("b.yaml: is larger than 1 MiB; expected a scene")));
}

}  // namespace
}  // namespace io
