#include "sim/write/parallel_frames.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace sim {
namespace {

TEST(ForEachFrame, WorksOnEachFrameOnceAndCountsThemWhateverTheThreads) {
  const std::vector<int> frames{4, 8, 15, 16, 23, 42};
  for (const int threads : {0, 1, 2, 5, 50}) {
    std::mutex mutex;
    std::map<int, int> worked;
    std::vector<int> counts;
    ForEachFrame(
        frames, threads,
        [&](int frame) {
          const std::lock_guard lock(mutex);
          ++worked[frame];
        },
        [&](int finished) { counts.push_back(finished); });
    std::map<int, int> once;
    for (const int frame : frames) once[frame] = 1;
    EXPECT_EQ(worked, once) << threads << " threads";
    EXPECT_EQ(counts, (std::vector<int>{1, 2, 3, 4, 5, 6})) << threads << " threads";
  }
}

TEST(ForEachFrame, ThrowsWhatTheFirstFrameThatFailedThrewAndBeginsNoMore) {
  for (const int threads : {1, 2}) {
    int done = 0;
    try {
      ForEachFrame(
          {0, 1, 2, 3, 4, 5, 6, 7}, threads,
          [&](int frame) {
            if (frame >= 2) throw std::runtime_error("frame " + std::to_string(frame));
          },
          [&](int finished) { done = finished; });
      ADD_FAILURE() << "nothing was thrown by " << threads << " threads";
    } catch (const std::runtime_error& error) {
      // Two threads may both be at work on a frame that fails.
      const std::string what = error.what();
      EXPECT_TRUE(what == "frame 2" || (threads == 2 && what == "frame 3")) << what;
    }
    EXPECT_LE(done, 2);
  }
}

/// As a user who may begin no thread beside the first; ends the process.
void WorkAlone() {
  constexpr uid_t kNobody = 65534;  // root may always
  const rlimit limit{1, 1};
  if ((getuid() == 0 && setuid(kNobody) != 0) || setrlimit(RLIMIT_NPROC, &limit) != 0) _exit(2);
  int worked = 0;
  ForEachFrame(
      {0, 1, 2, 3}, 4, [&](int) { ++worked; }, nullptr);
  _exit(worked == 4 ? 0 : 1);
}

TEST(ForEachFrame, DoesWithTheThreadsThatTheSystemAllows) {
  EXPECT_EXIT(WorkAlone(), testing::ExitedWithCode(0), "");
}

TEST(ForEachFrame, HasNothingToDoForNoFrames) {
  ForEachFrame(
      {}, 2, [](int) { FAIL(); }, nullptr);
}

}  // namespace
}  // namespace sim
