#include "io/json_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace io {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// What reading says of a document; empty when it says nothing.
template <typename Read>
std::string ErrorOf(const std::string& text, const Read& read) {
  return test_support::RefusalOf([&] {
    const nlohmann::json json = ParseJson(text, "a.json");
    read(JsonField(json, "a.json"));
  });
}

TEST(JsonField, NamesFileAndPlaceOfWhatIsWrong) {
  const std::string text = R"({"planes": [{"normal": [0, 0, 1]}, {"normal": [0, "up", 1]}]})";
  const auto normals = [](const JsonField& root) {
    for (const JsonField& plane : root["planes"].Elements()) plane["normal"].Vector3();
  };
  EXPECT_EQ(ErrorOf(text, normals),
            "a.json: planes[1].normal[1]: expected a finite number, found \"up\"");
  const auto d = [](const JsonField& root) { root["planes"].Elements()[0]["d"].Number(); };
  EXPECT_EQ(ErrorOf(text, d), "a.json: the key \"planes[0].d\" is missing");
}

TEST(JsonField, RefusesWhatIsOutsideItsDomainOrOfAnotherType) {
  const auto score = [](const JsonField& root) { root["score"].Number(Interval("(0, 1]")); };
  EXPECT_EQ(ErrorOf(R"({"score": 1})", score), "");
  EXPECT_EQ(ErrorOf(R"({"score": 0})", score),
            "a.json: score: expected a number in (0, 1], found 0");
  EXPECT_THAT(ErrorOf(R"({"score": null})", score), HasSubstr("found null"));
  const auto whole = [](const JsonField& root) { root.Integer(); };
  EXPECT_EQ(ErrorOf("3.0", whole), "");
  EXPECT_THAT(ErrorOf("3.5", whole), HasSubstr("expected a whole number"));
  EXPECT_THAT(ErrorOf("3e10", whole), HasSubstr("expected a whole number"));
  EXPECT_THAT(ErrorOf("1", [](const JsonField& root) { root.Text(); }), HasSubstr("a text"));
  EXPECT_THAT(ErrorOf("1", [](const JsonField& root) { root.Boolean(); }), HasSubstr("true"));
  EXPECT_THAT(ErrorOf("{}", [](const JsonField& root) { root.Elements(); }),
              HasSubstr("array"));
}

TEST(JsonField, TellsNothingFromAMissingOrNullMember) {
  const nlohmann::json json = {{"a", nullptr}, {"b", 2}};
  const JsonField root(json, "x");
  EXPECT_FALSE(root.Find("a") || root.Find("c"));
  EXPECT_EQ(root.Find("b")->Integer(), 2);
}

TEST(ParseJson, NamesTheLineOfASyntaxErrorOrOfTheEnd) {
  const auto nothing = [](const JsonField&) {};
  EXPECT_THAT(ErrorOf("{\n\"a\": 1,\n\"b\": ,\n}", nothing),
              HasSubstr("a.json:3: not valid JSON"));
  EXPECT_THAT(ErrorOf("{\n\"a\": [1,", nothing), HasSubstr("a.json:2: not valid JSON"));
  EXPECT_THAT(ErrorOf("[NaN]", nothing), HasSubstr("a.json:1: not valid JSON"));
  EXPECT_THAT(ErrorOf("[1e999]", nothing), HasSubstr("a.json:1: not valid JSON"));
}

TEST(ParseJson, RefusesNestingThatNobodyNeeds) {
  EXPECT_THAT(ErrorOf(std::string(1000000, '['), [](const JsonField&) {}),
              HasSubstr("a.json:1: nested deeper"));
}

TEST(JsonLines, AreReadOneByOneWithTheirLines) {
  const program::TemporaryFolder folder;
  WriteFile(folder / "a.jsonl", "{\"t\": 1}\n\n{\"t\": 2}\n{\"t\": \"3\"}\n");
  std::vector<double> read;
  const auto visit = [&](const JsonField& line) { read.push_back(line["t"].Number()); };
  EXPECT_THAT([&] { ForEachJsonLine(folder / "a.jsonl", "", visit); },
              ThrowsMessage<InputError>(
                  EndsWith("a.jsonl:4: t: expected a finite number, found \"3\"")));
  EXPECT_THAT(read, ElementsAre(1, 2));
  EXPECT_THAT([&] { ForEachJsonLine(folder / "b.jsonl", "make it", visit); },
              ThrowsMessage<InputError>(EndsWith("b.jsonl: no such file; make it")));
}

}  // namespace
}  // namespace io
