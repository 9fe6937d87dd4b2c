#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/eval/check/small_run.h"
#include "tests/support/program.h"

namespace program {

/// A small sequence and a run of it, in `seq` and `run`, for commands that take a run.
class SmallRunTest : public ::testing::Test {
 protected:
  SmallRunTest() {
    namespace world = eval::small_world;
    const world::World made = world::MakeWorld();
    world::WriteSequence(folder_ / "seq", made);
    world::RunOptions options;
    options.sequence = (folder_ / "seq").string();
    world::WriteRun(folder_ / "run", made, options);
  }
  /// pas with these arguments.
  Outcome Do(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), Pas());
    return Process(arguments, {}, folder_ / "errors").Wait();
  }
  TemporaryFolder folder_;
};

}  // namespace program
