#include "io/text_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/input_error.h"
#include "io/json_field.h"
#include "io/text_table.h"
#include "io/yaml_value.h"
#include "tests/support/program.h"

namespace io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr const char* kMark = "\xEF\xBB\xBF";

class LinesOfText : public ::testing::Test {
 protected:
  std::filesystem::path File(const std::string& text) const {
    std::ofstream(folder_ / "a") << text;
    return folder_ / "a";
  }
  static std::vector<std::string> LinesOf(const std::filesystem::path& file) {
    TextLines lines(file, "", 8);
    std::vector<std::string> all;
    for (std::string text; lines.Next(text);) all.push_back(text);
    return all;
  }
  program::TemporaryFolder folder_;
};

TEST_F(LinesOfText, AreReadAsGetlineReadsThem) {
  EXPECT_THAT(LinesOf(File("a\n\nb\r\nc")), ElementsAre("a", "", "b\r", "c"));
  EXPECT_THAT(LinesOf(File("a\n")), ElementsAre("a"));
  EXPECT_THAT(LinesOf(File("")), ElementsAre());
}

TEST_F(LinesOfText, ThatHaveNoEndCostNoMemory) {
  File("");
  std::filesystem::resize_file(folder_ / "a", std::uintmax_t{1} << 40);  // holds no bytes
  EXPECT_THAT([this] { LinesOf(folder_ / "a"); },
              ThrowsMessage<InputError>(HasSubstr("a:1: too long a line")));
}

TEST_F(LinesOfText, OfAFileThatCannotBeReadToItsEndAreRefused) {
  // A regular file whose first bytes cannot be read: nothing is mapped at address 0.
  const std::filesystem::path memory = "/proc/self/mem";
  if (!std::ifstream(memory)) GTEST_SKIP() << "this system does not show a process its memory";
  EXPECT_THAT([&] { LinesOf(memory); },
              ThrowsMessage<InputError>(HasSubstr("cannot be read to its end")));
}

TEST_F(LinesOfText, MayBeginWithAByteOrderMarkInEveryFormat) {
  EXPECT_THAT(LinesOf(File(kMark + std::string("a\nb"))), ElementsAre("a", "b"));
  EXPECT_THAT(ReadRecords(File(kMark + std::string("1 a.png\n")), "timestamp file")[0].fields,
              ElementsAre("1", "a.png"));
  EXPECT_EQ(ReadRecords(File(kMark + std::string("# text\n1 a.png\n"))).size(), 1u);
  EXPECT_EQ(ReadJson(File(kMark + std::string("{\"a\": 1}")))["a"], 1);
  ForEachJsonLine(File(kMark + std::string("{\"a\": 1}\n")), "",
                  [](const JsonField& line) { EXPECT_EQ(line["a"].Integer(), 1); });
  EXPECT_EQ(YamlMap(ReadYaml(File(kMark + std::string("a: 1\n")))).At("a").Whole({0, 2}), 1);
}

}  // namespace
}  // namespace io
