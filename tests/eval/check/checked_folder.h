#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>
#include <string>

#include "eval/check/check_folder.h"
#include "tests/eval/check/small_world.h"
#include "tests/support/fault_text.h"

namespace eval::small_world {

/// A faultless sequence on disk, for a test to spoil in one place.
class CheckSequenceFolder : public ::testing::Test {
 protected:
  CheckSequenceFolder() { WriteSequence(seq(), world_); }
  fs::path seq() const { return folder_.path() / "seq"; }
  std::string Stamp(int frame) const {
    return StampText(world_.views[static_cast<std::size_t>(frame)].stamp_s);
  }
  /// Changes a file and renews the manifest, so that only the change itself is at fault.
  void EditSequence(const std::string& file, const std::string& from, const std::string& to) {
    Edit(seq() / file, from, to);
    Renew();
  }
  void Renew() { WriteManifest(seq(), static_cast<int>(world_.views.size())); }
  void EditJson(const std::string& file, const std::function<void(json&)>& edit) {
    json document = json::parse(ReadText(seq() / file));
    edit(document);
    WriteText(seq() / file, document.dump(1));
    Renew();
  }
  void EditFrame(int line, const std::function<void(json&)>& edit) {
    std::istringstream in(ReadText(seq() / "gt/frames.jsonl"));
    std::string out, text;
    for (int i = 1; std::getline(in, text); ++i) {
      json record = json::parse(text);
      if (i == line) edit(record);
      out += record.dump() + "\n";
    }
    WriteText(seq() / "gt/frames.jsonl", out);
    Renew();
  }
  /// Exactly one fault, in this place, that says this.
  void ExpectOnly(const std::string& file, int line, const std::string& pointer,
                  const std::string& what) {
    const CheckReport report = CheckFolder(seq());
    ASSERT_EQ(report.faults.size(), 1u) << All(report);
    const Fault& fault = report.faults[0];
    EXPECT_EQ(fault.file, file) << All(report);
    EXPECT_EQ(fault.line, line) << All(report);
    EXPECT_EQ(fault.pointer, pointer) << All(report);
    EXPECT_THAT(fault.what, ::testing::HasSubstr(what));
    EXPECT_FALSE(fault.mend.empty());
  }

  TemporaryFolder folder_;
  World world_ = MakeWorld();
};

}  // namespace eval::small_world
