// A decimal comma in the process's locale must reach no file: no German locale has to be
// installed for this, it is made here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <locale>

#include "sim/families/families.h"
#include "tests/support/pipeline.h"

namespace {

class Commas : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Sequence, run and scores by relative path, without what holds times and places.
std::map<std::string, std::string> MakeAll() {
  const pipeline::TemporaryFolder folder;
  pipeline::Record(sim::MakeScene("desk", 3, {{"texture", 0.5}}),
                   {.frames = 4, .width = 160, .height = 120}, folder / "seq");
  pipeline::Run(folder / "seq", folder / "run");
  nlohmann::json scores = pipeline::Score(folder / "run", folder / "seq");
  scores.erase("timing_ms");
  std::map<std::string, std::string> all = pipeline::Contents(folder.path());
  for (const char* timed : {"run/run.json", "run/timing.csv", "run/metrics.json"}) {
    all.erase(timed);
  }
  all["scores"] = scores.dump();
  return all;
}

TEST(GlobalLocale, WithADecimalCommaChangesNoByte) {
  const auto plain = MakeAll();
  const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
  std::ostringstream control;
  control << 1234.5;
  const auto commas = MakeAll();
  std::locale::global(before);
  ASSERT_EQ(control.str(), "1.234,5");
  ASSERT_EQ(plain.size(), commas.size());
  for (const auto& [name, bytes] : plain) EXPECT_EQ(commas.at(name) == bytes, true) << name;
}

}  // namespace
