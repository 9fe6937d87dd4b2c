#include "slam/run/mapping_worker.h"

#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <vector>

namespace slam {
namespace {

/// Work that notes its keyframes and waits for leave.
struct Held {
  std::promise<void> begun, leave;
  std::shared_future<void> left = leave.get_future().share();
  std::vector<int> done;  ///< read after Finish alone
  void operator()(int keyframe) {
    if (done.empty()) begun.set_value();
    left.wait();
    done.push_back(keyframe);
  }
};

TEST(MappingWorker, MapsInOrderAllThatWasGiven) {
  std::vector<int> done;
  MappingWorker worker([&](int keyframe) { done.push_back(keyframe); }, 100);
  for (int k = 0; k < 20; ++k) worker.Submit(k);
  worker.Finish(MappingWorker::Waiting::kDo);
  ASSERT_EQ(done.size(), 20u);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
  EXPECT_EQ(worker.dropped(), 0);
}

TEST(MappingWorker, DropsTheOldestThatWaitAndNeverTheGiver) {
  Held held;
  MappingWorker worker(std::ref(held), 2);
  worker.Submit(0);
  held.begun.get_future().wait();
  for (int k = 1; k <= 6; ++k) worker.Submit(k);  // returns although nothing is mapped
  EXPECT_EQ(worker.dropped(), 4);
  held.leave.set_value();
  worker.Finish(MappingWorker::Waiting::kDo);
  EXPECT_THAT(held.done, testing::ElementsAre(0, 5, 6));
}

TEST(MappingWorker, TellsWhoeverGivesTheNextThatMappingFailed) {
  std::promise<void> failing;
  MappingWorker worker(
      [&](int) {
        failing.set_value();
        throw std::runtime_error("mapping failed");
      },
      10);
  worker.Submit(0);
  failing.get_future().wait();
  const auto give_until_told = [&] {
    for (int k = 1; k < 100000; ++k) {
      worker.Submit(k);
      std::this_thread::yield();
    }
  };
  EXPECT_THROW(give_until_told(), std::runtime_error);
  worker.Finish(MappingWorker::Waiting::kDrop);
}

TEST(MappingWorker, FinishesTheWorkInHandWhenItIsToldToDropTheRest) {
  Held held;
  MappingWorker worker(std::ref(held), 10);
  for (int k = 0; k < 5; ++k) worker.Submit(k);
  held.begun.get_future().wait();
  auto finished =
      std::async(std::launch::async, [&] { worker.Finish(MappingWorker::Waiting::kDrop); });
  while (worker.dropped() == 0) std::this_thread::yield();
  held.leave.set_value();
  finished.get();
  EXPECT_THAT(held.done, testing::ElementsAre(0));
  EXPECT_EQ(worker.dropped(), 4);
}

TEST(MappingWorker, GivesTheGiverWhatTheWorkThrewOnce) {
  MappingWorker worker(
      [](int keyframe) {
        if (keyframe == 1) throw std::runtime_error("no memory for keyframe 1");
      },
      10);
  worker.Submit(0);
  worker.Submit(1);
  EXPECT_THROW(
      {
        while (true) worker.Check();
      },
      std::runtime_error);
  EXPECT_NO_THROW(worker.Finish(MappingWorker::Waiting::kDo));
}

TEST(MappingWorker, GivesTheGiverWhatTheLastWorkThrewAtItsEnd) {
  MappingWorker worker(
      [](int) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        throw std::runtime_error("no memory");
      },
      10);
  worker.Submit(0);
  EXPECT_THROW(worker.Finish(MappingWorker::Waiting::kDo), std::runtime_error);
}

TEST(MappingWorker, EndsWithItsThreadWhenNobodyFinishesIt) {
  std::atomic<int> done = 0;
  {
    MappingWorker worker([&](int) { ++done; }, 10);
    worker.Submit(0);
  }
  EXPECT_LE(done, 1);  // dropped or done, and no thread is left to count on
}

}  // namespace
}  // namespace slam
