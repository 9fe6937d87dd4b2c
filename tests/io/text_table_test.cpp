#include "io/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "tests/support/program.h"

namespace io {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class TextTable : public ::testing::Test {
 protected:
  std::filesystem::path File(const std::string& text) const {
    WriteFile(folder_ / "list.txt", text);
    return folder_ / "list.txt";
  }
  auto Reading(const std::string& text) const {
    return [=, this] { ReadRecords(File(text), "timestamp file"); };
  }
  program::TemporaryFolder folder_;
};

TEST_F(TextTable, HasTheFieldsOfEachRecordAndItsLine) {
  const auto records =
      ReadRecords(File("# all\n\n1.5 a.png\r\n \t2.5\tb.png "), "timestamp file");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].line, 3);
  EXPECT_THAT(records[0].where, EndsWith("list.txt:3"));
  EXPECT_THAT(records[1].fields, ElementsAre("2.5", "b.png"));
  EXPECT_EQ(records[1].Number(0, "timestamp"), 2.5);
}

TEST_F(TextTable, NamesTheLineOfARecordOfAnotherForm) {
  EXPECT_THAT(Reading("1 a\n2\n"),
              ThrowsMessage<InputError>(
                  EndsWith("list.txt:2: expected `timestamp file`, found 1 words")));
  EXPECT_THAT(Reading("1 a b\n"), ThrowsMessage<InputError>(HasSubstr("found 3 words")));
  EXPECT_THAT(Reading(std::string(5000, 'x')),
              ThrowsMessage<InputError>(HasSubstr("list.txt:1: too long a line")));
}

TEST_F(TextTable, NamesTheFieldThatIsNoNumber) {
  const auto records = ReadRecords(File("nan a\n"), "timestamp file");
  EXPECT_THAT([&] { static_cast<void>(records[0].Number(0, "timestamp")); },
              ThrowsMessage<InputError>(
                  EndsWith("list.txt:1: expected a finite number for timestamp, found `nan`")));
}

TEST_F(TextTable, KeepsEmptyFieldsBetweenCommas) {
  const auto records = ReadCommaRecords(File("a,b,c\n1,,\n, 2 ,3\n"));
  EXPECT_THAT(records[1].fields, ElementsAre("1", "", ""));
  EXPECT_THAT(records[2].fields, ElementsAre("", "2", "3"));
}

}  // namespace
}  // namespace io
